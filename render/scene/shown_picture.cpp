#include "render/scene/shown_picture.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "render/image/exposure.h"
#include "render/scene/film_io.h"
#include "render/scene/ground_shadow.h"
#include "render/scene/light_presets.h"
#include "stone/text/errors.h"

namespace culet {

PngLook look_of(const Scene& scene, const std::string& tonemap) {
    PngLook look = scene.film;
    look.degrees_per_pixel = degrees_per_pixel(scene.camera);
    if (const auto map = tone_map_named(tonemap)) look.tone_map = *map;
    if (look.ground > 0 && scene.has_stone() && !scene.has_objects())
        look.ground_lit = ground_lit(scene.stone.solid, scene.camera);
    return look;
}

PngLook look_for(const Scene& scene, const Picture& picture) {
    PngLook look = look_of(scene, "");
    look.exposure = exposure_for_stone(picture, look.share_over_white);
    return look;
}

std::optional<double> shown_exposure(const std::string& asked, const Scene& scene) {
    if (asked == "auto") return std::nullopt;
    if (asked.empty()) {
        const LightPreset* preset = find_light_preset(scene.light_preset);
        if (preset != nullptr && !preset->instrument) return std::nullopt;
        return 1;
    }
    double factor = 0;
    const char* const end = asked.data() + asked.size();
    const auto [stop, problem] = std::from_chars(asked.data(), end, factor);
    if (problem != std::errc() || stop != end || !(factor > 0) || !std::isfinite(factor)) {
        throw InputError(fmt::format(
            "--exposure is auto, or a factor on linear light above 0, found \"{}\"", asked));
    }
    return factor;
}

}  // namespace culet
