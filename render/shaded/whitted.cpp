#include "render/shaded/whitted.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "render/optics/conductor.h"
#include "render/optics/fresnel.h"
#include "render/optics/random.h"
#include "render/shaded/faceted_bodies.h"

namespace culet {

namespace {

constexpr double k_least_weight = 1.0 / 2048;  // not visible in 8 bits

double mean_index(const Material& material) {
    const int rays = ray_count(material.optic);
    double sum = 0;
    for (int r = 0; r < rays; ++r)
        sum += material.index[static_cast<std::size_t>(r)].at(k_d_line_nm);
    return sum / rays;
}

Rgb left_after(const Rgb& absorption, double distance) {
    Rgb left;
    for (std::size_t c = 0; c < 3; ++c) left[c] = std::exp(-absorption[c] * distance);
    return left;
}

std::uint64_t first_random(std::uint64_t seed) {
    return Random(seed).next();
}

// Uniformly distributed in the unit ball.
Vec3 point_in_ball(std::uint64_t seed) {
    Random random(seed);
    while (true) {
        const Vec3 p{2 * random.uniform() - 1, 2 * random.uniform() - 1, 2 * random.uniform() - 1};
        if (glm::dot(p, p) <= 1) return p;
    }
}

// Reflection and refraction at a polished face; `normal` faces the incoming ray.
struct Face {
    double reflected = 1;  ///< share, mean of s and p
    Vec3 mirror, onward;   ///< unit; `onward` is not set for total reflection
};

Face face_met(const Vec3& direction, const Vec3& normal, double n1, double n2) {
    const double cosine = std::clamp(-glm::dot(direction, normal), 0.0, 1.0);
    Face face;
    face.mirror = glm::normalize(direction + 2 * cosine * normal);
    const FaceAmplitudes amplitudes = fresnel(n1, n2, n1 * cosine);
    if (amplitudes.total) return face;
    face.reflected = 0.5 * (std::norm(amplitudes.r_s) + std::norm(amplitudes.r_p));
    const Vec3 along = direction + cosine * normal;
    face.onward = glm::normalize((n1 / n2) * along - (amplitudes.q2 / n2) * normal);
    return face;
}

}  // namespace

WhittedTracer::WhittedTracer(const Scene& scene, int depth)
    : world_(scene),
      shading_(scene.shading),
      lights_(scene, middle_of(scene)),
      outside_(scene.immersion),
      depth_(depth),
      seed_(scene.settings.seed) {
    for (const SceneObject& object : scene.objects) {
        Surface surface{plain_surface(object.material, 0), {}, 0, 1, {0, 0, 0}};
        if (const auto* metal = std::get_if<MetalMaterial>(&object.material)) {
            surface.metal = index_of(*metal);
            surface.fuzz = metal->roughness * metal->roughness;
        } else if (const auto* glass = std::get_if<DielectricMaterial>(&object.material)) {
            surface.index = glass->index;
            surface.absorption = rgb_of(glass->absorption);
        }
        surfaces_.push_back(surface);
    }
    const auto add = [this](const Stone& stone) {
        gems_.push_back({mean_index(stone.material), stone_absorption(stone)});
    };
    if (scene.has_stone()) add(scene.stone);
    for (const Stone& stone : scene.more_stones) add(stone);
}

WhittedTracer::Seen WhittedTracer::trace(const EyeRay& eye, std::uint64_t number) const {
    Ray ray{eye.origin, eye.direction, {}, -1, 0, 1, first_random(seed_ ^ first_random(number))};
    const WorldHit hit = world_.nearest(ray.origin, ray.direction, {});
    const bool met =
        hit.met() && !(lights_.nearest_distance(ray.origin, ray.direction) < hit.distance);
    return {colour_along(ray), met};
}

WhittedTracer::Ray WhittedTracer::next(const Ray& ray, const Vec3& at, const Vec3& direction,
                                       double share, int branch) const {
    Ray next = ray;
    next.origin = at;
    next.direction = direction;
    ++next.faces;
    next.weight *= share;
    next.seed = first_random(ray.seed + static_cast<std::uint64_t>(branch));
    return next;
}

Rgb WhittedTracer::colour_along(const Ray& ray) const {
    const WorldHit hit = world_.nearest(ray.origin, ray.direction, ray.start);
    if (!hit.met() || lights_.nearest_distance(ray.origin, ray.direction) < hit.distance)
        return lights_.seen(ray.origin, ray.direction);
    const Vec3 at = world_.place(hit, ray.origin, ray.direction);
    const Rgb colour = colour_of_hit(ray, hit, at);
    if (ray.glass < 0) return colour;
    return left_after(surfaces_[static_cast<std::size_t>(ray.glass)].absorption, hit.distance) *
           colour;
}

Rgb WhittedTracer::colour_of_hit(const Ray& ray, const WorldHit& hit, const Vec3& at) const {
    if (too_deep(ray)) return {0, 0, 0};
    if (hit.stone >= 0) return onto_stone(ray, hit.stone, hit.part, at);
    const auto object = static_cast<std::size_t>(hit.object);
    const SurfaceMaterial& material = world_.objects()[object].material;
    const bool from_outside = glm::dot(ray.direction, hit.normal) < 0;
    const Vec3 shading =
        (glm::dot(ray.direction, hit.shading) < 0) == from_outside ? hit.shading : hit.normal;
    const Vec3 normal = from_outside ? shading : -shading;
    if (std::holds_alternative<EmitterMaterial>(material)) return surfaces_[object].plain.colour;
    if (std::holds_alternative<DiffuseMaterial>(material)) return diffuse(hit, at, normal);
    if (std::holds_alternative<DielectricMaterial>(material)) return through_glass(ray, hit, at);
    return reflected(ray, hit, at, normal);
}

bool WhittedTracer::hidden(const Vec3& from, const Incoming& light, const RayStart& start) const {
    Vec3 origin = from;
    RayStart at = start;
    double way = light.distance;
    // Stones and glass are transparent.
    for (int i = 0; i < depth_; ++i) {
        const WorldHit hit = world_.nearest(origin, light.direction, at);
        if (!hit.met() || !(hit.distance < way)) return false;
        if (hit.stone >= 0) {
            // A stone that is not convex may be met again.
            at = {-1, -1, hit.stone};
        } else {
            const auto& material = world_.objects()[static_cast<std::size_t>(hit.object)].material;
            if (!std::holds_alternative<DielectricMaterial>(material)) return true;
            at = {hit.object, hit.part, -1};
        }
        origin = world_.place(hit, origin, light.direction);
        way -= hit.distance;
    }
    return true;
}

Rgb WhittedTracer::diffuse(const WorldHit& hit, const Vec3& at, const Vec3& normal) const {
    const Rgb& colour = surfaces_[static_cast<std::size_t>(hit.object)].plain.colour;
    Rgb light = shading_.ambient * lights_.ambient();
    for (const PlainLight& source : lights_.lights()) {
        const Incoming incoming = lights_.incoming(source, at);
        const double cosine = glm::dot(normal, incoming.direction);
        if (!(cosine > 0) || hidden(at, incoming, {hit.object, hit.part, -1})) continue;
        light += (shading_.diffuse * cosine) * incoming.strength;
    }
    return colour * light;
}

Rgb WhittedTracer::reflected(const Ray& ray, const WorldHit& hit, const Vec3& at,
                             const Vec3& normal) const {
    const auto object = static_cast<std::size_t>(hit.object);
    const Surface& surface = surfaces_[object];
    const double cosine = std::clamp(-glm::dot(ray.direction, normal), 0.0, 1.0);
    Rgb share = surface.plain.highlight;
    if (std::holds_alternative<MetalMaterial>(world_.objects()[object].material)) {
        for (std::size_t c = 0; c < 3; ++c)
            share[c] = conductor_reflectance(surface.metal.n[c] / outside_,
                                             surface.metal.k[c] / outside_, cosine);
    }
    const Vec3 mirror = glm::normalize(ray.direction + 2 * cosine * normal);
    Ray on = next(ray, at, mirror, std::max({share[0], share[1], share[2]}), 0);
    if (on.weight < k_least_weight) return {0, 0, 0};
    if (surface.fuzz > 0) {
        const Vec3 turned = mirror + surface.fuzz * point_in_ball(on.seed);
        // Ignore directions below the surface.
        if (glm::dot(turned, normal) > 0 &&
            glm::dot(turned, hit.normal) * glm::dot(normal, hit.normal) > 0)
            on.direction = glm::normalize(turned);
    }
    on.start = {hit.object, hit.part, -1};
    return share * colour_along(on);
}

Rgb WhittedTracer::through_glass(const Ray& ray, const WorldHit& hit, const Vec3& at) const {
    const Surface& surface = surfaces_[static_cast<std::size_t>(hit.object)];
    const bool enters = glm::dot(ray.direction, hit.normal) < 0;
    const Face face =
        face_met(ray.direction, enters ? hit.normal : -hit.normal,
                 enters ? outside_ : surface.index, enters ? surface.index : outside_);
    Rgb colour{0, 0, 0};
    Ray mirrored = next(ray, at, face.mirror, face.reflected, 0);
    mirrored.start = {hit.object, hit.part, -1};
    if (mirrored.weight >= k_least_weight) colour += face.reflected * colour_along(mirrored);
    if (face.reflected >= 1) return colour;
    Ray onward = next(ray, at, face.onward, 1 - face.reflected, 1);
    onward.start = mirrored.start;
    onward.glass = enters ? hit.object : -1;
    if (onward.weight >= k_least_weight) colour += (1 - face.reflected) * colour_along(onward);
    return colour;
}

Rgb WhittedTracer::onto_stone(const Ray& ray, int stone, int facet, const Vec3& at) const {
    if (too_deep(ray)) return {0, 0, 0};
    const StoneBody& body = world_.stone(stone);
    const Face face = face_met(ray.direction, body.normal(facet), outside_,
                               gems_[static_cast<std::size_t>(stone)].index);
    const Vec3 on_it = body.on_facet(facet, at);
    Rgb colour{0, 0, 0};
    const Ray mirrored = next(ray, on_it, face.mirror, face.reflected, 0);
    if (mirrored.weight >= k_least_weight)
        colour += face.reflected * off_stone(mirrored, stone, facet);
    const Ray onward = next(ray, on_it, face.onward, 1 - face.reflected, 1);
    if (face.reflected < 1 && onward.weight >= k_least_weight)
        colour += (1 - face.reflected) * inside_stone(onward, stone, facet);
    return colour;
}

Rgb WhittedTracer::inside_stone(const Ray& ray, int stone, int facet) const {
    if (too_deep(ray)) return {0, 0, 0};
    const StoneBody& body = world_.stone(stone);
    const Gem& gem = gems_[static_cast<std::size_t>(stone)];
    const BodyHit exit = body.exit(ray.origin, ray.direction, facet);
    const Face face = face_met(ray.direction, -body.normal(exit.facet), gem.index, outside_);
    const Vec3 at = body.on_facet(exit.facet, ray.origin + exit.distance * ray.direction);
    Rgb colour{0, 0, 0};
    const Ray mirrored = next(ray, at, face.mirror, face.reflected, 0);
    if (mirrored.weight >= k_least_weight)
        colour += face.reflected * inside_stone(mirrored, stone, exit.facet);
    if (face.reflected < 1) {
        const Ray onward = next(ray, at, face.onward, 1 - face.reflected, 1);
        if (onward.weight >= k_least_weight)
            colour += (1 - face.reflected) * off_stone(onward, stone, exit.facet);
    }
    return left_after(gem.absorption, exit.distance) * colour;
}

Rgb WhittedTracer::off_stone(const Ray& ray, int stone, int facet) const {
    Ray on = ray;
    on.start = {-1, -1, stone};
    on.glass = -1;
    if (const auto again = world_.stone(stone).reentry(ray.origin, ray.direction, facet)) {
        const double other = std::min(world_.nearest(ray.origin, ray.direction, on.start).distance,
                                      lights_.nearest_distance(ray.origin, ray.direction));
        if (again->distance < other)
            return onto_stone(on, stone, again->facet,
                              ray.origin + again->distance * ray.direction);
    }
    return colour_along(on);
}

}  // namespace culet
