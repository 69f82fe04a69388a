#pragma once
// The outline of a stone before a bright ground, to a part of a pixel.

#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "compare/photo/photo.h"

namespace culet {

struct BackLitOutline {
    /// In their order around the stone: x to the right, y up, pixels from the picture's middle.
    std::vector<glm::dvec2> points;
    std::vector<glm::dvec2> corners;  ///< of its convex hull, not rounded by blur (sharp_corners.h)
    bool at_left = false, at_right = false, at_top = false, at_bottom = false;  ///< leaves there
    double contrast = 0;  ///< median of 1 - dark / bright across the outline
    std::string trouble;  ///< why there is none, for people; empty when all is well
};

/// Where the light falls to half between the ground just outside the stone and the darkest just
/// inside it. The ground may fall off as a quadric; the stone may let light through, but not along
/// its whole outline. Of several dark things the largest is the stone; where it reaches the
/// picture's border (a holder does) it has no outline.
BackLitOutline back_lit_outline(const Photo& photo);

}  // namespace culet
