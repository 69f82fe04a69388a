#include "render/scene/table_values.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>

namespace culet {

namespace {

// Floats end at 3e38 and lose digits below 1e-38; there is room for sums of lights and for what
// is left behind a stone.
constexpr double k_brightest = 1e36, k_dimmest = 1e-36;

}  // namespace

Vec3 direction_in(const TomlTable& table, const char* key) {
    const auto value = table.vector(key);
    if (!value) table.fail("", fmt::format("{} is missing", key));
    const double length = glm::length(*value);
    if (!(length > 0) || !std::isfinite(length))
        table.fail(key, fmt::format("{} must not be the zero vector", key));
    return *value / length;
}

Vec3 point_in(const TomlTable& table, const char* key) {
    const auto value = table.vector(key);
    if (!value) table.fail("", fmt::format("{} is missing", key));
    return *value;
}

double positive_in(const TomlTable& table, const char* key) {
    const auto value = table.number(key);
    if (!value) table.fail("", fmt::format("{} is missing", key));
    if (!(*value > 0)) table.fail(key, fmt::format("{} must be positive, found {}", key, *value));
    return *value;
}

double checked_radiance(const TomlTable& table, const char* key, double value) {
    if (value < 0) table.fail(key, fmt::format("{} must not be negative, found {}", key, value));
    if (value > k_brightest || (value > 0 && value < k_dimmest)) {
        table.fail(key,
                   fmt::format("{} of {:g} is {} than a picture can hold (0, or {:g} to "
                               "{:g}): scale all lights by one factor",
                               key, value, value > 1 ? "more" : "less", k_dimmest, k_brightest));
    }
    return value;
}

LightColour unpolarised_radiance_in(const TomlTable& table) {
    switch (table.kind("radiance")) {
        case TomlTable::Kind::missing:
            return {1.0};
        case TomlTable::Kind::number: {
            return {checked_radiance(table, "radiance", *table.number("radiance"))};
        }
        case TomlTable::Kind::list: {
            const auto list = *table.numbers("radiance");
            if (list.size() != 3)
                table.fail("radiance",
                           fmt::format("a colour has three numbers, found {}", list.size()));
            for (double v : list) checked_radiance(table, "radiance", v);
            return {Rgb{list[0], list[1], list[2]}};
        }
        case TomlTable::Kind::text: {
            const std::string name = *table.text("radiance");
            if (illuminant(name.c_str()) == nullptr) {
                table.fail("radiance", fmt::format("no spectrum \"{}\"; known: D65, A", name));
            }
            return {name};
        }
        default:
            table.fail("radiance",
                       "radiance is a number, [r, g, b], or a spectrum by name (D65, A)");
    }
}

SurfaceColour share_in(const TomlTable& table, const char* key, double usual) {
    const auto checked = [&](double share) {
        if (!(share >= 0 && share <= 1))
            table.fail(key,
                       fmt::format("{} is a share of the light, 0 to 1, found {}", key, share));
        return share;
    };
    if (!table.has(key)) return {usual};
    const SurfaceColour colour = colour_in(table, key);
    std::visit(
        [&](const auto& value) {
            if constexpr (std::is_same_v<std::decay_t<decltype(value)>, double>) {
                checked(value);
            } else {
                for (const double c : value) checked(c);
            }
        },
        colour.value);
    return colour;
}

SurfaceColour colour_in(const TomlTable& table, const char* key) {
    const auto checked = [&](double value) {
        if (value < 0)
            table.fail(key, fmt::format("{} must not be negative, found {}", key, value));
        return value;
    };
    if (table.kind(key) == TomlTable::Kind::number) return {checked(*table.number(key))};
    if (table.kind(key) != TomlTable::Kind::list)
        table.fail(key, fmt::format("{} is a number, or [r, g, b]", key));
    const auto list = *table.numbers(key);
    if (list.size() != 3)
        table.fail(key, fmt::format("a colour has three numbers, found {}", list.size()));
    return {Rgb{checked(list[0]), checked(list[1]), checked(list[2])}};
}

}  // namespace culet
