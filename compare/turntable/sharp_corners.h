#pragma once
// Restores the corners of a blurred polygon.

#include <glm/vec2.hpp>
#include <vector>

namespace culet {

struct SharpOutline {
    std::vector<glm::dvec2> corners;  ///< intersections of the lines through its sides, in order
    std::vector<glm::dvec2> points;   ///< the given ones without those that a corner's blur
                                      ///< displaced
};

/// A lens rounds corners off, so that points there lie inside the outline by up to twice its blur.
/// Each side gets a line through its points away from the ends; neighbouring lines intersect at the
/// corner. `points`: along a convex outline, in pixels.
SharpOutline sharpened(const std::vector<glm::dvec2>& points);

}  // namespace culet
