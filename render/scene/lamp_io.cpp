#include "render/scene/lamp_io.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "render/scene/table_values.h"
#include "stone/text/output_file.h"

namespace culet {

namespace {

// Radius of the ball that stands for a lamp: of its opening's area, else a part of the distance.
double radius_of(const TomlTable& t, const Photometry& lamp, const Vec3& center, double mm) {
    constexpr double k_part_of_distance = 0.05;  // a point lamp, drawn small
    if (t.has("radius")) return positive_in(t, "radius");
    const double distance = glm::length(center);
    if (!(lamp.opening_mm2 > 0) && distance > 0) return k_part_of_distance * distance;
    const double radius = std::sqrt(lamp.opening_mm2 / std::numbers::pi) / mm;
    if (radius < distance) return radius;
    t.fail("position",
           fmt::format("the lamp's opening has a radius of {:.4g} and reaches the middle of the "
                       "scene, {:.4g} away: move the lamp away, or give it a radius",
                       radius, distance));
}

Photometry photometry_in(const TomlTable& t) {
    constexpr std::size_t k_largest_file = 64u << 20;
    const auto file = t.path("file");
    if (!file) t.fail("", "file is missing: the lamp's photometry, .ies or .ldt");
    const std::string* const held = t.held_file("file");
    return photometry_of(held != nullptr ? *held : read_text(*file, k_largest_file), *file);
}

}  // namespace

// Irradiance at a distance d in the stone's unit is scale * candela / d^2: the ball has the
// radiance scale * candela / (pi radius^2).
LampLight lamp_of(const TomlTable& t, LengthUnit unit) {
    t.refuse_unknown({"file", "position", "direction", "zero", "scale", "radius", "tilt",
                      "polarization", "degree_of_polarization"});
    Photometry photometry = photometry_in(t);
    LampLight lamp;
    lamp.center = point_in(t, "position");
    lamp.axis = t.has("direction") ? direction_in(t, "direction") : Vec3{0, 0, -1};
    const bool along_x = std::abs(lamp.axis.x) > 0.99;
    const Vec3 zero = t.has("zero") ? direction_in(t, "zero")
                      : along_x     ? Vec3{0, 1, 0}
                                    : Vec3{1, 0, 0};
    const Vec3 across = zero - glm::dot(zero, lamp.axis) * lamp.axis;
    if (!(glm::length(across) > 1e-6))
        t.fail("zero", "zero must not be parallel to the lamp's direction");
    lamp.zero = glm::normalize(across);
    lamp.radius = radius_of(t, photometry, lamp.center, mm_per(unit));
    if (t.has("tilt") && photometry.tilt.empty())
        t.fail("tilt", "tilt needs a file with a table of tilts (TILT=INCLUDE)");
    const double most = photometry.greatest *
                        photometry.factor_at_tilt(t.number("tilt").value_or(0)) /
                        (std::numbers::pi * lamp.radius * lamp.radius);
    const SurfaceColour scale = t.has("scale") ? colour_in(t, "scale") : SurfaceColour{1.0};
    std::visit([&](const auto& value) { lamp.radiance.value = value; }, scale.value);
    lamp.radiance = scaled(lamp.radiance, most);
    if (const auto* number = std::get_if<double>(&lamp.radiance.value))
        checked_radiance(t, "scale", *number);
    if (const auto* rgb = std::get_if<Rgb>(&lamp.radiance.value)) {
        for (const double part : *rgb) checked_radiance(t, "scale", part);
    }
    lamp.photometry = std::make_shared<const Photometry>(std::move(photometry));
    return lamp;
}

}  // namespace culet
