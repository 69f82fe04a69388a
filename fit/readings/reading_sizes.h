#pragma once
// Lengths that look like another unit. Private to the room.

#include <vector>

#include "fit/readings/measurement.h"

namespace culet {

/// Throws InputError for an overall length that is many times off the mesh's, with the unit that
/// would explain it; not when all of them agree that it is the mesh that has another size. Also for
/// widths and edges that cannot be in one unit (eight times apart, by the mesh's proportions), and
/// for a volume or weight a hundred times off.
void refuse_other_units(const std::vector<Reading>& readings, const Stone& stone);

}  // namespace culet
