#include "stone/design/cut_parts.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>
#include <map>

namespace culet {

namespace {

// Relative to a girdle facet's extent: corners above each other.
constexpr double k_above = 1e-6;

using Edge = std::pair<int, int>;
using FacetBehind = std::map<Edge, int>;  // by its directed edges

FacetBehind facets_by_edge(const Solid& solid) {
    FacetBehind facet;
    for (std::size_t f = 0; f < solid.facets.size(); ++f) {
        const std::vector<int>& loop = solid.facets[f].corners;
        for (std::size_t i = 0; i < loop.size(); ++i)
            facet[{loop[i], loop[(i + 1) % loop.size()]}] = int(f);
    }
    return facet;
}

bool contains(const std::vector<int>& list, int value) {
    return std::find(list.begin(), list.end(), value) != list.end();
}

// Edges between two facets of one side that are no mains, from a corner of two mains to the rim.
std::vector<Edge> edges_between_halves(const Solid& solid, const CutRoles& roles,
                                       const FacetBehind& facets, const std::set<int>& rim,
                                       bool crown) {
    const std::vector<int>& mains = crown ? roles.crown_mains : roles.pavilion_mains;
    const StonePart side = crown ? StonePart::crown : StonePart::pavilion;
    const auto is_half = [&](int f) {
        return roles.parts[std::size_t(f)] == side && !contains(mains, f);
    };
    std::vector<Edge> edges;
    for (const auto& [edge, f] : facets) {
        const auto other = facets.find({edge.second, edge.first});
        if (other == facets.end() || !is_half(f) || !is_half(other->second)) continue;
        if (rim.contains(edge.first) || !rim.contains(edge.second)) continue;
        const int tip = edge.first;
        const auto touching = std::count_if(mains.begin(), mains.end(), [&](int main) {
            return contains(solid.facets[std::size_t(main)].corners, tip);
        });
        if (touching >= 2) edges.push_back(edge);
    }
    return edges;
}

Vec3 level_along(const Solid& solid, int facet) {
    const Vec3& n = solid.facets[std::size_t(facet)].plane.normal;
    return glm::normalize(Vec3{-n.y, n.x, 0});
}

}  // namespace

std::set<int> rim_of(const Solid& solid, const CutRoles& roles, bool crown) {
    std::set<int> girdle, side, other;
    for (std::size_t f = 0; f < solid.facets.size(); ++f) {
        const std::vector<int>& loop = solid.facets[f].corners;
        const StonePart part = roles.parts[f];
        const bool is_above = part == StonePart::table || part == StonePart::crown;
        (part == StonePart::girdle ? girdle
         : is_above == crown       ? side
                                   : other)
            .insert(loop.begin(), loop.end());
    }
    const std::set<int>& against = girdle.empty() ? other : girdle;
    std::set<int> both;
    std::set_intersection(side.begin(), side.end(), against.begin(), against.end(),
                          std::inserter(both, both.end()));
    return both;
}

std::vector<StarTip> star_tips(const Solid& solid, const CutRoles& roles,
                               const std::set<int>& rim) {
    const FacetBehind facets = facets_by_edge(solid);
    std::map<int, Edge> table_edge;  // of each facet beside the table
    for (const auto& [edge, f] : facets) {
        const auto other = facets.find({edge.second, edge.first});
        if (other != facets.end() && roles.parts[std::size_t(other->second)] == StonePart::table)
            table_edge[f] = edge;
    }
    std::vector<StarTip> tips;
    for (const auto& [tip, girdle] : edges_between_halves(solid, roles, facets, rim, true)) {
        for (const auto& [star, edge] : table_edge) {
            if (!contains(roles.crown_mains, star) &&
                contains(solid.facets[std::size_t(star)].corners, tip))
                tips.push_back({{edge.first, edge.second}, tip, girdle});
        }
    }
    return tips;
}

std::vector<HalfTip> half_tips(const Solid& solid, const CutRoles& roles,
                               const std::set<int>& rim) {
    std::vector<HalfTip> tips;
    for (const auto& [tip, girdle] :
         edges_between_halves(solid, roles, facets_by_edge(solid), rim, false))
        tips.push_back({girdle, tip});
    return tips;
}

double Chord::length(const std::vector<Vec3>& at) const {
    const Vec3 &c = at[std::size_t(corner)], &a = at[std::size_t(across[0])],
               &b = at[std::size_t(across[1])];
    const Vec3 step{b.x - a.x, b.y - a.y, 0};
    const double run = glm::dot(step, step);
    const double part = run > 0 ? glm::dot(Vec3{c.x - a.x, c.y - a.y, 0}, step) / run : 0;
    return sign * (a.z + part * (b.z - a.z) - c.z);
}

std::vector<Chord> girdle_chords(const Solid& solid, const CutRoles& roles) {
    std::vector<Chord> chords;
    for (std::size_t f = 0; f < solid.facets.size(); ++f) {
        if (roles.parts[f] != StonePart::girdle) continue;
        const std::vector<int>& loop = solid.facets[f].corners;
        const Vec3 u = level_along(solid, int(f));
        std::vector<double> x;
        for (const int c : loop) x.push_back(glm::dot(u, solid.vertices[std::size_t(c)]));
        const auto [low, high] = std::minmax_element(x.begin(), x.end());
        const double same = k_above * (*high - *low);
        const auto z = [&](std::size_t k) { return solid.vertices[std::size_t(loop[k])].z; };
        for (std::size_t i = 0; i < loop.size(); ++i) {
            Chord chord{int(f), loop[i], {loop[i], loop[i]}, 1};
            double farthest = 0;  // beside corners that a meet has twice
            for (std::size_t k = 0; k < loop.size(); ++k) {
                const std::size_t next = (k + 1) % loop.size();
                const double from = x[k] - x[i], to = x[next] - x[i];
                const double above = std::abs(z(k) - z(i));
                if (std::abs(from) <= same && above > farthest) {
                    farthest = above;
                    chord.across = {loop[k], loop[k]};
                } else if (std::min(std::abs(from), std::abs(to)) > same && from * to < 0) {
                    chord.across = {loop[k], loop[next]};
                    break;
                }
            }
            if (chord.length(solid.vertices) < 0) chord.sign = -1;
            chords.push_back(chord);
        }
    }
    return chords;
}

std::vector<GirdleFlat> girdle_flats(const Solid& solid, const CutRoles& roles) {
    std::vector<GirdleFlat> flats;
    for (std::size_t f = 0; f < solid.facets.size(); ++f) {
        if (roles.parts[f] != StonePart::girdle) continue;
        const Vec3 u = level_along(solid, int(f));
        const std::vector<int>& loop = solid.facets[f].corners;
        const auto [low, high] = std::minmax_element(loop.begin(), loop.end(), [&](int a, int b) {
            return glm::dot(u, solid.vertices[std::size_t(a)]) <
                   glm::dot(u, solid.vertices[std::size_t(b)]);
        });
        flats.push_back({loop, {*low, *high}});
    }
    return flats;
}

double mean_thickness(const std::vector<GirdleFlat>& flats, const std::vector<Vec3>& at) {
    double area = 0, extent = 0;
    for (const GirdleFlat& flat : flats) {
        const Vec3 &from = at[std::size_t(flat.ends[0])], &to = at[std::size_t(flat.ends[1])];
        const double run = std::hypot(to.x - from.x, to.y - from.y);
        const Vec3 u = Vec3{to.x - from.x, to.y - from.y, 0} / run;
        extent += run;
        for (std::size_t i = 0; i < flat.corners.size(); ++i) {
            const Vec3 &a = at[std::size_t(flat.corners[i])],
                       &b = at[std::size_t(flat.corners[(i + 1) % flat.corners.size()])];
            area += 0.5 * (glm::dot(u, a - from) * b.z - glm::dot(u, b - from) * a.z);
        }
    }
    return area / extent;
}

}  // namespace culet
