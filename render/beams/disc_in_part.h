#pragma once
// How much of a part of a pixel sees a small disc, by the part's own corners: what stands between
// two beams is then in one of them, and in one of two pixels.

#include <cstddef>

#include "render/beams/beam_shading.h"

namespace culet {

/// A part of a pixel as it sees a disc, in the plane across the direction to it.
struct PartBesideDisc {
    Vec3 offset;       ///< of the part's middle from the disc's
    Vec3 along, down;  ///< its change over the part's sides (CoveredPixels::xx)
    Vec3 normal;       ///< unit, of the plane
    double radius = 0;
};

/// Area within a circle of `radius` about the origin, of a polygon's: the sum of what its edges cut
/// off of the circle's sectors. Either orientation; 0 for no area.
double share_in_circle(const ScreenPoint* corners, std::size_t count, double radius);

/// Share of a fragment's part of its pixel. Below 0 where that has no width to speak of, or no
/// corners are known.
double share_in_disc(const Fragments& fragments, int fragment, const PartBesideDisc& seen);

}  // namespace culet
