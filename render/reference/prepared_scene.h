#pragma once
// A scene made ready to be drawn, in this order: its optical setup, the surroundings at the setup's
// wavelengths, and how far paths are followed. Engines and pilots all draw one of these.

#include <memory>

#include "render/optics/path.h"
#include "render/reference/surroundings.h"
#include "render/setup/optical_setup.h"

namespace culet {

struct PreparedScene {
    /// What the scene leaves open follows from its tolerance: as few wavelengths as colours allow,
    /// and weights that may be cut, relative to the mean of a small, shallow picture.
    explicit PreparedScene(const Scene& scene);
    /// `nodes`: wavelengths where a spectrum is called for and the scene names none. `limits` as
    /// they are, but for what the setup decides (polarised, roulette).
    PreparedScene(const Scene& scene, int nodes, const PathLimits& limits);

    /// Another camera: `anew` is its setup, at the wavelengths that were chosen.
    void look(const Scene& scene, OpticalSetup anew);

    OpticalSetup setup;
    WavelengthSet colours;
    std::unique_ptr<const Surroundings> surroundings;
    PathLimits limits;
};

/// How far the paths of a stone are followed where things stand around it: light is sampled at
/// random there, and what is cut is to be less than that noise. A tenth of the tolerance is left,
/// relative to the light that such a path would see; trees that branch play roulette.
PathLimits limits_with_objects(const Scene& scene, const OpticalSetup& setup);

}  // namespace culet
