#include "stone/setting/gap.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "stone/solid/facet_triangles.h"

namespace culet {

namespace {

double squared(const Vec3& v) {
    return glm::dot(v, v);
}

double from_point_to_edge(const Vec3& p, const Vec3& a, const Vec3& b) {
    const Vec3 side = b - a;
    const double length = squared(side);
    const double t = length > 0 ? std::clamp(glm::dot(p - a, side) / length, 0.0, 1.0) : 0.0;
    return squared(a + t * side - p);
}

// The squared distance.
double between_edges(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const Vec3 u = b - a, v = d - c, w = a - c;
    const double uu = squared(u), vv = squared(v), uv = glm::dot(u, v);
    const double uw = glm::dot(u, w), vw = glm::dot(v, w);
    const double determinant = uu * vv - uv * uv;
    double nearest = std::min({from_point_to_edge(a, c, d), from_point_to_edge(b, c, d),
                               from_point_to_edge(c, a, b), from_point_to_edge(d, a, b)});
    if (determinant > 1e-14 * uu * vv) {
        const double s = (uv * vw - vv * uw) / determinant, t = (uu * vw - uv * uw) / determinant;
        if (s > 0 && s < 1 && t > 0 && t < 1)
            nearest = std::min(nearest, squared(w + s * u - t * v));
    }
    return nearest;
}

// The squared distance; infinite if the corner is not over the face.
double over_face(const Vec3& p, const Triangle& t) {
    const Vec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
    const double length = squared(normal);
    if (!(length > 0)) return INFINITY;
    for (int i = 0; i < 3; ++i) {
        if (glm::dot(glm::cross(t[(i + 1) % 3] - t[i], p - t[i]), normal) < 0) return INFINITY;
    }
    const double height = glm::dot(p - t[0], normal);
    return height * height / length;
}

bool pierces(const Vec3& a, const Vec3& b, const Triangle& t) {
    const Vec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
    const double from = glm::dot(a - t[0], normal), to = glm::dot(b - t[0], normal);
    if ((from > 0) == (to > 0) && from != 0 && to != 0) return false;
    if (from == to) return false;
    return over_face(a + from / (from - to) * (b - a), t) < INFINITY;
}

}  // namespace

double distance_between(const Triangle& a, const Triangle& b) {
    double nearest = INFINITY;
    for (int i = 0; i < 3; ++i) {
        if (pierces(a[i], a[(i + 1) % 3], b) || pierces(b[i], b[(i + 1) % 3], a)) return 0;
        nearest = std::min({nearest, over_face(a[i], b), over_face(b[i], a)});
        for (int j = 0; j < 3; ++j)
            nearest = std::min(nearest, between_edges(a[i], a[(i + 1) % 3], b[j], b[(j + 1) % 3]));
    }
    return std::sqrt(nearest);
}

StoneSurface::StoneSurface(const Solid& solid) {
    for (const Facet& facet : solid.facets) {
        for (const auto& t : facet_triangles(solid, facet)) {
            triangles_.push_back(
                {solid.vertices[t[0]], solid.vertices[t[1]], solid.vertices[t[2]]});
            boxes_.push_back(box_of(triangles_.back()));
        }
    }
}

StoneSurface::Box StoneSurface::box_of(const Triangle& t) {
    return {glm::min(glm::min(t[0], t[1]), t[2]), glm::max(glm::max(t[0], t[1]), t[2])};
}

double StoneSurface::squared_distance(const Box& a, const Box& b) {
    const Vec3 apart = glm::max(glm::max(a.low - b.high, b.low - a.high), Vec3(0, 0, 0));
    return squared(apart);
}

double StoneSurface::distance_to(const Shell& shell, double up_to) const {
    double nearest = up_to;
    for (const auto& corners : shell.triangles) {
        const Triangle metal{shell.vertices[corners[0]], shell.vertices[corners[1]],
                             shell.vertices[corners[2]]};
        const Box box = box_of(metal);
        for (std::size_t i = 0; i < triangles_.size(); ++i) {
            if (squared_distance(box, boxes_[i]) >= nearest * nearest) continue;
            nearest = std::min(nearest, distance_between(metal, triangles_[i]));
        }
    }
    return nearest;
}

}  // namespace culet
