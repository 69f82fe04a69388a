#pragma once
// What is wrong with a mesh as a drawing, not as a stone, put right before readings are bound to
// it: corners that are one corner, pieces that are one facet, facets or a surface inside out.

#include <optional>
#include <string>
#include <vector>

#include "fit/readings/measurement.h"
#include "stone/stone.h"

namespace culet {

struct Repaired {
    Stone stone;
    std::vector<std::string> notes;  ///< one line for each thing that was done; empty: nothing
};

/// A sound mesh comes back as it is. Corners are welded when the surface is open: nearest first,
/// never two of one facet, until there are as many as a closed surface of these facets has (Euler).
/// Pieces NAME, NAME.1, NAME.2, ... become one facet when they hang together, face the same way
/// within 15 degrees (40 for a polygon cut into triangles whose name is read, more for pieces too
/// narrow to tell) and have one outline, unless a reading names one of them but the first, or the
/// stone says that its facets are whole. Facets
/// that run the other way round than their neighbours are turned. What cannot be repaired stays.
Repaired repaired(const Stone& stone, const std::vector<WrittenReading>& readings = {});

/// The stone whose mesh is the mirror image of this one, when the azimuths read say that names run
/// round the other way than they are drawn; nothing when they do not.
std::optional<Stone> mirrored_to_azimuths(const Stone& stone, const std::vector<Reading>& readings);

}  // namespace culet
