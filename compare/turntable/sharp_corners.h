#pragma once
// Corners of a blurred polygon.

#include <glm/vec2.hpp>
#include <vector>

namespace culet {

struct SharpOutline {
    std::vector<glm::dvec2> corners;  ///< where the lines through its sides cross, in their order
    std::vector<glm::dvec2> points;   ///< those given, without those that a corner's blur displaced
};

/// A lens rounds corners off: there, points lie inside the outline by up to twice its blur. Lines
/// through the points of each side, away from its ends, cross where the corner is. `points` follow
/// a convex outline round, in pixels.
SharpOutline sharpened(const std::vector<glm::dvec2>& points);

}  // namespace culet
