#pragma once
// The only place where units are converted. Inside culet, angles are radians and lengths are in the
// stone's own unit; a name with another unit says so (`tilt_deg`, `depth_mm`).

#include <numbers>
#include <optional>
#include <string_view>

namespace culet {

enum class LengthUnit { mm, cm, m, inch };

constexpr double mm_per(LengthUnit unit) {
    switch (unit) {
        case LengthUnit::mm:
            return 1.0;
        case LengthUnit::cm:
            return 10.0;
        case LengthUnit::m:
            return 1000.0;
        case LengthUnit::inch:
            return 25.4;
    }
    return 1.0;
}

/// `mm`, `cm`, `m` or `in`; nothing for any other word.
constexpr std::optional<LengthUnit> length_unit(std::string_view name) {
    if (name == "mm") return LengthUnit::mm;
    if (name == "cm") return LengthUnit::cm;
    if (name == "m") return LengthUnit::m;
    if (name == "in") return LengthUnit::inch;
    return std::nullopt;
}

constexpr std::string_view name_of(LengthUnit unit) {
    switch (unit) {
        case LengthUnit::mm:
            return "mm";
        case LengthUnit::cm:
            return "cm";
        case LengthUnit::m:
            return "m";
        case LengthUnit::inch:
            return "in";
    }
    return "mm";
}

constexpr double radians(double degrees) {
    return degrees * (std::numbers::pi / 180.0);
}
constexpr double degrees(double radians) {
    return radians * (180.0 / std::numbers::pi);
}

/// Carat of a volume in mm3 at a density in g/cm3 (1 ct = 0.2 g).
constexpr double carat(double volume_mm3, double density_g_cm3) {
    return volume_mm3 * density_g_cm3 / 200.0;
}

}  // namespace culet
