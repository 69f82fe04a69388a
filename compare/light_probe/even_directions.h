#pragma once
// Directions spread evenly over the sphere.

#include <vector>

#include "stone/solid/solid.h"

namespace culet {

/// `count` unit vectors with equal shares of the sphere, on a golden-angle spiral from +z to -z.
std::vector<Vec3> even_directions(int count);

}  // namespace culet
