#include "render/image/film_look.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "render/image/glare.h"
#include "render/image/sparkle.h"

namespace culet {

namespace {

// In the order of `ToneMap`.
constexpr std::array k_tone_maps{"none", "reinhard", "filmic", "gamma2"};

// Upper limit that keeps sums finite; brighter light looks the same in every picture.
constexpr float k_brightest = 1e30f;

double mapped(double v, ToneMap map) {
    switch (map) {
        case ToneMap::reinhard:
            return v / (1 + v);
        case ToneMap::filmic:
            return v * (2.51 * v + 0.03) / (v * (2.43 * v + 0.59) + 0.14);
        case ToneMap::gamma2:
            // sRGB encodes this as the square root.
            return srgb_decoded(std::sqrt(std::min(v, 1.0)));
        case ToneMap::none:
            break;
    }
    return v;
}

// The ground behind the stone, in place of the light that comes from there.
void draw_ground(const Picture& picture, const PngLook& look, std::vector<float>& rgb) {
    const bool shaded = look.ground_lit.size() == picture.pixels();
    for (std::size_t p = 0; p < picture.coverage.size(); ++p) {
        const float seen = 1 - picture.coverage[p];
        if (!(seen > 0)) continue;
        const float light =
            seen * static_cast<float>(look.ground) * (shaded ? look.ground_lit[p] : 1.0f);
        for (std::size_t c = 3 * p; c < 3 * p + 3; ++c)
            rgb[c] = light + (seen < 1 ? picture.rgb[c] : 0.0f);
    }
}

bool draws_ground(const PngLook& look) {
    return look.ground > 0 && !look.alpha;
}

}  // namespace

std::vector<std::string> tone_map_names() {
    return {k_tone_maps.begin(), k_tone_maps.end()};
}

std::optional<ToneMap> tone_map_named(const std::string& name) {
    const auto found = std::find(k_tone_maps.begin(), k_tone_maps.end(), name);
    if (found == k_tone_maps.end()) return std::nullopt;
    return static_cast<ToneMap>(found - k_tone_maps.begin());
}

std::string name_of(ToneMap map) {
    return k_tone_maps[static_cast<std::size_t>(map)];
}

float exposed(float light, double exposure) {
    const double lit = exposure * static_cast<double>(light);
    return lit > 0 ? static_cast<float>(std::min(lit, double{k_brightest})) : 0.0f;
}

float tone_mapped(float light, ToneMap map) {
    return static_cast<float>(std::clamp(mapped(static_cast<double>(light), map), 0.0, 1.0));
}

bool is_pointwise(const PngLook& look) {
    return !(look.glare > 0 || look.sparkle > 0 || draws_ground(look));
}

std::vector<float> as_shown(const Picture& picture, const PngLook& look) {
    std::vector<float> rgb = picture.rgb;
    if (draws_ground(look)) draw_ground(picture, look, rgb);
    std::transform(rgb.begin(), rgb.end(), rgb.begin(),
                   [&](float v) { return exposed(v, look.exposure); });
    const PictureSize size{picture.width, picture.height};
    if (look.glare > 0) add_glare(rgb, size, look.glare, look.degrees_per_pixel);
    if (look.sparkle > 0) add_sparkle(rgb, size, look.sparkle);
    for (float& v : rgb) v = tone_mapped(v, look.tone_map);
    return rgb;
}

}  // namespace culet
