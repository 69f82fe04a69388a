#pragma once
// Azimuths of level facets, which have none. Private to the room.

#include <string>
#include <vector>

#include "fit/readings/measurement.h"

namespace culet {

/// Throws InputError for an azimuth of a facet that is exactly level (inclination 0 from the table,
/// or parallel to it).
void refuse_level_azimuths(const std::vector<Reading>& readings, const Stone& stone);

/// Indices of azimuths of facets whose inclination was read as less than three of its sigmas (and
/// less than 5 degrees): they are uncertain by a third of a right angle or more, whatever their
/// sigma.
std::vector<std::size_t> meaningless_azimuths(const std::vector<Reading>& readings);

}  // namespace culet
