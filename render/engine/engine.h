#pragma once
// A way of drawing a scene. CONTRIBUTING.md says how to add one; render/engines.cpp lists them.

#include <string>
#include <vector>

#include "render/engine/render_result.h"
#include "render/scene/scene.h"
#include "render/setup/optical_setup.h"
#include "stone/progress/progress.h"

namespace culet {

/// What a picture is made of, as far as that is known before it is drawn.
struct DrawingWork {
    double pixels = 0;         ///< of the stone
    double views = 1;          ///< rays of a pixel, or points of the pupil
    double bands = 1;          ///< of wavelengths, each of which goes its own way
    double faces_per_ray = 1;  ///< that the light of a ray meets, all branches together
    double tolerance = 0.01;   ///< of the engine's settings
    double cut = 0;            ///< their cut_weight; 0: as the tolerance
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

    /// As scene files have it.
    virtual std::string name() const = 0;
    /// Why it cannot draw this scene, in words that go on with ": say engine = ..."; empty: it can.
    virtual std::string refuses(const Scene& scene, const OpticalSetup& setup) const = 0;
    /// Processor time of a picture, about, in the nanoseconds of work/price.h.
    virtual double cost_ns(const DrawingWork& work) const = 0;
    /// With the scene's settings as they are; what they leave open is as exact as their tolerance
    /// asks for. Throws InputError for what it refuses, and Interrupted.
    virtual RenderResult draw(const Scene& scene, const Progress& progress) const = 0;
    /// Whether finer settings bring its pictures to the truth (the reference with everything on):
    /// then they are planned, and held against it.
    virtual bool approaches_truth() const = 0;
};

const std::vector<const Engine*>& engines();
/// Throws InternalError where there is none of that name. "auto" is none.
const Engine& engine_named(const std::string& name);
/// That of the settings; auto, where nobody has chosen: the reference.
const Engine& engine_of(const RenderSettings& settings);

}  // namespace culet
