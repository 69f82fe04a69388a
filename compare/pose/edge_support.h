#pragma once
// How much better the photograph's edges match a wireframe than its shifted copies.

#include "compare/pose/edge_search.h"

namespace culet {

struct EdgeSupport {
    double met = 0;     ///< share of the crown's points that have an edge near
    double chance = 0;  ///< the same for the shifted wireframe
    double z = 0;       ///< (met - chance) over the standard deviation of the shifted ones
    /// Log-likelihood ratio of this wireframe to chance.
    double log_likelihood = 0;
};

/// `points` come from `points_along`. An edge is near within a pixel plus 1.5 sigma of the facet
/// errors' effect. Shifts are 2.5 to 7 % of `diameter_px`.
EdgeSupport edge_support(const EdgePicture& picture, const std::vector<WirePoint>& points,
                         double diameter_px);

}  // namespace culet
