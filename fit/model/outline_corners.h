#pragma once
// Corners of an outline. Private to the room.

#include <vector>

#include "fit/model/residuals.h"

namespace culet {

std::vector<Corner> corners_of(const Outline& outline, int facet);

/// The two ends of the edge that two loops share, or empty.
std::vector<Corner> shared_edge(const Outline& outline, int a, int b);

/// The first one if several are equally far.
Corner farthest(const Shape& shape, const std::vector<Corner>& corners, const Vec3& direction);

}  // namespace culet
