#pragma once
// The soft shadow of a stone on the ground under it, for pictures that are only looked at.

#include <vector>

#include "render/scene/scene.h"

namespace culet {

/// Part of the light of a uniform tent that reaches the ground at each pixel of the camera's
/// picture, row by row. The ground is level (z up) at the stone's lowest point. The shadow is that
/// of a convex body that passes `k_passed` of the light, by Lambert's formula for the irradiance of
/// a polygon; light that the stone gathers is left out. 1 where the ray misses the ground.
std::vector<float> ground_lit(const Solid& solid, const Camera& camera);

}  // namespace culet
