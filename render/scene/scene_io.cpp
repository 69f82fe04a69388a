#include "render/scene/scene_io.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "render/scene/camera_io.h"
#include "render/scene/film_io.h"
#include "render/scene/framing.h"
#include "render/scene/light_io.h"
#include "render/scene/light_presets.h"
#include "render/scene/settings_io.h"
#include "render/scene/view_presets.h"
#include "stone/errors.h"
#include "stone/material_io.h"
#include "stone/stone_io.h"

namespace culet {

namespace {

// The instrument that the scene is seen through, and the table that names it.
std::optional<std::pair<std::string, TomlTable>> view_in(const TomlTable& root) {
    std::optional<std::pair<std::string, TomlTable>> view;
    const auto take = [&view](const TomlTable& table, bool may_be_light) {
        const auto name = table.text("preset");
        if (!name || (may_be_light && !is_view_preset(*name))) return;
        if (!is_view_preset(*name)) {
            table.fail("preset",
                       fmt::format("no view \"{}\"; known: polariscope, conoscope, dichroscope "
                                   "(presets of lights stand in [light])",
                                   *name));
        }
        if (view) table.fail("preset", "the view is named twice");
        view.emplace(*name, table);
    };
    take(root, false);
    for (const char* key : {"camera", "light", "render"}) {
        if (root.kind(key) == TomlTable::Kind::table)
            take(*root.table(key), std::string(key) == "light");
    }
    return view;
}

}  // namespace

Stone scene_stone_of(const TomlTable& root, std::vector<std::string>& notes) {
    if (root.has("stone") == root.has("mesh")) {
        root.fail("",
                  "a scene names its stone: stone = \"stone.toml\", or mesh = \"...\" with "
                  "material = \"...\"");
    }
    Stone stone;
    if (root.has("stone")) {
        for (const char* key : {"unit", "convex"}) {
            if (root.has(key))
                root.fail(key, fmt::format("{} belongs to the stone file that the scene names, {}",
                                           key, root.path("stone")->filename().string()));
        }
        StoneFile file = read_stone(*root.path("stone"));
        if (!root.has("material")) require_material(file, *root.path("stone"));
        stone = std::move(file.stone);
        for (std::string& note : file.notes) notes.push_back(std::move(note));
    } else {
        SolidFile file = read_solid(*root.path("mesh"));
        stone.solid = std::move(file.solid);
        for (std::string& note : file.notes) notes.push_back(std::move(note));
        stone.name = root.path("mesh")->stem().string();
        if (const auto unit = root.text("unit")) {
            const auto known = length_unit(*unit);
            if (!known)
                root.fail("unit", fmt::format("unit is \"{}\"; expected mm, cm, m or in", *unit));
            stone.unit = *known;
        }
        stone.convex = root.boolean("convex").value_or(true);
    }
    // Beside a stone file these are said of this picture only: the same stone in another material.
    if (const auto name = root.text("name")) stone.name = *name;
    if (root.has("material") || root.has("mesh")) {
        stone.material = root.kind("material") == TomlTable::Kind::table
                             ? material_of(*root.table("material"))
                             : material_named_in(root, root);
    }
    if (root.has("mesh") || root.has("optic_axis") || root.has("principal_axes"))
        stone.crystal = crystal_frame_in(root, stone.material.optic);
    return stone;
}

Scene scene_of(const TomlTable& root, const Stone* stone_instead, std::string_view light_instead) {
    root.refuse_unknown(with_view_keys(
        {"stone", "mesh", "material", "unit", "optic_axis", "principal_axes", "convex", "name",
         "camera", "light", "object", "render", "film", "immersion", "absorption_scale"}));
    Scene scene;
    if (root.has("object")) root.fail("object", "objects around the stone are not rendered yet");
    if (stone_instead != nullptr) {
        scene.stone = *stone_instead;
    } else {
        scene.stone = scene_stone_of(root, scene.notes);
    }
    if (std::string missing = missing_colour(scene.stone.material); !missing.empty())
        scene.notes.push_back(std::move(missing));
    if (const auto scale = root.number("absorption_scale")) {
        if (!(*scale >= 0 && *scale <= 1000)) {
            root.fail("absorption_scale",
                      fmt::format("absorption_scale is a factor on the material's absorption, 0 to "
                                  "1000, found {}",
                                  *scale));
        }
        for (Spectrum& absorption : scene.stone.material.absorption_per_mm)
            absorption = absorption.scaled(*scale);
    }
    if (const auto immersion = root.number("immersion")) {
        if (!(*immersion >= 1 && *immersion <= 4)) {
            root.fail("immersion",
                      fmt::format("immersion is a refractive index, 1 to 4, found {}", *immersion));
        }
        scene.immersion = *immersion;
    }
    const auto view = view_in(root);
    const auto camera = root.table("camera"), light = root.table("light");
    std::string preset(light_instead);
    if (!preset.empty()) {
        const auto lights = light_preset(preset);
        if (!lights) throw InputError(no_light_preset(preset));
        scene.lights = *lights;
    } else if (light) {
        scene.lights = lights_of(*light, scene.notes);
        preset = light->text("preset").value_or("");
    } else if (!view) {
        root.fail("", "the scene is dark: add a [light] table, e.g. preset = \"jeweller\"");
    }
    const LightPreset* known = find_light_preset(preset);
    if (known != nullptr) scene.light_preset = known->name;
    if (camera) scene.camera = read_camera(*camera);
    if (!camera || !names_a_view(*camera)) {
        const bool below = known != nullptr && known->from_below;
        frame_stone(scene.stone.solid, below ? Facing::pavilion : Facing::crown, scene.camera);
    }
    if (view) apply_view_preset(view->first, view->second, scene);
    if (const auto film = root.table("film")) scene.film = read_film(*film);
    const auto settings = root.table("render");
    if (settings) scene.settings = read_settings(*settings);
    scene.names_tolerance = settings && settings->has("tolerance");
    return scene;
}

Scene read_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                 const Stone* stone_instead, std::string_view light_instead) {
    return scene_of(read_toml(file, overrides), stone_instead, light_instead);
}

}  // namespace culet
