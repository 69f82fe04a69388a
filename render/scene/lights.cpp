#include "render/scene/lights.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "stone/solid/least_rotation.h"
#include "stone/solid/perpendicular.h"

namespace culet {

Rgb EnvironmentMap::at(const Vec3& direction) const {
    // Azimuth grows to smaller columns (see the frame in environment_layout.h).
    const double azimuth = std::atan2(direction.y, direction.x);
    const double polar = std::acos(std::clamp(direction.z, -1.0, 1.0));
    const double column = (0.5 - azimuth / (2 * std::numbers::pi)) * width - 0.5;
    const double row = std::clamp(polar / std::numbers::pi * height - 0.5, 0.0, height - 1.0);
    const double x0 = std::floor(column), y0 = std::floor(row);
    const double u = column - x0, v = row - y0;
    const auto texel = [&](double x, double y) {
        const int i = ((static_cast<int>(x) % width) + width) % width;
        const int j = std::min(static_cast<int>(y), height - 1);
        return rgb.data() + 3 * (static_cast<std::size_t>(j) * static_cast<std::size_t>(width) +
                                 static_cast<std::size_t>(i));
    };
    const float *a = texel(x0, y0), *b = texel(x0 + 1, y0), *c = texel(x0, y0 + 1),
                *d = texel(x0 + 1, y0 + 1);
    Rgb result;
    for (int k = 0; k < 3; ++k) {
        result[k] = (1 - v) * ((1 - u) * a[k] + u * b[k]) + v * ((1 - u) * c[k] + u * d[k]);
    }
    return result;
}

std::vector<double> radiance_of(const LightColour& colour, const WavelengthSet& wavelengths) {
    if (const double* number = std::get_if<double>(&colour.value)) {
        return std::vector<double>(wavelengths.wavelengths_nm().size(), *number);
    }
    if (const Rgb* rgb = std::get_if<Rgb>(&colour.value)) return wavelengths.spectrum_of(*rgb);
    return wavelengths.illuminant_relative(std::get<std::string>(colour.value).c_str());
}

LightColour scaled(LightColour colour, double factor) {
    if (auto* number = std::get_if<double>(&colour.value)) *number *= factor;
    if (auto* rgb = std::get_if<Rgb>(&colour.value)) {
        for (double& part : *rgb) part *= factor;
    }
    return colour;
}

DiscCosines cosines_of(const DiscLight& cap) {
    // Full caps include their limits: 180 degrees cover all directions.
    return {cap.from <= 0 ? 2.0 : std::cos(cap.from),
            cap.to >= std::numbers::pi ? -2.0 : std::cos(cap.to)};
}

namespace {

// From inside, the distance to the far side: a dome shines inwards.
double distance_to_ball(const Vec3& center, double radius, const Vec3& origin,
                        const Vec3& direction) {
    const Vec3 to = center - origin;
    const double along = glm::dot(to, direction);
    const Vec3 beside = to - along * direction;
    const double half_squared = radius * radius - glm::dot(beside, beside);
    if (half_squared < 0) return std::numeric_limits<double>::infinity();
    const double half = std::sqrt(half_squared);
    const double distance = along - half > 0 ? along - half : along + half;
    return distance > 0 ? distance : std::numeric_limits<double>::infinity();
}

}  // namespace

double distance_to(const SphereLight& sphere, const Vec3& origin, const Vec3& direction) {
    return distance_to_ball(sphere.center, sphere.radius, origin, direction);
}

double distance_to(const LampLight& lamp, const Vec3& origin, const Vec3& direction) {
    return distance_to_ball(lamp.center, lamp.radius, origin, direction);
}

double share_of(const LampLight& lamp, const Vec3& direction) {
    if (!lamp.photometry) return 1;
    const Vec3 out = -direction;
    const Vec3 of_lamp{glm::dot(out, lamp.zero), glm::dot(out, glm::cross(lamp.zero, lamp.axis)),
                       glm::dot(out, lamp.axis)};
    return lamp.photometry->at(of_lamp) / lamp.photometry->greatest;
}

std::optional<SphereLight> ball_of(const Light& light) {
    if (const auto* sphere = std::get_if<SphereLight>(&light)) return *sphere;
    const auto* lamp = std::get_if<LampLight>(&light);
    if (lamp == nullptr) return std::nullopt;
    return SphereLight{lamp->center, lamp->radius, lamp->radiance};
}

double distance_to(const PlaneLight& plane, const Vec3& origin, const Vec3& direction) {
    const double towards = glm::dot(direction, plane.normal);
    const double height = glm::dot(origin - plane.point, plane.normal);
    if (!(towards < 0) || !(height > 0)) return std::numeric_limits<double>::infinity();
    const double distance = -height / towards;
    if (plane.u && plane.v) {
        // The half-extents need not be perpendicular.
        const Vec3 at = origin + distance * direction - plane.point;
        const double uu = glm::dot(*plane.u, *plane.u), vv = glm::dot(*plane.v, *plane.v);
        const double uv = glm::dot(*plane.u, *plane.v), au = glm::dot(at, *plane.u),
                     av = glm::dot(at, *plane.v);
        const double determinant = uu * vv - uv * uv;
        const double s = (au * vv - av * uv) / determinant, t = (av * uu - au * uv) / determinant;
        if (std::abs(s) > 1 || std::abs(t) > 1) return std::numeric_limits<double>::infinity();
    }
    return distance;
}

double share_of(const CosinePowerLight& lobe, const Vec3& direction) {
    const double cosine = glm::dot(direction, lobe.direction);
    return cosine > 0 ? std::pow(cosine, lobe.exponent) : 0;
}

double share_of(const HemisphereLight& half, const Vec3& direction) {
    return glm::dot(direction, half.direction) > 0 ? 1 : 0;
}

double share_of(const DiscLight& cap, const DiscCosines& cosines, const Vec3& direction) {
    const double cosine = glm::dot(direction, cap.direction);
    return cosine <= cosines.from && cosine > cosines.to ? 1 : 0;
}

Vec3 LinearPolarisation::of_ray(const Vec3& direction) const {
    if (!normal) {
        const Vec3 across = vibration - glm::dot(vibration, direction) * direction;
        const double length = glm::length(across);
        return length > 0 ? across / length : perpendicular_to(direction);
    }
    const Vec3 from = glm::dot(*normal, direction) < 0 ? -*normal : *normal;
    // Remove the rounding error along the sheet's normal.
    const Vec3 in_sheet = glm::normalize(vibration - glm::dot(vibration, from) * from);
    return turned_with(from, direction, in_sheet);
}

const LightColour& colour_of(const Light& light) {
    return std::visit([](const auto& l) -> const LightColour& { return l.radiance; }, light);
}

LightColour& colour_of(Light& light) {
    return std::visit([](auto& l) -> LightColour& { return l.radiance; }, light);
}

bool is_near(const Light& light) {
    return std::visit([](const auto& l) { return l.k_is_near; }, light);
}

bool has_edge(const Light& light) {
    return std::visit([](const auto& l) { return l.k_has_edge; }, light);
}

bool polarised(const Lights& lights) {
    return lights.polarisation ||
           std::any_of(lights.sources.begin(), lights.sources.end(), [](const Light& light) {
               return colour_of(light).polarisation.has_value();
           });
}

namespace {

DiscLight rim(const Vec3& direction, double angle, double width, const LightColour& radiance) {
    return {direction, std::max(0.0, angle - width), std::min(angle + width, std::numbers::pi),
            radiance};
}

}  // namespace

void add_rims(const DiscLight& cap, const Vec3&, double width, std::vector<Light>& rims) {
    rims.push_back(rim(cap.direction, cap.to, width, cap.radiance));
    if (cap.from > 0) rims.push_back(rim(cap.direction, cap.from, width, cap.radiance));
}

void add_rims(const HemisphereLight& half, const Vec3&, double width, std::vector<Light>& rims) {
    rims.push_back(rim(half.direction, std::numbers::pi / 2, width, half.radiance));
}

void add_rims(const PlaneLight& plane, const Vec3& from, double width, std::vector<Light>& rims) {
    width *= glm::length(plane.point - from);
    if (!plane.u || !plane.v) return;
    const Vec3 u = *plane.u, v = *plane.v;
    const double along_u = glm::length(u), along_v = glm::length(v);
    if (!(along_u > 0) || !(along_v > 0)) return;
    for (const double side : {-1.0, 1.0}) {
        PlaneLight one = plane;
        one.point = plane.point + side * u;
        one.u = u * (width / along_u);
        one.v = v * (1 + width / along_v);
        rims.push_back(one);
        one.point = plane.point + side * v;
        one.u = u * (1 + width / along_u);
        one.v = v * (width / along_v);
        rims.push_back(one);
    }
}

void add_rims(SphereLight sphere, const Vec3& from, double width, std::vector<Light>& rims) {
    sphere.radius += width * glm::length(sphere.center - from);
    // A light whose widened ball would contain the stone is not small.
    if (sphere.radius < glm::length(sphere.center - from)) rims.push_back(sphere);
}

void add_rims(const LampLight& lamp, const Vec3& from, double width, std::vector<Light>& rims) {
    add_rims(SphereLight{lamp.center, lamp.radius, lamp.radiance}, from, width, rims);
}

void add_rims(CosinePowerLight lobe, const Vec3&, double width, std::vector<Light>& rims) {
    // The lobe cos^e falls to 0.37 at an angle of about sqrt(2 / e).
    const double angle = std::sqrt(2 / std::max(lobe.exponent, 1.0));
    lobe.exponent = 2 / ((angle + width) * (angle + width));
    rims.push_back(lobe);
}

}  // namespace culet
