#pragma once
// Finds the photograph's edges that lie along a whole straight edge of the stone. Other edges
// (facets of the far side, seen through the near ones) cross it or stop.

#include "compare/pose/edge_search.h"

namespace culet {

/// A wireframe edge, and where it was met along most of its length.
struct MetLine {
    struct Place {
        int point = -1;  ///< index among the given points
        FoundEdge found;
    };
    int edge = -1;
    bool outline = false;
    int looked = 0;  ///< number of points searched
    std::vector<Place> places;
};

/// One for each edge that has points. `points` come from `points_along`, so those of an edge are
/// adjacent. For each point, `expected` is where its edge is expected, as an offset along the
/// normal, and `width` is how far from there to search. The straight line that meets most points
/// wins; `places` stays empty when it meets fewer than half of them, or fewer than three.
std::vector<MetLine> met_lines(const EdgePicture& picture, const std::vector<WirePoint>& points,
                               const std::vector<double>& expected,
                               const std::vector<double>& width);

}  // namespace culet
