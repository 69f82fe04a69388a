#pragma once
// Orients the facets of a mesh. Private to the room.

#include <optional>

#include "stone/stone.h"

namespace culet {

/// Recomputes the facet's plane from its corners.
void renew_plane(Solid& solid, Facet& facet);

/// Turns facets so that neighbours traverse their common side in opposite directions and the whole
/// faces outwards. Returns how many were turned; nothing when a side does not belong to two facets,
/// the mesh is not connected, or no turning helps.
std::optional<int> orient(Solid& solid);

/// Reverses every facet.
void turn_round(Solid& solid);

}  // namespace culet
