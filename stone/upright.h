#pragma once
// A stone turned so that its own up direction is +z.

#include "stone/stone.h"

namespace culet {

/// Turned by the least rotation: solid, crystal and up direction. The up facet's normal counts
/// where the stone names one.
Stone standing_upright(const Stone& stone);

/// Its own up direction, unit: the up facet's normal where it names one.
Vec3 up_of(const Stone& stone);

/// A solid that stands upright, in the frame of the stone whose up direction is `up`.
Solid turned_back(Solid upright, const Vec3& up);

}  // namespace culet
