// Tests whether a solid is convex.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "stone/solid/checks.h"
#include "stone/solid/exact_sides.h"
#include "stone/solid/half_edges.h"
#include "stone/solid/outline.h"

namespace culet {

namespace {

/// Solid angle of a facet's corner fan, positive when it faces away from `eye` (Van Oosterom and
/// Strackee 1983).
double solid_angle(const Solid& solid, const Facet& facet, const Vec3& eye) {
    double sum = 0;
    const Vec3 a = glm::normalize(solid.vertices[facet.corners[0]] - eye);
    for (std::size_t i = 1; i + 1 < facet.corners.size(); ++i) {
        const Vec3 b = glm::normalize(solid.vertices[facet.corners[i]] - eye);
        const Vec3 c = glm::normalize(solid.vertices[facet.corners[i + 1]] - eye);
        sum += 2 * std::atan2(glm::dot(a, glm::cross(b, c)),
                              1 + glm::dot(a, b) + glm::dot(b, c) + glm::dot(c, a));
    }
    return sum;
}

/// Facets that share an edge. Empty when the solid is small enough to test every corner against
/// every facet.
std::vector<std::vector<int>> tested_neighbours(const Solid& solid) {
    constexpr std::size_t k_most_tests = 100'000'000;
    if (solid.facets.size() * solid.vertices.size() <= k_most_tests) return {};
    std::vector<std::vector<int>> neighbours(solid.facets.size());
    for (const Edge& edge : half_edges(solid).edges) {
        neighbours[edge.left].push_back(edge.right);
        neighbours[edge.right].push_back(edge.left);
    }
    return neighbours;
}

}  // namespace

// Three conditions:
// - (1) Each outline is convex.
// - (2) No corner lies above a facet's plane. For exactness that is the plane through three of the
//   facet's corners. The facet's own corners are not tested, since rounding puts a fourth one a
//   little off.
// - (3) Seen from inside, the facets cover every direction exactly once.
//
// Where (1) or (2) fails, a corner may be off by as much as this solid's corners are off their own
// facets' planes, at most `k_largest_miss` of the diameter: the edges of a design with near-miss
// meets are not defined any better. The corners of a fitted stone miss by rounding only, so a
// flipped edge, which folds an outline back by the edge's length, is always refused.
//
// A surface that is star-shaped by (3) is convex if it is convex along each edge. For meshes of
// very many facets (2) therefore tests neighbours only.
bool is_convex(const Solid& solid) {
    if (!is_closed(solid)) return false;
    const double allowance = std::min(planarity(solid), k_largest_miss * diameter(solid));
    const Vec3 middle = centroid(solid);
    // The volume of a self-crossing surface may nearly vanish and its centroid lie anywhere. A
    // convex solid has no corner strictly inside.
    if (!std::isfinite(middle.x + middle.y + middle.z)) return false;
    double seen = 0;
    const std::vector<std::vector<int>> neighbours = tested_neighbours(solid);
    std::vector<bool> on_facet(solid.vertices.size());
    for (std::size_t f = 0; f < solid.facets.size(); ++f) {
        const Facet& facet = solid.facets[f];
        std::vector<Vec3> loop;
        for (const int corner : facet.corners) loop.push_back(solid.vertices[corner]);
        if (std::find(loop.begin(), loop.end(), middle) != loop.end()) return false;
        const Plane own = plane_through(loop);
        if (own.normal == Vec3{0, 0, 0}) return false;
        if (!is_convex_outline(flat_outline(solid, facet, own.normal), allowance)) return false;

        const CornerTriple corners = spread_corners(solid, facet);
        for (const int corner : facet.corners) on_facet[corner] = true;
        const auto lies_above = [&](std::size_t v) {
            const Vec3& vertex = solid.vertices[v];
            return !on_facet[v] && side_of_plane(corners.a, corners.b, corners.c, vertex) > 0 &&
                   !(height_above(facet.plane, vertex) <= allowance);
        };
        if (neighbours.empty()) {
            for (std::size_t v = 0; v < solid.vertices.size(); ++v) {
                if (lies_above(v)) return false;
            }
        } else {
            for (const int other : neighbours[f]) {
                for (const int corner : solid.facets[other].corners) {
                    if (lies_above(corner)) return false;
                }
            }
        }
        for (const int corner : facet.corners) on_facet[corner] = false;
        seen += solid_angle(solid, facet, middle);
    }
    return std::abs(seen - 4 * std::numbers::pi) < 1;
}

namespace {

double distance_to_facet(const Solid& solid, const Facet& facet, const Vec3& point) {
    double to_edge = std::numeric_limits<double>::infinity();
    bool above = true;  // of the facet itself, not of a place beside it
    for (std::size_t i = 0; i < facet.corners.size(); ++i) {
        const auto corner = [&](std::size_t k) {
            return solid.vertices[std::size_t(facet.corners[k % facet.corners.size()])];
        };
        const Vec3 a = corner(i), side = corner(i + 1) - a, to = point - a;
        if (glm::dot(glm::cross(facet.plane.normal, side), to) < 0) above = false;
        const double length2 = glm::dot(side, side);
        const double t = length2 > 0 ? std::clamp(glm::dot(to, side) / length2, 0.0, 1.0) : 0;
        to_edge = std::min(to_edge, glm::length(to - t * side));
    }
    return above ? std::abs(height_above(facet.plane, point)) : to_edge;
}

}  // namespace

double distance_from_planes_body(const Solid& solid) {
    std::vector<NamedPlane> planes;
    for (const Facet& facet : solid.facets) planes.push_back({facet.name, facet.plane});
    const Solid body = intersect_half_spaces(planes).solid;
    if (body.facets.empty()) return std::numeric_limits<double>::infinity();
    double largest = 0;
    for (const Vec3& corner : solid.vertices) {
        double nearest = std::numeric_limits<double>::infinity();
        bool outside = false;
        for (const Facet& facet : body.facets) {
            if (height_above(facet.plane, corner) <= 0) continue;
            outside = true;
            nearest = std::min(nearest, distance_to_facet(body, facet, corner));
        }
        if (outside) largest = std::max(largest, nearest);
    }
    return largest;
}

}  // namespace culet
