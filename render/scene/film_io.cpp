#include "render/scene/film_io.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <numbers>

namespace culet {

namespace {

constexpr double k_strongest = 100, k_parallel_view_deg = 20;

// Booleans count as `usual` and 0.
double strength_of(const TomlTable& table, const char* key, double preset, double usual = 1) {
    if (table.kind(key) == TomlTable::Kind::boolean) return *table.boolean(key) ? usual : 0;
    const double strength = table.number(key).value_or(preset);
    if (!(strength >= 0 && strength <= k_strongest))
        table.fail(key, fmt::format("{} is true, false or a strength, 0 to {}, found {}", key,
                                    k_strongest, strength));
    return strength;
}

}  // namespace

PngLook read_film(const TomlTable& table, PngLook look) {
    table.refuse_unknown({"glare", "sparkle", "alpha", "ground", "tonemap"});
    look.glare = strength_of(table, "glare", look.glare);
    look.sparkle = strength_of(table, "sparkle", look.sparkle);
    look.ground = strength_of(table, "ground", look.ground, k_usual_ground);
    look.alpha = table.boolean("alpha").value_or(look.alpha);
    if (const auto name = table.text("tonemap")) {
        const auto known = tone_map_named(*name);
        if (!known)
            table.fail("tonemap", fmt::format("no tone map \"{}\"; known: {}", *name,
                                              fmt::join(tone_map_names(), ", ")));
        look.tone_map = *known;
    }
    return look;
}

double degrees_per_pixel(const Camera& camera) {
    if (camera.orthographic_width || camera.cone) return k_parallel_view_deg / camera.height;
    // At the picture's middle, d tan(angle) is one pixel.
    return 2 * std::tan(camera.fov / 2) / camera.height * 180 / std::numbers::pi;
}

}  // namespace culet
