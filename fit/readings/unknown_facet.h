#pragma once
// A name that the mesh does not have: where on the mesh its readings put it. Private to the room.

#include <string>
#include <vector>

#include "fit/readings/measurement.h"

namespace culet {

/// For the end of an error's line, beginning with `; `: the facet of the mesh that stands as the
/// readings of `name` say and that nothing else was read of, or else the corner that a facet of
/// that direction would cut off. Empty unless its inclination and azimuth were read.
std::string where_it_may_lie(const std::string& name, const std::vector<WrittenReading>& written,
                             const Stone& stone);

}  // namespace culet
