#pragma once
// Whether a picture's ground was put there by a program.

#include "compare/turntable/edge_points.h"

namespace culet {

/// The ground beside the stone is one colour: a camera's has noise, grain and the stone's shadow.
/// Where it is cut out, the stone's edges are cut by a program, too.
bool has_flat_ground(const LevelPicture& picture, const std::vector<glm::dvec2>& stone);

}  // namespace culet
