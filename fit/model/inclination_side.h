#pragma once
// From which side an inclination counts. Private to the room.

#include "stone/solid/solid.h"

namespace culet {

/// 1: from above, -1: from below. A reading of a nearly upright
/// facet does not say on which side of upright it is: the nearer one is meant.
int side_of(const Vec3& normal, double inclination_read);

}  // namespace culet
