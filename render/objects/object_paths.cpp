#include "render/objects/object_paths.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "render/objects/rough_surface.h"
#include "render/optics/fresnel.h"
#include "stone/solid/perpendicular.h"

namespace culet {

namespace {

// Less important rays are followed with proportional probability.
constexpr double k_threshold = 0.5;
// From k_sure_bounces on, one path in twenty ends at each hit, so that none continues forever
// between clear surfaces. One in twenty thousand of them reaches the last bounce.
constexpr int k_sure_bounces = 8, k_last_bounce = 200;
constexpr double k_goes_on = 0.95;
// Number of glass faces at which both reflection and refraction are followed; then one is chosen by
// power.
constexpr int k_split_bounces = 2;

Vec3 mirrored(const Vec3& direction, const Vec3& n) {
    return glm::normalize(direction - 2 * glm::dot(direction, n) * n);
}

// Unit tangent of a face for a ray; with the ray's direction it gives p.
Vec3 tangent(const Vec3& direction, const Vec3& n) {
    const Vec3 s = glm::cross(direction, n);
    const double length = glm::length(s);
    return length > 1e-14 ? s / length : perpendicular_to(direction);
}

// Transforms Stokes parameters from the frame (s, p) to (u, v), both orthonormal and normal to the
// ray.
Stokes turned(const Stokes& light, const Vec3& s, const Vec3& p, const Vec3& u, const Vec3& v) {
    const double us = glm::dot(u, s), up = glm::dot(u, p), vs = glm::dot(v, s), vp = glm::dot(v, p);
    const double S = 0.5 * (light[0] + light[1]), P = 0.5 * (light[0] - light[1]);
    return {light[0],
            (us * us - vs * vs) * S + (up * up - vp * vp) * P + (us * up - vs * vp) * light[2],
            2 * (us * vs * S + up * vp * P) + (us * vp + up * vs) * light[2],
            (us * vp - up * vs) * light[3]};
}

}  // namespace

void ObjectPaths::clear(ArrivingLight& light) const {
    for (int k = 0; k < planes_; ++k) std::fill_n(light[k].begin(), count_, 0.0);
}

double ObjectPaths::roulette(const WorldRay& ray, double threshold) {
    if (ray.depth >= k_last_bounce) return 0;
    double chance = std::min(1.0, ray.importance / threshold);
    if (ray.depth >= k_sure_bounces) chance = std::min(chance, k_goes_on);
    if (chance >= 1) return 1;
    return random_.uniform() < chance ? 1 / chance : 0;
}

void ObjectPaths::absorb(const WorldRay& ray, double distance, ArrivingLight& light) const {
    if (ray.medium < 0) return;
    const std::vector<double>& absorption =
        scene_.surfaces[static_cast<std::size_t>(ray.medium)].absorption;
    for (int i = 0; i < count_; ++i) {
        const double per_length = absorption[static_cast<std::size_t>(first_ + i)];
        if (!(per_length > 0)) continue;
        const double left = std::exp(-per_length * distance);
        for (int k = 0; k < planes_; ++k) light[k][i] *= left;
    }
}

ObjectPaths::Meeting ObjectPaths::meet(const WorldRay& ray) {
    spent_ns_ += price_ns(PathWork{.met = 1});
    Meeting meeting;
    meeting.hit = scene_.world.nearest(ray.origin, ray.direction, ray.start);
    const double lit = scene_.lights.nearest_distance(ray.origin, ray.direction);
    meeting.distance = std::min(meeting.hit.distance, lit);
    if (!meeting.hit.met() || lit < meeting.hit.distance) {
        meeting.hit.object = meeting.hit.stone = -1;
        meeting.shines = true;
    } else if (meeting.hit.object >= 0) {
        const auto object = static_cast<std::size_t>(meeting.hit.object);
        meeting.shines = scene_.surfaces[object].kind == SurfaceKind::emitter;
    }
    return meeting;
}

void ObjectPaths::shine(const WorldRay& ray, const Meeting& meeting, ArrivingLight& light) const {
    clear(light);
    if (meeting.hit.object >= 0) {
        const auto& colour = scene_.surfaces[static_cast<std::size_t>(meeting.hit.object)].colour;
        std::copy_n(colour.begin() + first_, count_, light[0].begin());
    } else if (planes_ == 1 || !scene_.polarised_lights) {
        scene_.lights.add_radiance(ray.origin, ray.direction, 1.0, first_, count_, light[0].data());
    } else {
        PathEnd end{ray.origin, ray.direction, ray.u, ray.v, EyeCoherency::of_eye(), {}};
        end.transmitted.fill(1.0);
        const auto stride = static_cast<std::size_t>(scene_.nodes);
        std::vector<double> stokes(4 * stride, 0.0);
        scene_.lights.add_stokes(end, first_, count_, stokes.data(), scene_.nodes);
        for (std::size_t k = 0; k < 4; ++k) {
            std::copy_n(stokes.begin() + static_cast<std::ptrdiff_t>(k * stride) + first_, count_,
                        light[k].begin());
        }
    }
    absorb(ray, meeting.distance, light);
}

void ObjectPaths::arriving(const WorldRay& ray, ArrivingLight& light) {
    const Meeting meeting = meet(ray);
    if (meeting.shines) {
        shine(ray, meeting, light);
    } else {
        answer(ray, meeting.hit, light);
    }
}

double ObjectPaths::arriving_if_it_matters(WorldRay ray, double threshold, ArrivingLight& light) {
    const double weight = roulette(ray, threshold);
    if (weight == 0) return 0;
    ray.importance = std::max(ray.importance, threshold);
    arriving(ray, light);
    return weight;
}

void ObjectPaths::answer(const WorldRay& ray, const WorldHit& hit, ArrivingLight& light) {
    clear(light);
    if (hit.stone >= 0) {
        through_stone(ray, hit, light);
    } else {
        switch (scene_.surfaces[static_cast<std::size_t>(hit.object)].kind) {
            case SurfaceKind::diffuse:
            case SurfaceKind::rough_metal:
                scatter(ray, hit, light);
                break;
            case SurfaceKind::metal:
            case SurfaceKind::mirror:
                reflect(ray, hit, light);
                break;
            case SurfaceKind::dielectric:
                refract(ray, hit, light);
                break;
            case SurfaceKind::emitter:
                break;
        }
    }
    absorb(ray, hit.distance, light);
}

template <class Face>
void ObjectPaths::pass_on(const WorldRay& ray, WorldRay next, const Vec3& s, double share,
                          double weight, const Face& face, ArrivingLight& light) {
    next.depth = ray.depth + 1;
    next.importance = ray.importance * share;
    next.u = s;
    next.v = glm::cross(next.direction, s);
    ArrivingLight in;
    weight *= arriving_if_it_matters(next, k_threshold, in);
    if (weight == 0) return;
    const Vec3 p = glm::cross(ray.direction, s);
    for (int i = 0; i < count_; ++i) {
        const MuellerReflection m = face(first_ + i);
        if (planes_ == 1) {
            light[0][i] += weight * m.mean * in[0][i];
            continue;
        }
        const Stokes passed{m.mean * in[0][i] + m.difference * in[1][i],
                            m.difference * in[0][i] + m.mean * in[1][i],
                            m.re * in[2][i] - m.im * in[3][i], m.im * in[2][i] + m.re * in[3][i]};
        const Stokes seen = turned(passed, s, p, ray.u, ray.v);
        for (int k = 0; k < 4; ++k) light[k][i] += weight * seen[k];
    }
}

void ObjectPaths::reflect(const WorldRay& ray, const WorldHit& hit, ArrivingLight& light) {
    const ReadySurface& surface = scene_.surfaces[static_cast<std::size_t>(hit.object)];
    Vec3 n = hit.shading;
    // If the interpolated normal would reflect into the surface, use the triangle's.
    const double side = glm::dot(ray.direction, hit.normal) < 0 ? 1 : -1;
    if (!(side * glm::dot(mirrored(ray.direction, n), hit.normal) > 0)) n = hit.normal;
    if (glm::dot(ray.direction, n) > 0) n = -n;
    WorldRay next;
    next.origin = scene_.world.place(hit, ray.origin, ray.direction);
    next.direction = mirrored(ray.direction, n);
    next.start = {hit.object, hit.part, -1};
    next.medium = ray.medium;
    const double cosine = std::min(1.0, -glm::dot(ray.direction, n));
    std::array<MuellerReflection, k_band_nodes> at_node;
    double most = 0;
    for (int i = 0; i < count_; ++i) {
        if (surface.kind == SurfaceKind::mirror) {
            const double albedo = surface.colour[static_cast<std::size_t>(first_ + i)];
            at_node[i] = {albedo, 0, -albedo, 0};
        } else {
            at_node[i] = surface.reflection(first_ + i, cosine);
        }
        most = std::max(most, at_node[i].mean);
    }
    pass_on(
        ray, next, tangent(ray.direction, n), most, 1,
        [&](int node) { return at_node[node - first_]; }, light);
}

void ObjectPaths::refract(const WorldRay& ray, const WorldHit& hit, ArrivingLight& light) {
    const ReadySurface& surface = scene_.surfaces[static_cast<std::size_t>(hit.object)];
    const bool enters = glm::dot(ray.direction, hit.normal) < 0;
    const Vec3 onwards = enters ? -hit.normal : hit.normal;
    const double n1 = enters ? 1 : surface.index, n2 = enters ? surface.index : 1;
    const double q1 = n1 * std::min(1.0, glm::dot(ray.direction, onwards));
    const FaceAmplitudes face = fresnel(n1, n2, q1);
    const double R = 0.5 * (std::norm(face.r_s) + std::norm(face.r_p));
    const Vec3 s = tangent(ray.direction, onwards);
    WorldRay next;
    next.origin = scene_.world.place(hit, ray.origin, ray.direction);
    next.start = {hit.object, hit.part, -1};
    bool reflects = true, passes = !face.total;
    double reflected_weight = 1, passed_weight = 1;
    if (passes && ray.depth >= k_split_bounces) {
        reflects = random_.uniform() < R;
        passes = !reflects;
        reflected_weight = 1 / R;
        passed_weight = 1 / (1 - R);
    }
    if (reflects) {
        const auto mixed = face.r_s * std::conj(face.r_p);
        const MuellerReflection m{R, 0.5 * (std::norm(face.r_s) - std::norm(face.r_p)),
                                  mixed.real(), mixed.imag()};
        next.direction = mirrored(ray.direction, onwards);
        next.medium = enters ? ray.medium : hit.object;
        pass_on(
            ray, next, s, R * reflected_weight, reflected_weight, [&](int) { return m; }, light);
    }
    if (passes) {
        const double Ts = face.t_s * face.t_s, Tp = face.t_p * face.t_p;
        const MuellerReflection m{0.5 * (Ts + Tp), 0.5 * (Ts - Tp), face.t_s * face.t_p, 0};
        next.direction = glm::normalize(n1 * ray.direction + (face.q2 - q1) * onwards);
        next.medium = enters ? hit.object : -1;
        pass_on(
            ray, next, s, (1 - R) * passed_weight, passed_weight, [&](int) { return m; }, light);
    }
}

void ObjectPaths::scatter(const WorldRay& ray, const WorldHit& hit, ArrivingLight& light) {
    const Vec3 side = glm::dot(ray.direction, hit.normal) < 0 ? hit.normal : -hit.normal;
    const Vec3 at = scene_.world.place(hit, ray.origin, ray.direction);
    const RoughSurface rough(scene_.surfaces[static_cast<std::size_t>(hit.object)], side,
                             glm::dot(hit.shading, side) > 0 ? hit.shading : -hit.shading,
                             -ray.direction);
    WorldRay next;
    next.origin = at;
    next.start = {hit.object, hit.part, -1};
    next.medium = ray.medium;
    next.depth = ray.depth + 1;
    ArrivingLight in;
    const auto take = [&](double density) {
        const RoughSurface::Spread spread = rough.spread(next.direction);
        for (int i = 0; i < count_; ++i)
            light[0][i] += rough.value(first_ + i, spread) * in[0][i] / density;
    };
    const auto face = [&](const Vec3& direction) {
        next.direction = direction;
        next.u = perpendicular_to(direction);
        next.v = glm::cross(direction, next.u);
    };
    const LightSampler& sampler = scene_.sampler;
    if (!sampler.empty()) {
        const auto aimed = sampler.sample(at, random_);
        if (aimed && rough.reflects_to(*aimed)) {
            face(*aimed);
            const Meeting meeting = meet(next);
            if (meeting.shines) {
                shine(next, meeting, in);
                take(sampler.density(at, *aimed) + rough.density(*aimed));
            }
        }
    }
    const auto chosen = rough.sample(random_);
    if (!chosen) return;
    face(*chosen);
    const double density = rough.density(*chosen);
    const Meeting meeting = meet(next);
    if (meeting.shines) {
        shine(next, meeting, in);
        take(density + (sampler.empty() ? 0 : sampler.density(at, *chosen)));
        return;
    }
    double share = 0;
    const RoughSurface::Spread spread = rough.spread(*chosen);
    for (int i = 0; i < count_; ++i)
        share = std::max(share, rough.value(first_ + i, spread) / density);
    next.importance = ray.importance * share;
    const double weight = roulette(next, k_threshold);
    if (weight == 0) return;
    next.importance = std::max(next.importance, k_threshold);
    answer(next, meeting.hit, in);
    for (int i = 0; i < count_; ++i) in[0][i] = std::min(in[0][i], scene_.most_indirect);
    take(density / weight);
}

}  // namespace culet
