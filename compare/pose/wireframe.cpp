#include "compare/pose/wireframe.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace culet {

namespace {

Vec3 area_middle(const Solid& solid, const Facet& facet) {
    const Vec3& first = solid.vertices[static_cast<std::size_t>(facet.corners[0])];
    Vec3 sum(0);
    double weight = 0;
    for (std::size_t i = 1; i + 1 < facet.corners.size(); ++i) {
        const Vec3& b = solid.vertices[static_cast<std::size_t>(facet.corners[i])];
        const Vec3& c = solid.vertices[static_cast<std::size_t>(facet.corners[i + 1])];
        const double area = glm::length(glm::cross(b - first, c - first));
        sum += area * (first + b + c) / 3.0;
        weight += area;
    }
    return weight > 0 ? sum / weight : first;
}

double cross(const PicturePoint& a, const PicturePoint& b) {
    return a.x * b.y - a.y * b.x;
}

PicturePoint minus(const PicturePoint& a, const PicturePoint& b) {
    return {a.x - b.x, a.y - b.y};
}

/// Distance along the normal of `point` to the nearest other edge within 45 degrees of its
/// direction; crossing edges matter only where they cross.
double gap_at(const WirePoint& point, const std::vector<WireEdge>& edges, double reach) {
    double nearest = reach;
    for (const WireEdge& other : edges) {
        if (other.edge == point.edge) continue;
        const PicturePoint along = minus(other.to, other.from);
        const double length = std::hypot(along.x, along.y);
        const double facing = along.x * point.normal_y - along.y * point.normal_x;
        if (!(std::abs(facing) > 0.7 * length) || !(length > 0)) continue;
        // at + t normal = from + s along
        const PicturePoint to_from = minus(other.from, point.at);
        const double t =
            cross(to_from, along) / (point.normal_x * along.y - point.normal_y * along.x);
        const double s = cross(to_from, {point.normal_x, point.normal_y}) /
                         (point.normal_x * along.y - point.normal_y * along.x);
        if (s < -1 / length || s > 1 + 1 / length) continue;
        nearest = std::min(nearest, std::abs(t));
    }
    return nearest;
}

/// Shift in the picture, along the edge's normal, of a point of an edge when one of its facets
/// rises by one length there.
double picture_shift(const Projection& project, const WirePoint& point, const Vec3& moved,
                     const Vec3& fixed, double small) {
    const double cosine = glm::dot(moved, fixed);
    const double sine_squared = std::max(1 - cosine * cosine, 1e-12);
    const Vec3 shift = (moved - cosine * fixed) / sine_squared;
    const PicturePoint there = project(point.on_stone + small * shift);
    return ((there.x - point.at.x) * point.normal_x + (there.y - point.at.y) * point.normal_y) /
           small;
}

}  // namespace

WireSolid::WireSolid(const Solid& solid_) : solid(solid_) {
    edges = half_edges(solid).edges;
    for (const Facet& facet : solid.facets) facet_middles.push_back(area_middle(solid, facet));
    middle = centroid(solid);
    diameter = culet::diameter(solid);
}

std::vector<char> facets_seen(const WireSolid& wire, const StoneView& view) {
    const EyePlace eye = eye_of(view);
    std::vector<char> seen;
    for (const Facet& facet : wire.solid.facets) seen.push_back(eye.sees(facet.plane) ? 1 : 0);
    return seen;
}

std::vector<WireEdge> visible_edges(const WireSolid& wire, const StoneView& view) {
    const Projection project(view);
    const std::vector<char> seen = facets_seen(wire, view);
    std::vector<PicturePoint> corners;
    corners.reserve(wire.solid.vertices.size());
    for (const Vec3& vertex : wire.solid.vertices) corners.push_back(project(vertex));
    std::vector<WireEdge> found;
    for (std::size_t e = 0; e < wire.edges.size(); ++e) {
        const Edge& edge = wire.edges[e];
        const bool left = seen[static_cast<std::size_t>(edge.left)] != 0;
        const bool right = seen[static_cast<std::size_t>(edge.right)] != 0;
        if (!left && !right) continue;
        found.push_back({static_cast<int>(e), corners[static_cast<std::size_t>(edge.from)],
                         corners[static_cast<std::size_t>(edge.to)], left != right});
    }
    return found;
}

double expected_offset(const WireSolid& wire, double facet_error) {
    return 0.15 * wire.diameter * facet_error / std::numbers::sqrt2;
}

std::vector<WirePoint> points_along(const WireSolid& wire, const StoneView& view,
                                    const WireSpacing& spacing) {
    const Projection project(view);
    const std::vector<WireEdge> edges = visible_edges(wire, view);
    const double axis_error = spacing.facet_error / std::numbers::sqrt2;
    const double small = 1e-4 * wire.diameter;
    std::vector<WirePoint> points;
    for (const WireEdge& seen : edges) {
        const Edge& edge = wire.edges[static_cast<std::size_t>(seen.edge)];
        const PicturePoint along = minus(seen.to, seen.from);
        const double length = std::hypot(along.x, along.y);
        const double inner = length - 2 * spacing.trim;
        if (!(inner > 0)) continue;
        const int count = std::max(1, static_cast<int>(std::lround(inner / spacing.step)));
        WirePoint point;
        point.edge = seen.edge;
        point.outline = seen.outline;
        point.normal_x = along.y / length;
        point.normal_y = -along.x / length;
        const PicturePoint out = minus(seen.from, project(wire.middle));
        if (out.x * point.normal_x + out.y * point.normal_y < 0) {
            point.normal_x = -point.normal_x;
            point.normal_y = -point.normal_y;
        }
        const Vec3& from = wire.solid.vertices[static_cast<std::size_t>(edge.from)];
        const Vec3& to = wire.solid.vertices[static_cast<std::size_t>(edge.to)];
        for (int i = 0; i < count; ++i) {
            const double share = (spacing.trim + inner * (i + 0.5) / count) / length;
            point.on_stone = from + share * (to - from);
            point.at = project(point.on_stone);
            double variance = 0;
            for (const bool left : {true, false}) {
                const auto moved = static_cast<std::size_t>(left ? edge.left : edge.right);
                const auto fixed = static_cast<std::size_t>(left ? edge.right : edge.left);
                const double reach = glm::length(point.on_stone - wire.facet_middles[moved]);
                const double lift = std::hypot(axis_error * reach, spacing.facet_offset);
                const double shift =
                    picture_shift(project, point, wire.solid.facets[moved].plane.normal,
                                  wire.solid.facets[fixed].plane.normal, small);
                variance += lift * shift * lift * shift;
            }
            point.facet_sigma = std::sqrt(variance);
            if (point.facet_sigma > spacing.most_facet_sigma) continue;
            point.gap = gap_at(point, edges, spacing.reach);
            points.push_back(point);
        }
    }
    return points;
}

}  // namespace culet
