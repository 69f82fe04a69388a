#pragma once
// Interface of engines. CONTRIBUTING.md says how to add one; render/engines.cpp lists them.

#include <string>
#include <vector>

#include "render/engine/render_result.h"
#include "render/scene/scene.h"
#include "render/setup/optical_setup.h"
#include "stone/progress/progress.h"

namespace culet {

/// Estimated amount of work in a picture.
struct DrawingWork {
    double pixels = 0;         ///< of the stone
    double views = 1;          ///< rays of a pixel, or points of the pupil
    double bands = 1;          ///< separately traced sets of wavelengths
    double faces_per_ray = 1;  ///< faces met per eye ray, in all branches
    double tolerance = 0.01;   ///< of the engine's settings
    double cut = 0;            ///< the engine's cut_weight; 0: as the tolerance
    bool general = false;      ///< optical_setup.h
    bool polarised = true;
    bool splits = false;
    int nodes = 1;  ///< wavelengths of a band
};

class Engine {
public:
    Engine() = default;
    Engine(const Engine&) = delete;
    Engine& operator=(const Engine&) = delete;
    virtual ~Engine() = default;

    /// The name in scene files.
    virtual std::string name() const = 0;
    /// Why it cannot draw this scene, to be continued with ": say engine = ..."; empty if it can.
    virtual std::string refuses(const Scene& scene, const OpticalSetup& setup) const = 0;
    /// Estimated processor time of a picture, in the nanoseconds of work/price.h.
    virtual double cost_ns(const DrawingWork& work) const = 0;
    /// Draws with the scene's settings as they are; the tolerance decides open ones. Throws
    /// InputError for refused scenes, and Interrupted.
    virtual RenderResult draw(const Scene& scene, const Progress& progress) const = 0;
    /// Whether finer settings converge to the reference with everything on: then pictures are
    /// planned and checked.
    virtual bool approaches_truth() const = 0;
};

const std::vector<const Engine*>& engines();
/// Throws InternalError for an unknown name, such as "auto".
const Engine& engine_named(const std::string& name);
/// The engine of the settings; the reference for "auto".
const Engine& engine_of(const RenderSettings& settings);

}  // namespace culet
