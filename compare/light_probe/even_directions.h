#pragma once
// Directions spread evenly over the sphere.

#include <vector>

#include "stone/solid/solid.h"

namespace culet {

/// `count` unit vectors on a spiral from +z to -z, each a golden angle on: equal shares of the
/// sphere.
std::vector<Vec3> even_directions(int count);

}  // namespace culet
