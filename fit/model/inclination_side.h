#pragma once
// The side from which an inclination is counted. Private to the room.

#include "stone/solid/solid.h"

namespace culet {

/// 1: from above, -1: from below. For a nearly upright facet the reading does not tell: takes the
/// side whose angle is nearer to it.
int side_of(const Vec3& normal, double inclination_read);

}  // namespace culet
