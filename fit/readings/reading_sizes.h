#pragma once
// Refuses lengths that look like another unit. Private to the room.

#include <vector>

#include "fit/readings/measurement.h"

namespace culet {

/// Throws InputError for an overall length that differs from the mesh's by a large factor, with the
/// unit that would explain it; but not if all of them agree that the mesh has another size. Also
/// for widths and edges that cannot have the same unit (eight times apart, by the mesh's
/// proportions), and for a volume or weight that is off by a factor of a hundred.
void refuse_other_units(const std::vector<Reading>& readings, const Stone& stone);

}  // namespace culet
