#pragma once
// Fills what no view of a mirror ball shows.

#include <vector>

#include "render/scene/scene.h"

namespace culet {

/// Fills texels of weight 0 with means of their surroundings, over ever larger distances. Returns
/// their solid angle.
double fill_holes(EnvironmentMap& map, const std::vector<double>& weight);

}  // namespace culet
