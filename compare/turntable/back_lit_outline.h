#pragma once
// Finds the subpixel outline of a stone before a bright ground.

#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "compare/photo/photo.h"

namespace culet {

struct BackLitOutline {
    /// In order; x to the right, y up, pixels from the picture's middle.
    std::vector<glm::dvec2> points;
    std::vector<glm::dvec2> corners;  ///< of its convex hull, sharpened (sharp_corners.h)
    bool at_left = false, at_right = false, at_top = false, at_bottom = false;  ///< cut off
    double contrast = 0;  ///< median of 1 - dark / bright across the outline
    std::string trouble;  ///< why none was found, for people; empty when found
};

/// Where the light is half way from the ground just outside to the darkest just inside. The ground
/// may fall off as a quadric; the stone may let light through, but not all round. The largest dark
/// object is the stone; where it reaches the picture's border (as a holder does), it has no
/// outline.
BackLitOutline back_lit_outline(const Photo& photo);

}  // namespace culet
