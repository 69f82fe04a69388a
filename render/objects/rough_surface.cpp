#include "render/objects/rough_surface.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "stone/solid/perpendicular.h"

namespace culet {

RoughSurface::RoughSurface(const ReadySurface& surface, const Vec3& side, const Vec3& shading,
                           const Vec3& towards)
    : surface_(surface), side_(side), z_(glm::dot(shading, towards) > 0 ? shading : side) {
    x_ = perpendicular_to(z_);
    y_ = glm::cross(z_, x_);
    towards_ = local(towards);
    if (surface.kind == SurfaceKind::rough_metal) once_ = surface.reflected_once(towards_.z);
}

Vec3 RoughSurface::local(const Vec3& v) const {
    return {glm::dot(v, x_), glm::dot(v, y_), glm::dot(v, z_)};
}

Vec3 RoughSurface::global(const Vec3& v) const {
    return v.x * x_ + v.y * y_ + v.z * z_;
}

bool RoughSurface::reflects_to(const Vec3& direction) const {
    return glm::dot(direction, side_) > 0 && glm::dot(direction, z_) > 0;
}

RoughSurface::Spread RoughSurface::spread(const Vec3& direction) const {
    const Vec3 to = local(direction);
    if (surface_.kind == SurfaceKind::diffuse) return {to.z / std::numbers::pi, 1};
    const Vec3 half = glm::normalize(towards_ + to);
    return {ggx::density(surface_.alpha, half) *
                ggx::masking_and_shadowing(surface_.alpha, towards_, to) / (4 * towards_.z),
            std::min(1.0, glm::dot(towards_, half))};
}

double RoughSurface::value(int node, const Spread& spread) const {
    if (surface_.kind == SurfaceKind::diffuse)
        return surface_.colour[static_cast<std::size_t>(node)] * spread.factor;
    return surface_.reflectance(node, spread.half_cosine) * surface_.gain(node, once_) *
           spread.factor;
}

std::optional<Vec3> RoughSurface::sample(Random& random) const {
    const double u = random.uniform(), v = random.uniform();
    Vec3 to;
    if (surface_.kind == SurfaceKind::diffuse) {
        const double r = std::sqrt(u), azimuth = 2 * std::numbers::pi * v;
        to = {r * std::cos(azimuth), r * std::sin(azimuth), std::sqrt(1 - u)};
    } else {
        to = ggx::sample(surface_.alpha, towards_, u, v);
    }
    const Vec3 direction = global(to);
    if (!reflects_to(direction)) return std::nullopt;
    return direction;
}

double RoughSurface::density(const Vec3& direction) const {
    const Vec3 to = local(direction);
    if (surface_.kind == SurfaceKind::diffuse) return to.z / std::numbers::pi;
    return ggx::sample_density(surface_.alpha, towards_, to);
}

}  // namespace culet
