#include "fit/mesh/repair.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <tuple>

#include "fit/mesh/orientation.h"
#include "fit/model/canonical.h"
#include "stone/solid/checks.h"
#include "stone/solid/half_edges.h"

namespace culet {

namespace {

// Largest tilt between hand-drawn pieces of one facet.
constexpr double k_piece_tilt_deg = 15;
// A polygon cut into triangles is warped by its corners' errors. It is one facet if its name is
// read and its pieces' names are not.
constexpr double k_triangle_tilt_deg = 40;
// Parts of the diameter: pieces narrower than this, and flatter, may face anywhere.
constexpr double k_narrow = 0.02;
// Welding compares all pairs of corners.
constexpr std::size_t k_most_corners = 8000;
// Corners further apart than this part of the diameter are distinct.
constexpr double k_weld = 0.25;

void drop_unused(Solid& solid) {
    std::vector<int> index(solid.vertices.size(), -1);
    std::vector<Vec3> used;
    for (Facet& facet : solid.facets) {
        for (int& corner : facet.corners) {
            if (index[corner] < 0) {
                index[corner] = static_cast<int>(used.size());
                used.push_back(solid.vertices[corner]);
            }
            corner = index[corner];
        }
    }
    solid.vertices = std::move(used);
}

struct NearPair {
    double distance;
    int one, other;
};

// Pairs of nearby corners that facets use, the nearest first.
std::vector<NearPair> near_pairs(const Solid& solid, const std::vector<std::set<int>>& facets) {
    std::vector<NearPair> pairs;
    const double limit = k_weld * diameter(solid);
    for (std::size_t a = 0; a < facets.size(); ++a) {
        for (std::size_t b = a + 1; b < facets.size(); ++b) {
            if (facets[a].empty() || facets[b].empty()) continue;
            const double distance = glm::length(solid.vertices[a] - solid.vertices[b]);
            if (distance < limit) pairs.push_back({distance, int(a), int(b)});
        }
    }
    std::sort(pairs.begin(), pairs.end(), [](const NearPair& a, const NearPair& b) {
        return std::tie(a.distance, a.one, a.other) < std::tie(b.distance, b.one, b.other);
    });
    return pairs;
}

// Kruskal (1956), with the rule that no facet has a corner twice.
std::optional<Solid> welded(const Solid& solid) {
    const int count = static_cast<int>(solid.vertices.size());
    if (solid.vertices.size() > k_most_corners) return std::nullopt;
    std::size_t sides = 0;
    for (const Facet& f : solid.facets) sides += f.corners.size();
    if (sides % 2 != 0) return std::nullopt;
    const int wanted = 2 + static_cast<int>(sides / 2) - static_cast<int>(solid.facets.size());
    std::vector<std::set<int>> facets(solid.vertices.size());
    for (std::size_t f = 0; f < solid.facets.size(); ++f) {
        for (int corner : solid.facets[f].corners) facets[corner].insert(int(f));
    }
    int clusters = static_cast<int>(
        std::count_if(facets.begin(), facets.end(), [](const auto& f) { return !f.empty(); }));
    std::vector<int> parent(solid.vertices.size());
    std::iota(parent.begin(), parent.end(), 0);
    const auto root = [&](int v) {
        while (parent[v] != v) v = parent[v] = parent[parent[v]];
        return v;
    };
    for (const NearPair& pair : near_pairs(solid, facets)) {
        if (clusters == wanted) break;
        const int a = root(pair.one), b = root(pair.other);
        if (a == b) continue;
        if (std::any_of(facets[a].begin(), facets[a].end(),
                        [&](int f) { return facets[b].count(f) > 0; })) {
            continue;
        }
        parent[b] = a;
        facets[a].insert(facets[b].begin(), facets[b].end());
        --clusters;
    }
    if (clusters != wanted) return std::nullopt;
    std::vector<Vec3> sum(solid.vertices.size(), Vec3(0));
    std::vector<int> members(solid.vertices.size(), 0);
    for (int v = 0; v < count; ++v) {
        sum[root(v)] += solid.vertices[v];
        ++members[root(v)];
    }
    Solid result = solid;
    for (int v = 0; v < count; ++v) result.vertices[v] = sum[root(v)] / double(members[root(v)]);
    for (Facet& facet : result.facets) {
        for (int& corner : facet.corners) corner = root(corner);
    }
    drop_unused(result);
    for (Facet& facet : result.facets) renew_plane(result, facet);
    if (!orient(result) || !is_closed(result)) return std::nullopt;
    return result;
}

std::string base_name(const std::string& name) {
    const std::size_t dot = name.rfind('.');
    if (dot == std::string::npos || dot == 0 || dot + 1 == name.size()) return name;
    return name.find_first_not_of("0123456789", dot + 1) == std::string::npos ? name.substr(0, dot)
                                                                              : name;
}

// Whether the pieces are so narrow that a rough mesh does not show which way they face, and lie in
// one plane within its error.
bool lie_flat(const Solid& solid, const std::vector<int>& pieces, const Vec3& normal, double size) {
    double low = 1e300, high = -1e300, longest = 0;
    for (const int f : pieces) {
        const Facet& facet = solid.facets[f];
        if (!(glm::dot(normal, facet.plane.normal) > 0)) return false;
        double length = 0;
        for (const int a : facet.corners) {
            low = std::min(low, glm::dot(normal, solid.vertices[a]));
            high = std::max(high, glm::dot(normal, solid.vertices[a]));
            for (const int b : facet.corners) {
                length = std::max(length, glm::length(solid.vertices[a] - solid.vertices[b]));
            }
        }
        if (!(area(solid, facet) < k_narrow * size * length)) return false;
        longest = std::max(longest, length);
    }
    return high - low < k_narrow * size && high - low < 0.1 * longest;
}

// The single outline of several facets, or empty.
std::vector<int> outline_of(const Solid& solid, const std::vector<int>& pieces) {
    std::set<std::pair<int, int>> sides;
    for (int f : pieces) {
        const std::vector<int>& loop = solid.facets[f].corners;
        for (std::size_t k = 0; k < loop.size(); ++k) {
            sides.emplace(loop[k], loop[(k + 1) % loop.size()]);
        }
    }
    std::map<int, int> next;
    for (const auto& [from, to] : sides) {
        if (sides.count({to, from}) > 0) continue;
        if (!next.emplace(from, to).second) return {};
    }
    if (next.empty()) return {};
    std::vector<int> loop;
    int at = next.begin()->first;
    do {
        loop.push_back(at);
        const auto found = next.find(at);
        if (found == next.end() || loop.size() > next.size()) return {};
        at = found->second;
    } while (at != loop.front());
    return loop.size() == next.size() ? loop : std::vector<int>();
}

// Joins the pieces of facets, and returns the facets' names.
std::vector<std::string> join_pieces(Solid& solid, const std::set<std::string>& read) {
    std::map<std::string, std::vector<int>> groups;
    for (std::size_t f = 0; f < solid.facets.size(); ++f) {
        groups[base_name(solid.facets[f].name)].push_back(static_cast<int>(f));
    }
    std::vector<std::string> joined;
    std::set<int> gone;
    const double size = diameter(solid);
    for (const auto& [name, pieces] : groups) {
        if (pieces.size() < 2 || solid.facets[pieces[0]].name != name) continue;
        // A reading of NAME.1 means a separate facet.
        if (std::any_of(pieces.begin() + 1, pieces.end(),
                        [&](int f) { return read.count(solid.facets[f].name) > 0; })) {
            continue;
        }
        Vec3 mean(0);
        for (int f : pieces) mean += area(solid, solid.facets[f]) * solid.facets[f].plane.normal;
        if (!(glm::length(mean) > 0)) continue;
        mean = glm::normalize(mean);
        const std::vector<int> outline = outline_of(solid, pieces);
        // The pieces are triangles of one polygon.
        const bool cut = outline.size() == pieces.size() + 2 && read.count(name) > 0;
        const double limit = std::cos(radians(cut ? k_triangle_tilt_deg : k_piece_tilt_deg));
        const bool alike = std::all_of(pieces.begin(), pieces.end(), [&](int f) {
            return glm::dot(mean, solid.facets[f].plane.normal) > limit;
        });
        if (!alike && !lie_flat(solid, pieces, mean, size)) continue;
        if (outline.size() < 3) continue;
        solid.facets[pieces[0]].corners = outline;
        gone.insert(pieces.begin() + 1, pieces.end());
        joined.push_back(name);
    }
    if (joined.empty()) return joined;
    std::vector<Facet> left;
    for (std::size_t f = 0; f < solid.facets.size(); ++f) {
        if (gone.count(static_cast<int>(f)) == 0) left.push_back(std::move(solid.facets[f]));
    }
    solid.facets = std::move(left);
    // A corner that only two facets share is no corner.
    std::vector<int> uses(solid.vertices.size(), 0);
    for (const Facet& facet : solid.facets) {
        for (int corner : facet.corners) ++uses[corner];
    }
    for (Facet& facet : solid.facets) {
        std::erase_if(facet.corners, [&](int corner) { return uses[corner] < 3; });
    }
    drop_unused(solid);
    for (Facet& facet : solid.facets) renew_plane(solid, facet);
    return joined;
}

}  // namespace

Repaired repaired(const Stone& stone, const std::vector<WrittenReading>& readings) {
    std::set<std::string> read;
    for (const WrittenReading& r : readings) read.insert(r.of.begin(), r.of.end());
    Repaired result{stone, {}};
    Solid& solid = result.stone.solid;
    if (solid.facets.size() < 4) return result;
    if (!is_closed(solid)) {
        const std::size_t before = solid.vertices.size();
        if (auto closed = welded(solid)) {
            solid = std::move(*closed);
            result.notes.push_back(fmt::format("the mesh was open: {} corners were welded into {}",
                                               before, solid.vertices.size()));
        }
    }
    if (!is_closed(solid)) {
        Solid turned = solid;
        if (const auto count = orient(turned); count && *count > 0 && is_closed(turned)) {
            solid = std::move(turned);
            result.notes.push_back(fmt::format("{} facet{} drawn inside out: turned round", *count,
                                               *count == 1 ? " was" : "s were"));
            result.stone.changed.push_back(facets_turned_round(result.notes.back(), *count));
        }
    }
    if (is_closed(solid) && !stone.facets_are_whole) {
        Solid whole = solid;
        const std::vector<std::string> joined = join_pieces(whole, read);
        if (!joined.empty() && whole.facets.size() >= 4 && is_closed(whole)) {
            solid = std::move(whole);
            result.notes.push_back(
                fmt::format("{} facet{} drawn in several pieces, such as {}: each is one facet now",
                            joined.size(), joined.size() == 1 ? " was" : "s were", joined[0]));
        }
    }
    if (is_closed(solid) && volume(solid) < 0 && lies_mirrored(solid, half_edges(solid))) {
        turn_round(solid);
        result.notes.push_back("the mesh was inside out: its facets were turned round");
        result.stone.changed.push_back(
            facets_turned_round(result.notes.back(), static_cast<int>(solid.facets.size())));
    }
    return result;
}

}  // namespace culet
