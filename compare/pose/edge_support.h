#pragma once
// How well a wireframe is met by the edges of a photograph, against the same wireframe laid
// elsewhere: what chance meets.

#include "compare/pose/edge_search.h"

namespace culet {

struct EdgeSupport {
    double met = 0;     ///< share of the crown's points that have an edge near
    double chance = 0;  ///< the same where the wireframe is shifted
    double z = 0;       ///< (met - chance) over the latter's standard deviation among shifts
    /// Logarithm of how much likelier the photograph is with this wireframe than by chance.
    double log_likelihood = 0;
};

/// `points` from `points_along`. Near is within a pixel and one and a half times what facet errors
/// move the edge. `diameter_px`: shifts are 2.5 to 7 % of it.
EdgeSupport edge_support(const EdgePicture& picture, const std::vector<WirePoint>& points,
                         double diameter_px);

}  // namespace culet
