#pragma once
// Which way round the facets of a mesh run. Private to the room.

#include <optional>

#include "stone/stone.h"

namespace culet {

/// The facet's plane from its corners as they are now.
void renew_plane(Solid& solid, Facet& facet);

/// Turns facets so that neighbours run along their common side in opposite ways and the whole faces
/// outwards. How many were turned; nothing when some side is not of two facets, the mesh does not
/// hang together, or no turning helps.
std::optional<int> orient(Solid& solid);

/// Every facet the other way round.
void turn_round(Solid& solid);

}  // namespace culet
