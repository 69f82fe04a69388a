#pragma once
// Restores the corners of a blurred polygon.

#include <glm/vec2.hpp>
#include <vector>

namespace culet {

struct SharpOutline {
    std::vector<glm::dvec2> corners;  ///< intersections of the lines through its sides, in order
    std::vector<glm::dvec2> points;   ///< the given ones outside the corners' blur
};

/// A lens rounds corners off: there points lie inside the outline by up to twice its blur.
/// Intersects lines through the sides' points away from their ends. `points`: along a convex
/// outline, in pixels.
SharpOutline sharpened(const std::vector<glm::dvec2>& points);

}  // namespace culet
