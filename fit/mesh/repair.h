#pragma once
// Repairs errors of a mesh as a drawing before readings are bound to it: duplicate corners, facets
// in pieces, facets or a surface inside out.

#include <optional>
#include <string>
#include <vector>

#include "fit/readings/measurement.h"
#include "stone/stone.h"

namespace culet {

struct Repaired {
    Stone stone;
    std::vector<std::string> notes;  ///< one line for each change
};

/// Returns a sound mesh unchanged. What cannot be repaired stays.
///
/// An open surface is welded: nearest corners first, never two of one facet, until there are as
/// many corners as a closed surface of these facets has (Euler).
///
/// Pieces NAME, NAME.1, NAME.2, ... become one facet if they are connected, have one outline and
/// face the same way within 15 degrees (40 for a polygon cut into triangles whose name is read;
/// more for pieces too narrow to tell). They stay apart if a reading names a piece other than the
/// first, or the stone says that its facets are whole.
///
/// Facets with the opposite orientation to their neighbours are turned.
Repaired repaired(const Stone& stone, const std::vector<WrittenReading>& readings = {});

/// Returns the stone with its mesh mirrored when the azimuths read show that names run round the
/// other way; nothing when they do not.
std::optional<Stone> mirrored_to_azimuths(const Stone& stone, const std::vector<Reading>& readings);

}  // namespace culet
