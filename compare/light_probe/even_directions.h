#pragma once

#include <vector>

#include "stone/solid/solid.h"

namespace culet {

/// `count` unit vectors on a golden-angle spiral from +z to -z.
std::vector<Vec3> even_directions(int count);

}  // namespace culet
