#pragma once
// The neighbours of facets, edges and corners: the half-edge mesh (OpenMesh) of a solid as plain
// tables.

#include <vector>

#include "stone/solid/solid.h"

namespace culet {

/// Runs from corner `from` to `to`, with facet `left` on its left as seen from outside. Each edge
/// appears once, with from < to.
struct Edge {
    int from = -1, to = -1;
    int left = -1, right = -1;
};

struct HalfEdges {
    std::vector<Edge> edges;  ///< sorted by (from, to)
    std::vector<std::vector<int>>
        facets_of_vertex;  ///< around each vertex, counter-clockwise from outside
};

/// Throws InternalError when the facets are not a closed manifold: run `find_faults` first.
HalfEdges half_edges(const Solid& solid);

}  // namespace culet
