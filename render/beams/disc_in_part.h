#pragma once
// Share of a pixel's part that sees a small disc, computed from the part's own corners. A disc on
// the border of two beams then counts in exactly one of them.

#include <cstddef>

#include "render/beams/beam_shading.h"

namespace culet {

/// A pixel's part as seen beside a disc, in the plane across the direction to the disc.
struct PartBesideDisc {
    Vec3 offset;       ///< from the disc's middle to the part's
    Vec3 along, down;  ///< along the part's sides (CoveredPixels::xx)
    Vec3 normal;       ///< unit, of the plane
    double radius = 0;
};

/// Share of a polygon's area within a circle of `radius` about the origin, summed over its edges'
/// parts of the circle's sectors. Either orientation; 0 for no area.
double share_in_circle(const ScreenPoint* corners, std::size_t count, double radius);

/// Share of a fragment's part that sees the disc. Below 0 if the part is too thin or has no known
/// corners.
double share_in_disc(const Fragments& fragments, int fragment, const PartBesideDisc& seen);

}  // namespace culet
