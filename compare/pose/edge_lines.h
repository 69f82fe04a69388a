#pragma once
// Edges of a stone are straight, and so are their pictures: an edge of the photograph that belongs
// to one lies along all of it. Others (facets of the far side, seen through the near ones) cross it
// or stop.

#include "compare/pose/edge_search.h"

namespace culet {

/// An edge of the wireframe, and where it was met along most of its length.
struct MetLine {
    struct Place {
        int point = -1;  ///< of the points given
        FoundEdge found;
    };
    int edge = -1;
    bool outline = false;
    int looked = 0;  ///< points that were looked at
    std::vector<Place> places;
};

/// One for each edge that has points; they come from `points_along`, so that an edge's stand
/// together. `expected`: where each point is expected, offset along its normal; edges of the
/// photograph within `width` of it (one a point, too) are looked at. The straight line that meets
/// most points wins; `places` stays empty when it meets fewer than half of them, or than three.
std::vector<MetLine> met_lines(const EdgePicture& picture, const std::vector<WirePoint>& points,
                               const std::vector<double>& expected,
                               const std::vector<double>& width);

}  // namespace culet
