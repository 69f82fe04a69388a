#include "stone/solid/surface_edges.h"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

namespace culet {

std::vector<EdgeSide> sorted_sides(const Solid& solid) {
    std::vector<EdgeSide> sides;
    for (std::size_t f = 0; f < solid.facets.size(); ++f) {
        const std::vector<int>& corners = solid.facets[f].corners;
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const int a = corners[i], b = corners[(i + 1) % corners.size()];
            sides.push_back({std::min(a, b), std::max(a, b), a < b, static_cast<int>(f)});
        }
    }
    std::sort(sides.begin(), sides.end(), [](const EdgeSide& a, const EdgeSide& b) {
        return std::tie(a.low, a.high, a.forward, a.facet) <
               std::tie(b.low, b.high, b.forward, b.facet);
    });
    return sides;
}

bool has_valid_corners(const Solid& solid) {
    const int count = static_cast<int>(solid.vertices.size());
    return std::all_of(solid.facets.begin(), solid.facets.end(), [&](const Facet& facet) {
        return std::all_of(facet.corners.begin(), facet.corners.end(),
                           [&](int c) { return c >= 0 && c < count; });
    });
}

bool has_distinct_corners(const Facet& facet) {
    std::vector<int> corners = facet.corners;
    std::sort(corners.begin(), corners.end());
    return corners.size() >= 3 &&
           std::adjacent_find(corners.begin(), corners.end()) == corners.end();
}

std::vector<int> pinched_vertices(const Solid& solid, const std::vector<EdgeSide>& sides) {
    // A facet's corner is a pair (vertex, facet); an edge joins the corners at both its ends.
    std::vector<std::pair<int, int>> wedges;
    for (std::size_t f = 0; f < solid.facets.size(); ++f) {
        for (const int corner : solid.facets[f].corners) {
            wedges.emplace_back(corner, static_cast<int>(f));
        }
    }
    std::sort(wedges.begin(), wedges.end());
    const auto wedge = [&](int vertex, int facet) {
        return static_cast<int>(
            std::lower_bound(wedges.begin(), wedges.end(), std::pair(vertex, facet)) -
            wedges.begin());
    };
    Groups fans(wedges.size());
    for (std::size_t i = 1; i < sides.size(); ++i) {
        if (!sides[i - 1].same_edge(sides[i])) continue;
        for (const int end : {sides[i].low, sides[i].high}) {
            fans.join(wedge(end, sides[i - 1].facet), wedge(end, sides[i].facet));
        }
    }
    std::vector<int> pinched;
    for (std::size_t i = 1; i < wedges.size(); ++i) {
        if (wedges[i - 1].first == wedges[i].first &&
            fans.find(static_cast<int>(i) - 1) != fans.find(static_cast<int>(i)) &&
            (pinched.empty() || pinched.back() != wedges[i].first)) {
            pinched.push_back(wedges[i].first);
        }
    }
    return pinched;
}

Groups::Groups(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0);
}

int Groups::find(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
}

}  // namespace culet
