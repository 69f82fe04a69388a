// Collapses edges of a mesh.

#include <algorithm>
#include <map>
#include <set>

#include "fit/hypotheses/topology.h"
#include "stone/solid/checks.h"
#include "stone/solid/surface_edges.h"

namespace culet {

namespace {

// Corners of only two facets are points on an edge.
bool drop_idle_corners(Solid& solid) {
    std::vector<std::set<int>> facets(solid.vertices.size());
    for (std::size_t f = 0; f < solid.facets.size(); ++f) {
        for (int c : solid.facets[f].corners) facets[std::size_t(c)].insert(int(f));
    }
    bool dropped = false;
    for (Facet& facet : solid.facets) {
        dropped = std::erase_if(facet.corners,
                                [&](int c) { return facets[std::size_t(c)].size() < 3; }) > 0 ||
                  dropped;
    }
    return dropped;
}

bool drop_flat_facets(Solid& solid) {
    bool dropped = false;
    for (Facet& facet : solid.facets) {
        std::vector<int>& loop = facet.corners;
        loop.erase(std::unique(loop.begin(), loop.end()), loop.end());
        while (loop.size() > 1 && loop.front() == loop.back()) loop.pop_back();
    }
    dropped = std::erase_if(solid.facets, [](const Facet& f) { return f.corners.size() < 3; }) > 0;
    return dropped;
}

// Two facets share at most one edge, and no corner occurs twice.
bool is_sound(const Solid& solid) {
    std::map<std::pair<int, int>, int> shared;
    for (const Facet& facet : solid.facets) {
        if (!has_distinct_corners(facet)) return false;
    }
    if (!is_closed(solid)) return false;
    const std::vector<EdgeSide> sides = sorted_sides(solid);
    for (std::size_t i = 0; i + 1 < sides.size(); i += 2) {
        if (++shared[std::minmax(sides[i].facet, sides[i + 1].facet)] > 1) return false;
    }
    return solid.facets.size() >= 4;
}

}  // namespace

Solid with_collapsed_edges(const Solid& solid, const std::vector<std::pair<int, int>>& edges) {
    Groups groups(solid.vertices.size());
    for (const auto& [a, b] : edges) groups.join(a, b);
    std::vector<Vec3> sums(solid.vertices.size(), Vec3(0));
    std::vector<double> counts(solid.vertices.size(), 0);
    for (std::size_t v = 0; v < solid.vertices.size(); ++v) {
        const std::size_t g = std::size_t(groups.find(int(v)));
        sums[g] += solid.vertices[v];
        counts[g] += 1;
    }
    Solid result = solid;
    for (Facet& facet : result.facets) {
        for (int& c : facet.corners) c = groups.find(c);
    }
    for (std::size_t v = 0; v < sums.size(); ++v) {
        if (counts[v] > 0) result.vertices[v] = sums[v] / counts[v];
    }
    bool busy = true;
    while (busy) {
        busy = drop_flat_facets(result);
        busy = drop_idle_corners(result) || busy;
    }
    std::vector<int> renumbered(result.vertices.size(), -1);
    std::vector<Vec3> kept;
    for (Facet& facet : result.facets) {
        for (int& c : facet.corners) {
            int& number = renumbered[std::size_t(c)];
            if (number < 0) {
                number = int(kept.size());
                kept.push_back(result.vertices[std::size_t(c)]);
            }
            c = number;
        }
    }
    result.vertices = std::move(kept);
    return is_sound(result) ? result : Solid();
}

}  // namespace culet
