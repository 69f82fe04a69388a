#pragma once
// Azimuths of level facets, which have none. Private to the room.

#include <string>
#include <vector>

#include "fit/readings/measurement.h"

namespace culet {

/// Throws InputError for an azimuth of a facet that other readings make exactly level (inclination
/// 0 from the table, or parallel to it, exact).
void refuse_level_azimuths(const std::vector<Reading>& readings, const Stone& stone);

/// Indices of azimuth readings of facets whose inclination was read as less than three of its
/// sigmas (and less than 5 degrees). The azimuth of such a facet is uncertain by a third of a right
/// angle or more, whatever its stated sigma.
std::vector<std::size_t> meaningless_azimuths(const std::vector<Reading>& readings);

}  // namespace culet
