#pragma once
// Streaks around bright points along two directions, like a star filter's.

#include <vector>

#include "render/image/glare.h"

namespace culet {

/// Adds a copy of the light above 1, spread along both diagonals. `strength`: added energy relative
/// to the light above 1, for streaks that end within the picture. `rgb`: 3 values per pixel,
/// linear.
void add_sparkle(std::vector<float>& rgb, const PictureSize& size, double strength);

}  // namespace culet
