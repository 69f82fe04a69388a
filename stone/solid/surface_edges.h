#pragma once
// How the facets of a solid are connected, for solids that may be broken in any way. For sound ones
// use `half_edges`.

#include <vector>

#include "stone/solid/solid.h"

namespace culet {

/// One side of an edge: `facet` runs along it from `low` to `high` if `forward`, else back.
struct EdgeSide {
    int low = -1, high = -1;
    bool forward = true;
    int facet = -1;

    bool same_edge(const EdgeSide& other) const { return low == other.low && high == other.high; }
};

/// Those of one edge are adjacent.
std::vector<EdgeSide> sorted_sides(const Solid& solid);

bool has_valid_corners(const Solid& solid);

bool has_distinct_corners(const Facet& facet);

/// Vertices whose facets form more than one fan. Facets of a fan share an edge that ends there.
std::vector<int> pinched_vertices(const Solid& solid, const std::vector<EdgeSide>& sides);

/// Disjoint sets of numbers (union-find, Tarjan 1975).
class Groups {
public:
    explicit Groups(std::size_t count);
    int find(int i);
    void join(int i, int j) { parent_[find(i)] = find(j); }

private:
    std::vector<int> parent_;
};

}  // namespace culet
