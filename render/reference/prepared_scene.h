#pragma once
// A scene prepared for drawing by engines and pilots: its optical setup, the surroundings at its
// wavelengths, and the limits of paths.

#include <memory>

#include "render/optics/path.h"
#include "render/reference/surroundings.h"
#include "render/setup/optical_setup.h"

namespace culet {

struct PreparedScene {
    /// Derives open settings from the scene's tolerance: as few wavelengths as colours allow, and
    /// the cut weight, relative to the mean of a small, shallow picture.
    explicit PreparedScene(const Scene& scene);
    /// `nodes`: wavelengths if a spectrum is needed and the scene gives none. `limits` stay, except
    /// for what the setup decides (polarised, roulette).
    PreparedScene(const Scene& scene, int nodes, const PathLimits& limits);

    /// Changes the camera; `anew` is its setup at the same wavelengths.
    void look(const Scene& scene, OpticalSetup anew);

    OpticalSetup setup;
    WavelengthSet colours;
    std::unique_ptr<const Surroundings> surroundings;
    PathLimits limits;
};

/// Limits of paths with objects. Their light is sampled at random, and what is cut must be less
/// than that noise: a tenth of the tolerance, relative to the light that a path would see. Trees
/// that branch play Russian roulette.
PathLimits limits_with_objects(const Scene& scene, const OpticalSetup& setup);

}  // namespace culet
