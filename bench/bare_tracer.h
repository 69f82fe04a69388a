#pragma once
// A minimal renderer, to measure what the reference renderer's generality costs with all effects
// off: only a clear isotropic stone, unpolarised light, one wavelength, a pinhole, and lights that
// are constant, lobes or caps. Same rays, geometry and Fresnel powers, in double precision.

#include <vector>

#include "render/scene/scene.h"

namespace culet {

struct BarePicture {
    std::vector<double> radiance;
    long long rays = 0;  ///< that meet the stone
};

/// Draws `side`^2 rays per pixel on a grid, with paths to `depth` and weights down to `cut`, on the
/// calling thread.
BarePicture draw_bare(const Scene& scene, int side, int depth, double cut);

}  // namespace culet
