#pragma once
// A renderer that has nothing but an isotropic, clear stone, unpolarised light, one wavelength, a
// pinhole, and lights that are constant, lobes or caps: what the reference renderer's speed is
// measured against where all its effects are off. Same rays, same geometry, same Fresnel powers,
// double precision.

#include <vector>

#include "render/scene/scene.h"

namespace culet {

struct BarePicture {
    std::vector<double> radiance;
    long long rays = 0;  ///< that met the stone
};

/// `side`^2 rays a pixel on a grid, paths to `depth`, none below `cut`. On the calling thread.
BarePicture draw_bare(const Scene& scene, int side, int depth, double cut);

}  // namespace culet
