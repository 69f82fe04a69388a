#include "render/objects/shapes.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace culet {

namespace {

// Distance to the plane through `point`; nothing if the ray runs along or away from it.
std::optional<double> distance_to_plane(const Vec3& point, const Vec3& normal, const Vec3& origin,
                                        const Vec3& direction) {
    const double rate = glm::dot(normal, direction), height = glm::dot(normal, point - origin);
    if (rate == 0) return std::nullopt;
    const double distance = height / rate;
    if (!(distance > 0)) return std::nullopt;
    return distance;
}

Vec3 on_plane(const Vec3& in_it, const Vec3& normal, const Vec3& point) {
    return point - glm::dot(normal, point - in_it) * normal;
}

}  // namespace

std::optional<ShapeHit> nearest_on(const SphereShape& sphere, const Vec3& origin,
                                   const Vec3& direction, int start) {
    const Vec3 from_center = origin - sphere.center;
    const double b = glm::dot(from_center, direction);
    double distance = 0;
    if (start >= 0) {
        // The ray starts on the sphere: take the other root.
        distance = -2 * b;
        if (!(distance > 0)) return std::nullopt;
    } else {
        const Vec3 nearest = from_center - b * direction;
        const double below =
            (sphere.radius - glm::length(nearest)) * (sphere.radius + glm::length(nearest));
        if (!(below > 0)) return std::nullopt;
        const double half = std::sqrt(below);
        const double length = glm::length(from_center);
        // c of t^2 + 2 b t + c = 0; both roots are computed without cancellation.
        const double c = (length - sphere.radius) * (length + sphere.radius);
        if (c > 0) {
            if (!(b < 0)) return std::nullopt;
            distance = c / (half - b);
        } else {
            distance = b > 0 ? -c / (b + half) : half - b;
        }
    }
    const Vec3 at = from_center + distance * direction;
    return ShapeHit{distance, glm::normalize(at), 0};
}

std::optional<ShapeHit> nearest_on(const PlaneShape& plane, const Vec3& origin,
                                   const Vec3& direction, int start) {
    if (start >= 0) return std::nullopt;
    const auto distance = distance_to_plane(plane.point, plane.normal, origin, direction);
    if (!distance) return std::nullopt;
    return ShapeHit{*distance, plane.normal, 0};
}

std::optional<ShapeHit> nearest_on(const DiscShape& disc, const Vec3& origin, const Vec3& direction,
                                   int start) {
    if (start >= 0) return std::nullopt;
    const auto distance = distance_to_plane(disc.center, disc.normal, origin, direction);
    if (!distance) return std::nullopt;
    const Vec3 at = origin + *distance * direction - disc.center;
    if (!(glm::dot(at, at) < disc.radius * disc.radius)) return std::nullopt;
    return ShapeHit{*distance, disc.normal, 0};
}

std::optional<ShapeHit> nearest_on(const BoxShape& box, const Vec3& origin, const Vec3& direction,
                                   int start) {
    double in = -std::numeric_limits<double>::infinity(), out = -in;
    int in_face = -1, out_face = -1;
    for (int axis = 0; axis < 3; ++axis) {
        const Vec3& along = box.axes[static_cast<std::size_t>(axis)];
        const double rate = glm::dot(direction, along),
                     place = glm::dot(origin - box.center, along), half = box.half[axis];
        if (rate == 0) {
            if (!(std::abs(place) < half) && start / 2 != axis) return std::nullopt;
            continue;
        }
        const int towards = rate > 0 ? 1 : 0;
        const double near = ((rate > 0 ? -half : half) - place) / rate,
                     far = ((rate > 0 ? half : -half) - place) / rate;
        // A ray that runs outwards from its own face does not hit the box again.
        if (start == 2 * axis + towards) return std::nullopt;
        if (near > in) {
            in = near;
            in_face = 2 * axis + (1 - towards);
        }
        if (far < out) {
            out = far;
            out_face = 2 * axis + towards;
        }
    }
    const auto hit = [&](double distance, int face) {
        const Vec3& along = box.axes[static_cast<std::size_t>(face / 2)];
        return ShapeHit{distance, face % 2 == 1 ? along : -along, face};
    };
    // A ray that starts on the surface runs inwards, whatever the rounding.
    if (start >= 0)
        return out_face < 0 ? std::nullopt : std::optional(hit(std::max(out, 0.0), out_face));
    if (!(in < out) || !(out > 0)) return std::nullopt;
    return in > 0 ? hit(in, in_face) : hit(out, out_face);
}

Vec3 on_surface(const SphereShape& sphere, const Vec3& point, int) {
    return sphere.center + sphere.radius * glm::normalize(point - sphere.center);
}

Vec3 on_surface(const PlaneShape& plane, const Vec3& point, int) {
    return on_plane(plane.point, plane.normal, point);
}

Vec3 on_surface(const DiscShape& disc, const Vec3& point, int) {
    return on_plane(disc.center, disc.normal, point);
}

Vec3 on_surface(const BoxShape& box, const Vec3& point, int part) {
    const int axis = part / 2;
    const Vec3& along = box.axes[static_cast<std::size_t>(axis)];
    const double side = part % 2 == 1 ? box.half[axis] : -box.half[axis];
    return on_plane(box.center + side * along, along, point);
}

}  // namespace culet
