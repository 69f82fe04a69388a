#pragma once
// Finds the photograph's edges that lie along a whole straight edge of the stone. Other edges
// (facets of the far side, seen through the near ones) cross it or stop.

#include "compare/pose/edge_search.h"

namespace culet {

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

/// One for each edge with points; `points` come from `points_along`, so an edge's are adjacent. For
/// each point, `expected` is the edge's expected offset along the normal, and `width` how far from
/// there to search. The line that meets most points wins; `places` stays empty below half of them,
/// or below three.
std::vector<MetLine> met_lines(const EdgePicture& picture, const std::vector<WirePoint>& points,
                               const std::vector<double>& expected,
                               const std::vector<double>& width);

}  // namespace culet
