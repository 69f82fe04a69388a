#pragma once
// Where cutting a tier stops.

#include <vector>

#include "stone/design/cutting_list.h"

namespace culet {

/// Fills in the depth of every step. A corner stops a tier only where its facets would miss it if
/// they were cut deeper: where they meet by symmetry at any depth it is no stop, and a length is
/// given instead. `normals`: of each facet as its tier and index setting have it, so that the
/// unevenness of a cut stone is not taken for a stop.
void find_depths(const Solid& solid, const std::vector<Vec3>& normals,
                 std::vector<CuttingStep>& list);

}  // namespace culet
