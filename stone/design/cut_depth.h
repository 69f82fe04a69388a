#pragma once
// Finds where the cutting of each tier stops.

#include <vector>

#include "stone/design/cutting_list.h"

namespace culet {

/// Fills in the depth of every step. A corner stops a tier only if the tier's facets would miss it
/// when cut deeper. Facets that meet by symmetry at every depth give no stop: the depth is a length
/// then. `normals` are the facets' directions by tier and index setting, so that the unevenness of
/// a cut stone does not look like a stop.
void find_depths(const Solid& solid, const std::vector<Vec3>& normals,
                 std::vector<CuttingStep>& list);

}  // namespace culet
