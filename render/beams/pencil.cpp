#include "render/beams/pencil.h"

#include <cmath>

#include "stone/solid/perpendicular.h"

namespace culet {

Folding Folding::mirrored(const Plane& plane) const {
    const Vec3& n = plane.normal;
    Folding next;
    for (int column = 0; column < 3; ++column)
        next.turn[column] = turn[column] - 2 * glm::dot(n, turn[column]) * n;
    next.shift = shift - 2 * (glm::dot(n, shift) - plane.offset) * n;
    return next;
}

namespace {

// A ray at a face, before and behind it.
struct Refracted {
    Vec3 v{0}, x0{0};  // unit direction outside, entry point
    double distance = 0, cos_i = 1, q2 = 0;
};
Refracted refracted(const ScreenView& view, const ScreenPoint& at, const Plane& front, double n) {
    Refracted ray;
    const Vec3 origin = view.origin(at), towards = view.towards(at);
    ray.v = towards / glm::length(towards);
    ray.cos_i = -glm::dot(ray.v, front.normal);
    ray.distance = (glm::dot(front.normal, origin) - front.offset) / ray.cos_i;
    ray.x0 = origin + ray.distance * ray.v;
    ray.q2 = std::sqrt((n - 1) * (n + 1) + ray.cos_i * ray.cos_i);
    return ray;
}

}  // namespace

InsideRay ray_through(const ScreenView& view, const ScreenPoint& at, const Plane& front, double n) {
    const Refracted ray = refracted(view, at, front, n);
    return {ray.x0, (ray.v + (ray.cos_i - ray.q2) * front.normal) / n};
}

Pencil pencil_through(const ScreenView& view, const ScreenPoint& at, const Plane& front, double n) {
    const Refracted ray = refracted(view, at, front, n);
    Pencil p;
    p.normal = front.normal;
    p.x0 = ray.x0;
    p.direction = (ray.v + (ray.cos_i - ray.q2) * p.normal) / n;
    p.cos_i = ray.cos_i;
    p.cos_t = ray.q2 / n;
    const Vec3 along = ray.v + p.cos_i * p.normal;
    const double sine = glm::length(along);
    p.tangential = sine > 1e-14 ? along / sine : perpendicular_to(p.normal);
    p.sagittal = glm::cross(p.normal, p.tangential);
    if (!view.parallel) {
        p.k_s = 1 / (n * ray.distance * p.cos_t);
        const double ratio = p.cos_i / p.cos_t;
        p.k_t = p.k_s * ratio * ratio;
    }
    p.image_x0 = view.of_point(p.x0);
    p.image_t = view.of_direction(p.tangential);
    p.image_s = view.of_direction(p.sagittal);
    return p;
}

PencilMap map_of(const Pencil& pencil, Refraction refraction, const Folding& folding,
                 double depth) {
    double k = 0.5 * (pencil.k_s + pencil.k_t), f_t = 1, f_s = 1;
    if (refraction == Refraction::parallel) k = 0;
    if (refraction == Refraction::astigmatic) {
        f_t = (1 + depth * k) / (1 + depth * pencil.k_t);
        f_s = (1 + depth * k) / (1 + depth * pencil.k_s);
    }
    const double tan_t =
        -glm::dot(pencil.direction, pencil.tangential) / glm::dot(pencil.direction, pencil.normal);
    // Depth and the two offsets as affine functions of a point of the folded stone.
    const auto folded = [&](const Vec3& direction, double at_x0) {
        const Vec3 turned = folding.turn * direction;
        return glm::dvec4(turned, -glm::dot(turned, folding.shift) - at_x0);
    };
    const glm::dvec4 z = -folded(pencil.normal, glm::dot(pencil.normal, pencil.x0));
    const glm::dvec4 a_t =
        f_t * (folded(pencil.tangential, glm::dot(pencil.tangential, pencil.x0)) - tan_t * z);
    const glm::dvec4 a_s = f_s * folded(pencil.sagittal, glm::dot(pencil.sagittal, pencil.x0));
    glm::dvec4 w = k * z;
    w[3] += 1;
    PencilMap map;
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 4; ++column) {
            map.m[static_cast<std::size_t>(4 * row + column)] = w[column] * pencil.image_x0[row] +
                                                                a_t[column] * pencil.image_t[row] +
                                                                a_s[column] * pencil.image_s[row];
        }
    }
    return map;
}

}  // namespace culet
