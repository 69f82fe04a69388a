#include "render/shaded/plain_lights.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

namespace culet {

namespace {

// Enough to reproduce a light's colour, and for illuminants.
std::vector<double> usual_wavelengths() {
    std::vector<double> nm;
    for (int i = 0; i <= 12; ++i) nm.push_back(390 + 27.5 * i);
    return nm;
}

// Mean over all directions: rows of a lat-long map are weighted by the sine of their polar angle.
Rgb mean_of(const EnvironmentMap& map) {
    Rgb sum{0, 0, 0};
    double weights = 0;
    for (int row = 0; row < map.height; ++row) {
        const double weight = std::sin(std::numbers::pi * (row + 0.5) / map.height);
        for (int column = 0; column < map.width; ++column) {
            const float* texel =
                &map.rgb[3 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(map.width) +
                              static_cast<std::size_t>(column))];
            sum += weight * Rgb{texel[0], texel[1], texel[2]};
            weights += weight;
        }
    }
    return weights > 0 ? (1 / weights) * sum : sum;
}

}  // namespace

PlainLights::PlainLights(const Scene& scene, const Vec3& middle)
    : attenuation_(scene.shading.attenuation),
      wavelengths_(usual_wavelengths()),
      field_(scene.lights, wavelengths_) {
    const double constant = scene.lights.constant;
    ambient_ = scene.lights.environment ? mean_of(*scene.lights.environment)
                                        : Rgb{constant, constant, constant};
    for (const Light& light : scene.lights.sources) add(light, middle);
}

Rgb PlainLights::rgb_of(const LightColour& colour) const {
    return wavelengths_.rgb_of(radiance_of(colour, wavelengths_).data());
}

void PlainLights::add(const Light& light, const Vec3& middle) {
    const Rgb radiance = rgb_of(colour_of(light));
    PlainLight plain;
    static_assert(std::variant_size_v<Light> == 6, "a new kind of light is shaded here, too");
    // Irradiance of a surface that faces the light, over pi and radiance.
    double share = 0;
    if (const auto* lamp = std::get_if<LampLight>(&light)) plain.lamp = *lamp;
    if (const auto sphere = ball_of(light)) {
        plain.at = sphere->center;
        plain.middle_distance = glm::length(sphere->center - middle);
        // A dome around the scene is ambient light.
        if (plain.middle_distance <= sphere->radius) {
            ambient_ += radiance;
            return;
        }
        share = std::pow(sphere->radius / plain.middle_distance, 2);
    } else if (const auto* lobe = std::get_if<CosinePowerLight>(&light)) {
        plain.distant = true;
        plain.at = lobe->direction;
        share = 2 / (lobe->exponent + 2);
    } else if (const auto* cap = std::get_if<DiscLight>(&light)) {
        // Light from beyond 90 degrees does not reach a surface that faces the cap.
        const double to = std::min(cap->to, std::numbers::pi / 2),
                     from = std::min(cap->from, std::numbers::pi / 2);
        plain.distant = true;
        plain.at = cap->direction;
        share = std::pow(std::sin(to), 2) - std::pow(std::sin(from), 2);
    } else if (const auto* plane = std::get_if<PlaneLight>(&light); plane && plane->u && plane->v) {
        plain.at = plane->point;
        plain.normal = plane->normal;
        const Vec3 way = middle - plane->point;
        plain.middle_distance = glm::length(way);
        const double area = 4 * glm::length(glm::cross(*plane->u, *plane->v));
        if (!(plain.middle_distance > 0)) return;
        // `incoming` adds the cosine at the light.
        share = area / (std::numbers::pi * plain.middle_distance * plain.middle_distance);
    } else {
        // A hemisphere.
        ambient_ += 0.5 * radiance;
        return;
    }
    plain.strength = share * radiance;
    lights_.push_back(plain);
}

Incoming PlainLights::incoming(const PlainLight& light, const Vec3& point) const {
    if (light.distant) return {light.at, std::numeric_limits<double>::infinity(), light.strength};
    const Vec3 way = light.at - point;
    const double distance = glm::length(way), a = distance / light.middle_distance;
    if (!(distance > 0)) return {};
    Incoming incoming{way / distance, distance, light.strength};
    double factor = 1 / (attenuation_[0] + a * (attenuation_[1] + a * attenuation_[2]));
    if (light.normal != Vec3(0))
        factor *= std::max(0.0, -glm::dot(incoming.direction, light.normal));
    if (light.lamp) factor *= share_of(*light.lamp, incoming.direction);
    incoming.strength = factor * light.strength;
    return incoming;
}

Rgb PlainLights::seen(const Vec3& origin, const Vec3& direction) const {
    std::vector<double> radiance(static_cast<std::size_t>(wavelengths_.size()), 0.0);
    field_.add_radiance(origin, direction, 1, 0, wavelengths_.size(), radiance.data());
    return wavelengths_.rgb_of(radiance.data());
}

}  // namespace culet
