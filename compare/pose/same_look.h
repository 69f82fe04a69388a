#pragma once
// A stone's own symmetry as two views of it show it: whether they look alike but for small
// irregularities.

#include "compare/pose/wireframe.h"

namespace culet {

/// `mirrored`: one of the two pictures is turned left to right. Alike when nearly all of the area
/// seen in the first belongs to facets that have a counterpart of about the same direction and size
/// in the second.
bool look_alike(const WireSolid& wire, const StoneView& a, const StoneView& b, bool mirrored);

/// All turns, and turns with a mirroring, about its middle that leave a solid as it is, to
/// rounding; the first is the one that changes nothing.
std::vector<glm::dmat3> symmetries_of(const WireSolid& wire);

/// The turn from whose direction a stone with a mirror plane through z and x looks, left to right,
/// as it does from `turn`.
glm::dmat3 mirrored_turn(const glm::dmat3& turn);

}  // namespace culet
