#pragma once
// Refuses lengths that look like another unit. Private to the room.

#include <vector>

#include "fit/readings/measurement.h"

namespace culet {

/// Throws InputError for an overall length that is many times the mesh's or a fraction of it,
/// naming the unit that would explain it, unless all agree that the mesh has another size. Also for
/// widths and edges in different units (eight times apart, by the mesh's proportions), and for a
/// volume or weight a hundred times off.
void refuse_other_units(const std::vector<Reading>& readings, const Stone& stone);

}  // namespace culet
