#include "render/beams/beam_lights.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

namespace culet {

namespace {

// Exponents up to this are multiplied out.
constexpr double k_multiplied_out = 64;

std::vector<float> spectrum(const LightColour& colour, const WavelengthSet& colours, int first,
                            int count) {
    const std::vector<double> all = radiance_of(colour, colours);
    return {all.begin() + first, all.begin() + first + count};
}

// Cosines beyond 1 or -1 stand for nothing and for all directions.
ShadedLights::Disc disc(double cosine) {
    const double sine = std::sqrt(std::max(0.0, (1 - cosine) * (1 + cosine)));
    return {static_cast<float>(cosine), static_cast<float>(sine)};
}

ShadedLights::Polarised polarised_as(const std::optional<LinearPolarisation>& light) {
    ShadedLights::Polarised result;
    if (!light) return result;
    result.degree = static_cast<float>(light->degree);
    result.sheet = light->normal.has_value();
    // A sheet's direction lies in it.
    const Vec3 normal = light->normal.value_or(Vec3(0, 0, 1));
    const Vec3 along =
        result.sheet
            ? glm::normalize(light->vibration - glm::dot(light->vibration, normal) * normal)
            : light->vibration;
    for (int i = 0; i < 3; ++i) {
        result.along[i] = static_cast<float>(along[i]);
        result.normal[i] = static_cast<float>(normal[i]);
    }
    return result;
}

}  // namespace

ShadedLights::ShadedLights(const Lights& lights, const WavelengthSet& colours, int first, int count,
                           const Vec3& middle, std::shared_ptr<const EnvironmentPyramid> pyramid)
    : nodes(count), environment(std::move(pyramid)) {
    const auto number = [](double v) { return static_cast<float>(v); };
    surroundings = polarised_as(lights.polarisation);
    constant.assign(static_cast<std::size_t>(count), number(lights.constant));
    for (const LobeLight& light : lights.lobes) {
        const Vec3& d = light.direction;
        const bool whole = light.exponent == std::floor(light.exponent) &&
                           light.exponent <= k_multiplied_out && light.exponent >= 0;
        lobes.push_back({number(d.x), number(d.y), number(d.z), number(light.exponent),
                         whole ? static_cast<int>(light.exponent) : -1,
                         spectrum(light.radiance, colours, first, count),
                         polarised_as(light.radiance.polarisation)});
    }
    for (const HemisphereLight& light : lights.hemispheres) {
        const Vec3& d = light.direction;
        caps.push_back({number(d.x), number(d.y), number(d.z), disc(0), disc(2),
                        spectrum(light.radiance, colours, first, count),
                        polarised_as(light.radiance.polarisation)});
    }
    for (const CapLight& light : lights.caps) {
        const Vec3& d = light.direction;
        const CapCosines cosines = cosines_of(light);
        caps.push_back({number(d.x), number(d.y), number(d.z), disc(cosines.to), disc(cosines.from),
                        spectrum(light.radiance, colours, first, count),
                        polarised_as(light.radiance.polarisation)});
    }
    for (const SphereLight& light : lights.spheres) {
        const Vec3 c = light.center - middle;
        spheres.push_back({number(c.x), number(c.y), number(c.z), number(light.radius),
                           spectrum(light.radiance, colours, first, count),
                           polarised_as(light.radiance.polarisation)});
    }
    for (const PlaneLight& light : lights.planes) {
        Plane plane{};
        const Vec3 point = light.point - middle;
        plane.x = number(light.normal.x);
        plane.y = number(light.normal.y);
        plane.z = number(light.normal.z);
        plane.offset = number(glm::dot(light.normal, point));
        plane.bounded = light.u && light.v;
        if (plane.bounded) {
            const Vec3 &u = *light.u, &v = *light.v;
            const double uu = glm::dot(u, u), vv = glm::dot(v, v), uv = glm::dot(u, v),
                         determinant = uu * vv - uv * uv;
            const Vec3 s = (vv * u - uv * v) / determinant, t = (uu * v - uv * u) / determinant;
            for (int i = 0; i < 3; ++i) {
                plane.s[i] = number(s[i]);
                plane.t[i] = number(t[i]);
            }
            plane.s[3] = number(-glm::dot(s, point));
            plane.t[3] = number(-glm::dot(t, point));
        }
        plane.polarised = polarised_as(light.radiance.polarisation);
        plane.radiance = spectrum(light.radiance, colours, first, count);
        planes.push_back(std::move(plane));
    }
    any_edge = environment || !caps.empty() || !spheres.empty() || !planes.empty();
    // Of the map's texels.
    for (int i = first; environment && i < first + count; ++i) {
        red.push_back(number(colours.primaries()[0][static_cast<std::size_t>(i)]));
        blue.push_back(number(colours.primaries()[2][static_cast<std::size_t>(i)]));
    }
}

}  // namespace culet
