#pragma once
// A stone turned so that its own up direction is +z.

#include "stone/stone.h"

namespace culet {

/// Turned by the least rotation: solid, crystal and up direction. The up facet's normal counts
/// where the stone names one.
Stone standing_upright(const Stone& stone);

}  // namespace culet
