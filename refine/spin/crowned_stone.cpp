#include "refine/spin/crowned_stone.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>

#include "refine/spin/crown.h"
#include "stone/numbers/units.h"
#include "stone/numbers/upper_median.h"

namespace culet {

namespace {

constexpr double k_cut_off = 0.008;  // of the width: what a new facet may take from seen corners
constexpr double k_opposite = radians(12.0);
// What outlines alone put in the table's place is less inclined to it.
constexpr double k_table = radians(12.0);
const double k_upright = std::sin(radians(10.0));
constexpr double k_least_sigma = 0.125;  // pixels: half a step of the sweep's last refinement
constexpr double k_compared_edge = 3.2;

// Half of how far edges lie apart in halves of the frames.
double edge_sigma(const std::vector<SweptSide>& sides,
                  const std::vector<std::vector<SurfaceEdge>>& edges,
                  const std::vector<SweptFrame>& frames) {
    std::array<std::vector<SweptFrame>, 2> halves;
    for (std::size_t f = 0; f < frames.size(); ++f) halves[f % 2].push_back(frames[f]);
    std::vector<double> apart;
    for (std::size_t s = 0; s < sides.size(); ++s) {
        for (const SurfaceEdge& e : edges[s]) {
            if (e.strength < k_compared_edge) continue;
            const SurfaceEdge a = found_again(halves[0], sides[s], e),
                              b = found_again(halves[1], sides[s], e);
            apart.push_back(std::abs(a.radius - b.radius));
            apart.push_back(std::abs(a.height - b.height));
        }
    }
    if (apart.empty()) return k_least_sigma;
    return std::max(k_least_sigma, 1.4826 * upper_median(apart) / 2);
}

// A girdle that no outline shows is taken as upright, below the crown's outermost edge.
std::optional<CrownFacet> girdle_below(const Crown& crown, const Plane& guess) {
    if (std::abs(guess.normal.z) > k_upright) return std::nullopt;
    for (const SurfaceEdge& e : crown.outermost) {
        const Vec3 out{std::cos(e.azimuth), std::sin(e.azimuth), 0};
        if (angle_between(out, guess.normal) < k_opposite)
            return CrownFacet{{out, e.radius}, 0, {e}};
    }
    return std::nullopt;
}

// Whether the plane cuts off corners at which only seen facets meet.
bool contradicts(const Plane& plane, const Solid& solid, const std::vector<bool>& seen) {
    const double most = k_cut_off * width_along(solid, {1, 0, 0});
    std::vector<bool> is_seen(solid.vertices.size(), true);
    for (std::size_t f = 0; f < solid.facets.size(); ++f) {
        for (const int c : solid.facets[f].corners)
            if (!seen[f]) is_seen[std::size_t(c)] = false;
    }
    for (std::size_t c = 0; c < is_seen.size(); ++c) {
        if (is_seen[c] && height_above(plane, solid.vertices[c]) > most) return true;
    }
    return false;
}

}  // namespace

std::optional<CrownedStone> crowned(const Solid& solid, const std::vector<bool>& seen,
                                    const std::vector<double>& tilt_sigmas,
                                    const std::vector<SweptFrame>& frames) {
    const double width = width_along(solid, {1, 0, 0});
    const std::vector<SweptSide> sides = sides_of(solid, seen);
    std::vector<std::vector<SurfaceEdge>> edges;
    for (const SweptSide& side : sides) edges.push_back(surface_edges(frames, side));
    CrownedStone stone;
    stone.edge_sigma = edge_sigma(sides, edges, frames);
    const std::optional<Crown> crown = crown_of(edges, width, stone.edge_sigma);
    if (!crown || contradicts(crown->table.plane, solid, seen)) return std::nullopt;
    std::vector<NamedPlane> planes{{"T", crown->table.plane}};
    std::map<std::string, double> sigmas{{"T", crown->table.tilt_sigma}};
    stone.edges_of["T"] = crown->table.edges;
    for (const CrownFacet& f : crown->facets) {
        if (contradicts(f.plane, solid, seen)) continue;
        planes.push_back({fmt::format("C{}", planes.size()), f.plane});
        sigmas[planes.back().name] = f.tilt_sigma;
        stone.edges_of[planes.back().name] = f.edges;
    }
    stone.edges = int(crown->table.edges.size() + planes.size() - 1);
    for (std::size_t f = 0; f < solid.facets.size(); ++f) {
        // Guessed planes that close the stone below stay; above, table and crown are known now.
        const Vec3& normal = solid.facets[f].plane.normal;
        if (!seen[f] && normal.z > 0) continue;
        if (angle_between(normal, crown->table.plane.normal) < k_table) continue;
        planes.push_back({solid.facets[f].name, solid.facets[f].plane});
        if (const auto girdle =
                seen[f] ? std::nullopt : girdle_below(*crown, solid.facets[f].plane)) {
            planes.back() = {fmt::format("C{}", planes.size()), girdle->plane};
            stone.edges_of[planes.back().name] = girdle->edges;
        }
        sigmas[planes.back().name] = tilt_sigmas[f];
    }
    HalfSpaceSolid body = intersect_half_spaces(planes);
    stone.solid = std::move(body.solid);
    if (stone.solid.facets.empty()) return std::nullopt;
    std::map<std::string, bool> is_seen;
    for (std::size_t f = 0; f < solid.facets.size(); ++f) is_seen[solid.facets[f].name] = seen[f];
    for (std::size_t f = 0; f < stone.solid.facets.size(); ++f) {
        const std::string& name = stone.solid.facets[f].name;
        stone.tilt_sigmas.push_back(sigmas[name]);
        const auto found = is_seen.find(name);
        if (found != is_seen.end() && !found->second) stone.unseen.push_back(int(f));
    }
    stone.table_tilt = angle_between(crown->table.plane.normal, Vec3(0, 0, 1));
    return stone;
}

}  // namespace culet
