#pragma once
// Where a stone before a plain ground ends in a picture, whatever the light.
//
// Positions are pixels from the picture's middle, x to the right, y up.

#include <cstdint>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "compare/photo/photo.h"

namespace culet {

/// A picture as a screen shows it: rows from the top, R, G, B, 0 to 255 each (sRGB).
struct LevelPicture {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgb;
};
LevelPicture levels_of(const Photo& photo);

struct CoarseOutline {
    std::vector<glm::dvec2> corners;  ///< of its convex hull
    std::string trouble;              ///< why none was found, for people; empty when found
};

/// The largest object with sharp edges, within two pixels: a soft shadow has none.
CoarseOutline coarse_outline(const LevelPicture& picture);

/// Places along a polygon, 3 pixels from each other.
std::vector<glm::dvec2> places_along(const std::vector<glm::dvec2>& outline);

/// Places of the edge near an expected outline (a convex polygon, counter-clockwise), 3 pixels from
/// each other, to a few tenths of a pixel: the steepest place along the outline's normal, within
/// `reach` pixels. Of several the outermost is taken, unless the next is nearly three times as
/// steep, since sharpening cameras draw a halo. Places without an edge are left out.
std::vector<glm::dvec2> edge_points(const LevelPicture& picture,
                                    const std::vector<glm::dvec2>& outline, double reach);

}  // namespace culet
