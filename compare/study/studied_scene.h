#pragma once
// The scene as a study draws it.

#include <vector>

#include "render/render.h"

namespace culet {

/// What the design needs to know of a scene.
struct StudiedScene {
    Scene scene;                     ///< at the studied size
    RenderStats exact;               ///< of the reference: effects, wavelengths, depth
    bool beams = true;               ///< they can draw it
    double tolerance = 0.01;         ///< the scene's own, about which settings are varied
    std::vector<double> tolerances;  ///< falling
};

}  // namespace culet
