#pragma once
// Suggests where on the mesh an unknown facet name belongs, from its readings. Private to the room.

#include <string>
#include <vector>

#include "fit/readings/measurement.h"

namespace culet {

/// Text for the end of an error message, beginning with `; `: the facet of the mesh in the
/// direction that the readings of `name` give and that no other reading names, or else the corner
/// that a facet of that direction would cut off. Empty unless inclination and azimuth of `name`
/// were read.
std::string where_it_may_lie(const std::string& name, const std::vector<WrittenReading>& written,
                             const Stone& stone);

}  // namespace culet
