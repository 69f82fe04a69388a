// Where rays that start on the surface of a PolyhedronBody hit it again.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <span>
#include <vector>

#include "render/geometry/polyhedron_body.h"

namespace culet {

BodyHit PolyhedronBody::exit(const Vec3& origin, const Vec3& direction, int from) const {
    return run(origin, direction, from, true).value_or(BodyHit{std::max(from, 0), 0});
}

std::optional<BodyHit> PolyhedronBody::reentry(const Vec3& origin, const Vec3& direction,
                                               int from) const {
    // It runs away from a plane with the whole stone behind it.
    if (from >= 0 && outermost_[static_cast<std::size_t>(from)] &&
        glm::dot(normal(from), direction) > 0)
        return std::nullopt;
    return run(origin, direction, from, false);
}

namespace {

// Follows the crossings from `next` on until the ray is no longer `inside`; `depth` is its depth
// before.
std::optional<BodyHit> follow(std::span<const LineCrossing> crossings, std::size_t next, int depth,
                              bool inside) {
    for (; next < crossings.size(); ++next) {
        depth += crossings[next].step;
        if ((depth > 0) != inside) {
            return BodyHit{crossings[next].facet, std::max(crossings[next].distance, 0.0)};
        }
    }
    return std::nullopt;
}

}  // namespace

// Finds where a ray that runs inside (or outside) the stone hits the surface.
std::optional<BodyHit> PolyhedronBody::run(const Vec3& origin, const Vec3& direction, int from,
                                           bool inside) const {
    const auto found = trace(origin, direction, from);
    int depth = 0;
    for (std::size_t i = 0; i < found.size(); ++i) {
        depth += found[i].step;
        if (found[i].facet != from) continue;
        if ((found[i].step > 0) != inside) break;
        if ((depth > 0) == inside) return follow(found, i + 1, depth, inside);
        // Rounding swapped this crossing with an almost equally near one.
        while (i-- > 0) {
            if ((found[i].step > 0) != inside) return BodyHit{found[i].facet, 0};
        }
        break;
    }
    return run_from_beside(origin, direction, from, inside, found);
}

// Distance between the line and the facet's outline, across the line.
double PolyhedronBody::miss_of(std::size_t facet, const Vec3& origin, const Vec3& direction) const {
    const Vec3 along = glm::normalize(direction);
    const auto across = [&](int vertex) {
        const std::size_t v = static_cast<std::size_t>(vertex);
        const Vec3 arm = Vec3{coordinates_[0][v], coordinates_[1][v], coordinates_[2][v]} - origin;
        return arm - glm::dot(arm, along) * along;
    };
    double miss = std::numeric_limits<double>::infinity();
    Vec3 a = across(corners_[facet].back());
    for (const int corner : corners_[facet]) {
        const Vec3 b = across(corner);
        const Vec3 edge = b - a;
        const double length2 = glm::dot(edge, edge);
        const double part = length2 > 0 ? std::clamp(-glm::dot(a, edge) / length2, 0.0, 1.0) : 0;
        miss = std::min(miss, glm::length(a + part * edge));
        a = b;
    }
    return miss;
}

// The ray does not cross the facet where it starts. Its start is on the right side, or rounding put
// it on the wrong one; then the shortest move back decides: forwards, backwards, or sideways over
// the edge of a facet that it runs against.
std::optional<BodyHit> PolyhedronBody::run_from_beside(
    const Vec3& origin, const Vec3& direction, int from, bool inside,
    std::span<const LineCrossing> crossings) const {
    int depth = 0;
    std::size_t next = 0;
    while (next < crossings.size() && crossings[next].distance <= 0) {
        depth += crossings[next++].step;
    }
    if ((depth > 0) == inside) return follow(crossings, next, depth, inside);

    std::optional<BodyHit> hit;
    double shortest = std::numeric_limits<double>::infinity();
    for (std::size_t i = next; i-- > 0;) {
        if ((crossings[i].step > 0) == inside) continue;
        shortest = -crossings[i].distance;
        hit = BodyHit{crossings[i].facet, 0};
        break;
    }
    for (std::size_t i = next; i < crossings.size(); ++i) {
        depth += crossings[i].step;
        if ((depth > 0) != inside) continue;
        if (crossings[i].distance < shortest) {
            shortest = crossings[i].distance;
            hit = follow(crossings, i + 1, depth, inside);
        }
        break;
    }
    // Moves are compared in lengths of the direction.
    const double inverse_length = 1 / glm::length(direction);
    double nearest = std::numeric_limits<double>::infinity();
    const auto move_over_edges = [&](const std::vector<int>& facets) {
        for (const int facet : facets) {
            const std::size_t f = static_cast<std::size_t>(facet);
            const double towards = glm::dot(normals_[f], direction);
            if (inside ? !(towards > 0) : !(towards < 0)) continue;
            const double distance = distance_to(f, origin, direction);
            const double move = std::hypot(miss_of(f, origin, direction) * inverse_length,
                                           std::max(-distance, 0.0));
            if (move < shortest || (move == shortest && distance < nearest)) {
                shortest = move;
                nearest = distance;
                hit = BodyHit{facet, std::max(distance, 0.0)};
            }
        }
    };
    if (from >= 0) move_over_edges(vertex_sharers_[static_cast<std::size_t>(from)]);
    if (from < 0 || (inside && !hit)) move_over_edges(all_);
    return hit;
}

}  // namespace culet
