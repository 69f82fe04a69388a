#include "render/light_presets.h"

#include <glm/geometric.hpp>

#include "stone/units.h"

namespace culet {

namespace {

CapLight band(const Vec3& axis, double from_deg, double to_deg, LightColour colour) {
    return {axis, radians(from_deg), radians(to_deg), std::move(colour)};
}

Lights reflector(const Vec3& axis) {
    Lights lights;
    lights.caps.push_back(band(axis, 15, 80, {Rgb{1.0, 0.25, 0.3}}));
    return lights;
}

PlaneLight window(const Vec3& point, const Vec3& towards, double half_width, double half_height) {
    const Vec3 normal = glm::normalize(towards - point);
    const Vec3 u = glm::normalize(glm::cross(Vec3{0, 0, 1}, normal));
    const Vec3 v = glm::cross(normal, u);
    return {point, normal, half_width * u, half_height * v, {1.0}};
}

}  // namespace

std::optional<Lights> light_preset(std::string_view name, double stone_diameter) {
    const Vec3 up{0, 0, 1};
    Lights lights;
    if (name == "aset") {
        lights.caps.push_back(band(up, 0, 15, {Rgb{0.1, 0.2, 1.0}}));
        lights.caps.push_back(band(up, 15, 45, {Rgb{1.0, 0.1, 0.1}}));
        lights.caps.push_back(band(up, 45, 90, {Rgb{0.1, 0.8, 0.1}}));
        return lights;
    }
    if (name == "arrows") return reflector(up);
    if (name == "hearts") return reflector(-up);
    if (name == "lightbox") {
        const double d = stone_diameter;
        lights.constant = 0.05;
        lights.planes.push_back(window({12 * d, 3 * d, 12 * d}, {0, 0, 0}, 3 * d, 5 * d));
        lights.planes.push_back(window({-9 * d, -7 * d, 14 * d}, {0, 0, 0}, 2 * d, 3 * d));
        for (PlaneLight& plane : lights.planes) plane.radiance = {2.5};
        return lights;
    }
    if (name == "daylight") {
        lights.hemispheres.push_back({up, {Rgb{0.45, 0.5, 0.6}}});
        lights.lobes.push_back({up, 2, {Rgb{0.25, 0.4, 0.8}}});
        lights.caps.push_back(
            band(glm::normalize(Vec3{1, 0.4, 1.1}), 0, 0.27, {Rgb{9000, 8600, 7900}}));
        lights.constant = 0.08;
        return lights;
    }
    return std::nullopt;
}

}  // namespace culet
