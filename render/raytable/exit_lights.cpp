#include "render/raytable/exit_lights.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace culet {

namespace {

// Squared chord of an angle from the axis; beyond all directions if there is no rim.
float chord_squared(double angle) {
    if (angle >= std::numbers::pi) return 5;
    const double half = 2 * std::sin(angle / 2);
    return static_cast<float>(half * half);
}

}  // namespace

bool ExitLights::too_many(const Lights& lights) {
    return std::count_if(lights.sources.begin(), lights.sources.end(),
                         [](const Light& light) { return is_near(light); }) > k_most_near_lights;
}

ExitLights::ExitLights(const Lights& lights, const WavelengthSet& colours, const Band& band,
                       const Vec3& middle)
    : environment(lights.environment), nodes(band.count) {
    Lights rest;
    rest.constant = lights.constant;
    const auto add_cap = [&](const Vec3& axis, double from, double to, const LightColour& colour) {
        Cap cap{
            {static_cast<float>(axis.x), static_cast<float>(axis.y), static_cast<float>(axis.z)},
            chord_squared(to),
            from > 0 ? chord_squared(from) : -1,
            {}};
        const std::vector<double> all = radiance_of(colour, colours);
        cap.radiance.assign(all.begin() + band.first, all.begin() + band.first + band.count);
        caps.push_back(std::move(cap));
    };
    for (const Light& light : lights.sources) {
        any_near = any_near || is_near(light);
        if (const auto* disc = std::get_if<DiscLight>(&light)) {
            add_cap(disc->direction, disc->from, disc->to, disc->radiance);
        } else if (const auto* half = std::get_if<HemisphereLight>(&light)) {
            add_cap(half->direction, 0, std::numbers::pi / 2, half->radiance);
        } else {
            rest.sources.push_back(light);
        }
    }
    others = ShadedLights(rest, colours, band.first, band.count, middle, nullptr);
    for (int i = band.first; environment && i < band.first + band.count; ++i) {
        red.push_back(static_cast<float>(colours.primaries()[0][static_cast<std::size_t>(i)]));
        blue.push_back(static_cast<float>(colours.primaries()[2][static_cast<std::size_t>(i)]));
    }
}

}  // namespace culet
