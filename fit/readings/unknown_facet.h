#pragma once
// Suggests where on the mesh an unknown facet name belongs, from its readings. Private to the room.

#include <string>
#include <vector>

#include "fit/readings/measurement.h"

namespace culet {

/// End of an error message, beginning with `; `: the mesh's facet in the direction read for `name`,
/// if no other reading names it, or else the corner that such a facet would cut off. Empty unless
/// inclination and azimuth were read.
std::string where_it_may_lie(const std::string& name, const std::vector<WrittenReading>& written,
                             const Stone& stone);

}  // namespace culet
