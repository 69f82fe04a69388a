#pragma once
// Finds where the cutting of each tier stops.

#include <vector>

#include "stone/design/cutting_list.h"

namespace culet {

/// Fills in the depth of every step. A corner stops a tier only if the tier's facets would miss it
/// when cut deeper; where they meet by symmetry at every depth, the depth is a length. `normals`
/// are the facets' directions by tier and index setting, so that the unevenness of a cut stone is
/// not taken for a stop.
void find_depths(const Solid& solid, const std::vector<Vec3>& normals,
                 std::vector<CuttingStep>& list);

}  // namespace culet
