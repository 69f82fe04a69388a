#pragma once
// Streaks around bright points along two directions, like a star filter's.

#include <vector>

#include "render/image/glare.h"

namespace culet {

/// Adds the light above 1 once more, spread along both diagonals. `strength`: added energy relative
/// to that light, for streaks that end within the picture. `rgb`: 3 values per pixel, linear.
void add_sparkle(std::vector<float>& rgb, const PictureSize& size, double strength);

}  // namespace culet
