#include "render/beams/beam_lights.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

namespace culet {

namespace {

// Integer exponents up to this are multiplied out.
constexpr double k_multiplied_out = 64;

std::vector<float> spectrum(const LightColour& colour, const WavelengthSet& colours, int first,
                            int count) {
    const std::vector<double> all = radiance_of(colour, colours);
    return {all.begin() + first, all.begin() + first + count};
}

// A cosine above 1 means no direction, below -1 all directions.
ShadedLights::Disc disc(double cosine) {
    const double sine = std::sqrt(std::max(0.0, (1 - cosine) * (1 + cosine)));
    return {static_cast<float>(cosine), static_cast<float>(sine)};
}

ShadedLights::Polarised polarised_as(const std::optional<LinearPolarisation>& light) {
    ShadedLights::Polarised result;
    if (!light) return result;
    result.degree = static_cast<float>(light->degree);
    result.sheet = light->normal.has_value();
    // Project the direction into the sheet.
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

struct ShadedLights::Adder {
    ShadedLights& to;
    const WavelengthSet& colours;
    int first, count;
    const Vec3& middle;

    static float number(double v) { return static_cast<float>(v); }
    std::vector<float> radiance(const LightColour& colour) const {
        return spectrum(colour, colours, first, count);
    }

    void operator()(const CosinePowerLight& light) const {
        const Vec3& d = light.direction;
        const bool whole = light.exponent == std::floor(light.exponent) &&
                           light.exponent <= k_multiplied_out && light.exponent >= 0;
        to.lobes.push_back({number(d.x), number(d.y), number(d.z), number(light.exponent),
                            whole ? static_cast<int>(light.exponent) : -1, radiance(light.radiance),
                            polarised_as(light.radiance.polarisation)});
    }
    void operator()(const HemisphereLight& light) const {
        const Vec3& d = light.direction;
        to.caps.push_back({number(d.x), number(d.y), number(d.z), disc(0), disc(2),
                           radiance(light.radiance), polarised_as(light.radiance.polarisation)});
    }
    void operator()(const DiscLight& light) const {
        const Vec3& d = light.direction;
        const DiscCosines cosines = cosines_of(light);
        to.caps.push_back({number(d.x), number(d.y), number(d.z), disc(cosines.to),
                           disc(cosines.from), radiance(light.radiance),
                           polarised_as(light.radiance.polarisation)});
    }
    void operator()(const SphereLight& light) const {
        const Vec3 c = light.center - middle;
        to.spheres.push_back({number(c.x), number(c.y), number(c.z), number(light.radius),
                              radiance(light.radiance), polarised_as(light.radiance.polarisation),
                              nullptr});
    }
    void operator()(const LampLight& light) const {
        (*this)(SphereLight{light.center, light.radius, light.radiance});
        to.spheres.back().lamp = std::make_shared<const LampLight>(light);
    }
    void operator()(const PlaneLight& light) const {
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
        plane.radiance = radiance(light.radiance);
        to.planes.push_back(std::move(plane));
    }
};

ShadedLights::ShadedLights(const Lights& lights, const WavelengthSet& colours, int first, int count,
                           const Vec3& middle, std::shared_ptr<const EnvironmentPyramid> pyramid)
    : nodes(count), environment(std::move(pyramid)) {
    surroundings = polarised_as(lights.polarisation);
    constant.assign(static_cast<std::size_t>(count), static_cast<float>(lights.constant));
    for (const Light& light : lights.sources) {
        std::visit(Adder{*this, colours, first, count, middle}, light);
        any_edge = any_edge || has_edge(light);
    }
    any_edge = any_edge || environment;
    for (int i = first; environment && i < first + count; ++i) {
        red.push_back(static_cast<float>(colours.primaries()[0][static_cast<std::size_t>(i)]));
        blue.push_back(static_cast<float>(colours.primaries()[2][static_cast<std::size_t>(i)]));
    }
}

}  // namespace culet
