#pragma once
// How the facets of a solid hang together, for solids that may be broken in any way. Sound ones
// have `half_edges`.

#include <vector>

#include "stone/solid/solid.h"

namespace culet {

/// One side of an edge: facet `facet` runs along it from `low` to `high`, or back.
struct EdgeSide {
    int low = -1, high = -1;
    bool forward = true;
    int facet = -1;

    bool same_edge(const EdgeSide& other) const { return low == other.low && high == other.high; }
};

/// All sides of all facets, those of one edge together.
std::vector<EdgeSide> sorted_sides(const Solid& solid);

/// All corners are vertices of the solid.
bool has_valid_corners(const Solid& solid);

/// At least three corners, none twice.
bool has_distinct_corners(const Facet& facet);

/// Vertices whose facets form more than one fan: facets are in one fan when they share an edge that
/// ends there.
std::vector<int> pinched_vertices(const Solid& solid, const std::vector<EdgeSide>& sides);

/// Numbers that fall into groups as pairs of them are joined (Tarjan 1975).
class Groups {
public:
    explicit Groups(std::size_t count);
    int find(int i);
    void join(int i, int j) { parent_[find(i)] = find(j); }

private:
    std::vector<int> parent_;
};

}  // namespace culet
