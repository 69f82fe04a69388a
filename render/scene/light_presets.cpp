#include "render/scene/light_presets.h"

#include <fmt/format.h>

#include <cmath>

#include <glm/geometric.hpp>

#include "stone/numbers/units.h"
#include "stone/text/name_suggestions.h"
#include "stone/text/toml_file.h"

namespace culet {

namespace {

const Vec3 k_up{0, 0, 1};

DiscLight band(const Vec3& axis, double from_deg, double to_deg, LightColour colour) {
    return {glm::normalize(axis), radians(from_deg), radians(to_deg), std::move(colour)};
}

// The viewer's hood around the hole for the eye.
Lights reflector(const Vec3& axis, double hole_deg) {
    Lights lights;
    lights.sources.push_back(band(axis, hole_deg, k_scope_rim_deg, {Rgb{1.0, 0.25, 0.3}}));
    return lights;
}

// A direction by azimuth and elevation, degrees.
Vec3 towards(double azimuth, double elevation) {
    const double a = radians(azimuth), e = radians(elevation);
    return {std::cos(a) * std::cos(e), std::sin(a) * std::cos(e), std::sin(e)};
}

// The camera and the person behind it, whose outline is soft, a ring of light round them, and a
// tent that is dim at the sides: crowns reflect these to the camera, and the light of the ring back
// to itself, so that stones show their colour instead of white reflections. The radiances are those
// whose pictures of eleven cuts in diamond have most of five statistics in the range of photographs
// (bench_look) among 144 tried.
Lights photograph() {
    Lights lights;
    constexpr struct {
        double from_deg, to_deg, radiance;
    } k_tent[] = {{0, 20, 0.01},  {20, 25, 0.5}, {25, 45, 1.3},
                  {45, 60, 0.25}, {60, 75, 0.1}, {75, 90, 0.08}};
    for (const auto& ring : k_tent)
        lights.sources.push_back(band(k_up, ring.from_deg, ring.to_deg, {ring.radiance}));
    // The table: darkest under the stone, which shades it.
    lights.sources.push_back(band(-k_up, 0, 70, {0.02}));
    lights.sources.push_back(band(-k_up, 70, 90, {0.1}));
    // A window.
    lights.sources.push_back(band(towards(20, 42), 0, 13, {1.0}));
    return lights;
}

// The curve of a film, and the ground that the stone lies on.
PngLook photographer_s_film() {
    PngLook film;
    film.tone_map = ToneMap::filmic;
    film.share_over_white = 0.15;
    film.ground = k_usual_ground;
    return film;
}

Lights jeweller() {
    Lights lights;
    lights.constant = 0.05;
    lights.sources.push_back(band(k_up, 12, 40, {0.7}));
    lights.sources.push_back(band({1, 0.3, 0.6}, 0, 18, {3.0}));
    lights.sources.push_back(band({-0.6, 1, 0.9}, 0, 10, {2.0}));
    lights.sources.push_back(HemisphereLight{k_up, {0.12}});
    return lights;
}

Lights daylight() {
    Lights lights;
    lights.constant = 0.04;
    const Vec3 sun{1, 0.4, 1.1};
    // The sky between head and trees, paler near the sun.
    lights.sources.push_back(band(k_up, 15, 75, {Rgb{0.33, 0.37, 0.43}}));
    lights.sources.push_back(CosinePowerLight{glm::normalize(sun), 6, {Rgb{1.3, 1.25, 1.15}}});
    lights.sources.push_back(band(sun, 0, 2.5, {Rgb{60, 56, 50}}));
    return lights;
}

Lights lightbox() {
    Lights lights;
    lights.sources.push_back(HemisphereLight{-k_up, {0.9}});
    lights.sources.push_back(band(k_up, 10, 38, {0.9}));
    lights.sources.push_back(band(k_up, 52, 90, {0.6}));
    for (const double side : {-1.0, 1.0})
        lights.sources.push_back(band({side, 0.2, 0.45}, 0, 20, {2.0}));
    return lights;
}

Lights darkfield() {
    Lights lights;
    lights.constant = 0.02;
    lights.sources.push_back(band(-k_up, k_darkfield_from_deg, k_darkfield_to_deg, {1.0}));
    return lights;
}

Lights aset() {
    Lights lights;
    lights.sources.push_back(band(k_up, 0, k_aset_blue_deg, {Rgb{0.1, 0.2, 1.0}}));
    lights.sources.push_back(band(k_up, k_aset_blue_deg, k_aset_red_deg, {Rgb{1.0, 0.1, 0.1}}));
    lights.sources.push_back(band(k_up, k_aset_red_deg, 90, {Rgb{0.1, 0.8, 0.1}}));
    return lights;
}

Lights idealscope() {
    Lights lights = reflector(k_up, k_scope_eye_deg);
    lights.sources.push_back(HemisphereLight{-k_up, {1.0}});
    return lights;
}

struct Made {
    LightPreset preset;
    Lights (*lights)();
};

const std::vector<Made>& all_made() {
    static const std::vector<Made> made{
        {{"jeweller", "a ring of light, two windows, a dim room", Facing::crown, false}, jeweller},
        {{"photograph", "a photographer's ring of light, a dark camera, a window",
          Facing::photograph, false, photographer_s_film()},
         photograph},
        {{"daylight", "an open sky, a hazy sun, dim ground", Facing::crown, false}, daylight},
        {{"lightbox", "a white tent with two lamps and the lens's hole", Facing::crown, false},
         lightbox},
        {{"darkfield", "a ring of light from below the girdle, dark ground", Facing::crown, false},
         darkfield},
        {{"aset", "red, green and blue by elevation (AGS)", Facing::crown, true}, aset},
        {{"idealscope", "a red reflector, white light from below", Facing::crown, true},
         idealscope},
        {{"arrows", "a red reflector before the crown", Facing::crown, true},
         [] { return reflector(k_up, k_scope_eye_deg); }},
        {{"hearts", "a red reflector before the pavilion, seen from below", Facing::pavilion, true},
         [] { return reflector(-k_up, k_hearts_eye_deg); }}};
    return made;
}

}  // namespace

const std::vector<LightPreset>& light_presets() {
    static const std::vector<LightPreset> presets = [] {
        std::vector<LightPreset> all;
        for (const Made& made : all_made()) all.push_back(made.preset);
        return all;
    }();
    return presets;
}

const LightPreset* find_light_preset(std::string_view name) {
    for (const LightPreset& preset : light_presets()) {
        if (preset.name == name) return &preset;
    }
    return nullptr;
}

std::optional<Lights> light_preset(std::string_view name) {
    for (const Made& made : all_made()) {
        if (made.preset.name == name) return made.lights();
    }
    return std::nullopt;
}

std::string no_light_preset(std::string_view name) {
    std::vector<std::string> known;
    for (const LightPreset& preset : light_presets()) known.emplace_back(preset.name);
    for (const char* view : {"polariscope", "conoscope", "dichroscope"}) known.emplace_back(view);
    const auto near = nearest_name(name, known);
    return fmt::format("no light \"{}\"{}; known: {}", name,
                       near ? fmt::format(", did you mean \"{}\"?", *near) : "",
                       fmt::join(known, ", "));
}

}  // namespace culet
