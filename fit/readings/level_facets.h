#pragma once
// Azimuths of facets that lie level: a level facet has none. Private to the room.

#include <string>
#include <vector>

#include "fit/readings/measurement.h"

namespace culet {

/// Throws InputError for an azimuth of a facet that other readings make level exactly (inclination
/// 0 from the table, or parallel to it, exact).
void refuse_level_azimuths(const std::vector<Reading>& readings, const Stone& stone);

/// Azimuth readings of facets whose inclination was read as less than three of its sigmas (and less
/// than 5 degrees): the direction in which such a facet leans is not known to within a third of a
/// right angle, whatever sigma the azimuth was given. Indices.
std::vector<std::size_t> meaningless_azimuths(const std::vector<Reading>& readings);

}  // namespace culet
