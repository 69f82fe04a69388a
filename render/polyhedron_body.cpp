#include "render/polyhedron_body.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace culet {

namespace {

// A vertex seen along the ray: across (u, v), and along it in units of its direction.
struct Projected {
    double u, v, t;
};

// Buffers of one thread, so that no ray allocates.
struct Scratch {
    std::vector<Projected> seen;
    std::vector<PolyhedronBody::Crossing> crossings;
};
Scratch& scratch() {
    thread_local Scratch buffers;
    return buffers;
}

// Share of the directed edge a -> b in the winding number about the origin: does it cross the
// positive u axis, and which way? The question is put to the edge from its lower to its higher
// vertex, so that the facets on its two sides get the same answer with opposite signs.
int winding(const Projected& a, const Projected& b, bool a_is_lower) {
    const bool up = a.v <= 0 && b.v > 0, down = a.v > 0 && b.v <= 0;
    if (!up && !down) return 0;
    const Projected &low = a_is_lower ? a : b, &high = a_is_lower ? b : a;
    const double side = low.u * high.v - high.u * low.v;
    const bool rises = low.v <= 0;
    const bool right = rises ? side > 0 : side < 0;
    return right ? (up ? 1 : -1) : 0;
}

}  // namespace

PolyhedronBody::PolyhedronBody(const Solid& solid) : vertices_(solid.vertices) {
    for (const Facet& facet : solid.facets) {
        Face face;
        face.plane = facet.plane;
        face.first = static_cast<int>(corners_.size());
        face.count = static_cast<int>(facet.corners.size());
        for (const auto corner : facet.corners) {
            corners_.push_back(static_cast<int>(corner));
            face.center +=
                vertices_[static_cast<std::size_t>(corner)] / static_cast<double>(face.count);
        }
        for (const auto corner : facet.corners) {
            face.radius =
                std::max(face.radius,
                         glm::distance(face.center, vertices_[static_cast<std::size_t>(corner)]));
        }
        faces_.push_back(face);
    }
}

void PolyhedronBody::cross(const Vec3& origin, const Vec3& direction,
                           std::vector<Crossing>& crossings) const {
    crossings.clear();
    // Sheared along the axis that the ray runs along most (Woop, Benthin & Wald 2013).
    int k = 0;
    for (int axis = 1; axis < 3; ++axis) {
        if (std::abs(direction[axis]) > std::abs(direction[k])) k = axis;
    }
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    const double shear_i = direction[i] / direction[k], shear_j = direction[j] / direction[k];
    std::vector<Projected>& seen = scratch().seen;
    seen.resize(vertices_.size());
    for (std::size_t v = 0; v < vertices_.size(); ++v) {
        const Vec3 to = vertices_[v] - origin;
        seen[v] = {to[i] - shear_i * to[k], to[j] - shear_j * to[k], glm::dot(to, direction)};
    }
    const int forwards = direction[k] > 0 ? 1 : -1;
    for (std::size_t f = 0; f < faces_.size(); ++f) {
        const Face& face = faces_[f];
        // Far from the line; the margin is well over what rounding can do here, and only keeps
        // more.
        const Vec3 to = face.center - origin;
        const double reach = face.radius * (1 + 1e-9) + 1e-12 * glm::length(to);
        const Vec3 beside = glm::cross(to, direction);
        if (glm::dot(beside, beside) > reach * reach) continue;
        const int* corner = corners_.data() + face.first;
        int turns = 0;
        for (int c = 0; c < face.count; ++c) {
            const int a = corner[c], b = corner[c + 1 < face.count ? c + 1 : 0];
            turns += winding(seen[static_cast<std::size_t>(a)], seen[static_cast<std::size_t>(b)],
                             a < b);
        }
        if (turns == 0) continue;
        double nearest = std::numeric_limits<double>::infinity(), farthest = -nearest;
        for (int c = 0; c < face.count; ++c) {
            const double t = seen[static_cast<std::size_t>(corner[c])].t;
            nearest = std::min(nearest, t);
            farthest = std::max(farthest, t);
        }
        // Seen on edge, a plane says nothing; its corners still do.
        const double towards = glm::dot(face.plane.normal, direction);
        double t = (face.plane.offset - glm::dot(face.plane.normal, origin)) / towards;
        if (!std::isfinite(t)) t = 0.5 * (nearest + farthest);
        crossings.push_back(
            {std::clamp(t, nearest, farthest), static_cast<int>(f), turns * forwards});
    }
    std::sort(crossings.begin(), crossings.end(), [](const Crossing& a, const Crossing& b) {
        if (a.t != b.t) return a.t < b.t;
        if (a.sign != b.sign) return a.sign < b.sign;
        return a.facet < b.facet;
    });
}

namespace {

using Crossing = PolyhedronBody::Crossing;

// The crossing that a ray starts from: that of facet `from` in the right sense, else the nearest in
// that sense. -1: there is none.
int start_of(const std::vector<Crossing>& crossings, int from, int sense) {
    int best = -1;
    for (std::size_t c = 0; c < crossings.size(); ++c) {
        if (crossings[c].sign * sense <= 0) continue;
        if (crossings[c].facet == from) return static_cast<int>(c);
        if (best < 0 ||
            std::abs(crossings[c].t) < std::abs(crossings[static_cast<std::size_t>(best)].t))
            best = static_cast<int>(c);
    }
    return best;
}

// How deep in the stone the line is just behind crossing `last` (-1: before the first).
int depth_behind(const std::vector<Crossing>& crossings, int last) {
    int depth = 0;
    for (int c = 0; c <= last; ++c) depth -= crossings[static_cast<std::size_t>(c)].sign;
    return depth;
}

}  // namespace

std::optional<BodyHit> PolyhedronBody::entry(const Vec3& origin, const Vec3& direction) const {
    std::vector<Crossing>& crossings = scratch().crossings;
    cross(origin, direction, crossings);
    int depth = 0;
    for (const Crossing& crossing : crossings) {
        if (crossing.t > 0 && depth > 0) return std::nullopt;  // starts inside
        depth -= crossing.sign;
        if (crossing.t > 0 && depth > 0) return BodyHit{crossing.facet, crossing.t};
    }
    return std::nullopt;
}

BodyHit PolyhedronBody::exit(const Vec3& origin, const Vec3& direction, int from) const {
    std::vector<Crossing>& crossings = scratch().crossings;
    cross(origin, direction, crossings);
    const int start = start_of(crossings, from, -1);
    int depth = depth_behind(crossings, start);
    // Rounding put the way out before the way in: they touch.
    if (depth <= 0) {
        for (int c = start - 1; c >= 0; --c) {
            if (crossings[static_cast<std::size_t>(c)].sign > 0)
                return {crossings[static_cast<std::size_t>(c)].facet, 0};
        }
    }
    for (std::size_t c = static_cast<std::size_t>(start + 1); c < crossings.size(); ++c) {
        depth -= crossings[c].sign;
        if (depth <= 0) return {crossings[c].facet, std::max(0.0, crossings[c].t)};
    }
    // The line misses the stone altogether: rounding put the start beside an edge that it grazes.
    // The ray ends where it is, on the facet that it came from.
    return {from >= 0 ? from : 0, 0};
}

std::optional<BodyHit> PolyhedronBody::reentry(const Vec3& origin, const Vec3& direction,
                                               int from) const {
    std::vector<Crossing>& crossings = scratch().crossings;
    cross(origin, direction, crossings);
    const int start = start_of(crossings, from, 1);
    if (start < 0) return std::nullopt;
    int depth = depth_behind(crossings, start);
    if (depth > 0) {
        for (int c = start - 1; c >= 0; --c) {
            if (crossings[static_cast<std::size_t>(c)].sign < 0)
                return BodyHit{crossings[static_cast<std::size_t>(c)].facet, 0};
        }
    }
    for (std::size_t c = static_cast<std::size_t>(start + 1); c < crossings.size(); ++c) {
        depth -= crossings[c].sign;
        if (depth > 0) return BodyHit{crossings[c].facet, std::max(0.0, crossings[c].t)};
    }
    return std::nullopt;
}

bool PolyhedronBody::contains(const Vec3& point) const {
    std::vector<Crossing>& crossings = scratch().crossings;
    // Any direction will do.
    cross(point, glm::normalize(Vec3{0.36, 0.48, 0.8}), crossings);
    int depth = 0;
    for (const Crossing& crossing : crossings) {
        if (crossing.t > 0) depth += crossing.sign;
    }
    return depth > 0;
}

}  // namespace culet
