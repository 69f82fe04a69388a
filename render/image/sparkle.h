#pragma once
// Streaks of bright points along two directions, as a star filter makes them.

#include <vector>

#include "render/image/glare.h"

namespace culet {

/// Adds the light above 1 once more, spread along both diagonals; `strength`: the energy that is
/// added over that of the light above 1, where the streaks end within the picture. `rgb`: 3 a
/// pixel, linear.
void add_sparkle(std::vector<float>& rgb, const PictureSize& size, double strength);

}  // namespace culet
