#include "render/scene/scene_io.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "render/scene/camera_io.h"
#include "render/scene/framing.h"
#include "render/scene/light_io.h"
#include "render/scene/light_presets.h"
#include "render/scene/view_presets.h"
#include "stone/errors.h"
#include "stone/material_io.h"
#include "stone/stone_io.h"

namespace culet {

namespace {

constexpr std::size_t k_most_wavelengths = 1000;

void read_coherence(const TomlTable& table, RenderSettings& settings) {
    switch (table.kind("coherence")) {
        case TomlTable::Kind::missing:
            break;
        case TomlTable::Kind::boolean:
            settings.coherence = *table.boolean("coherence");
            break;
        default: {
            const std::string word = *table.text("coherence");
            if (word != "auto" && word != "on" && word != "off")
                table.fail("coherence",
                           fmt::format("coherence is auto, on or off, found \"{}\"", word));
            if (word != "auto") settings.coherence = word == "on";
        }
    }
    if (const auto bandwidth = table.number("bandwidth")) {
        if (!(*bandwidth >= 0 && *bandwidth <= 1000)) {
            table.fail("bandwidth",
                       fmt::format("bandwidth is in nm, 0 to 1000, found {}", *bandwidth));
        }
        settings.bandwidth_nm = *bandwidth;
    }
}

void read_filter(const TomlTable& table, RenderSettings& settings) {
    const std::string name = table.text("filter").value_or("box");
    if (name == "box") {
        settings.filter = PixelFilter::box;
        settings.filter_radius = 0.5;
    } else if (name == "tent") {
        settings.filter = PixelFilter::tent;
        settings.filter_radius = 1;
    } else if (name == "gaussian") {
        settings.filter = PixelFilter::gaussian;
        settings.filter_radius = 1;
    } else {
        table.fail("filter",
                   fmt::format("no pixel filter \"{}\"; known: box, tent, gaussian", name));
    }
    if (const auto radius = table.number("filter_radius")) {
        if (!(*radius > 0 && *radius <= 8)) {
            table.fail("filter_radius",
                       fmt::format("filter_radius is in pixels, 0 to 8, found {}", *radius));
        }
        settings.filter_radius = *radius;
    }
}

RenderSettings read_settings(const TomlTable& table) {
    table.refuse_unknown(
        with_view_keys({"engine", "depth", "tolerance", "effects", "wavelengths", "samples",
                        "coherence", "bandwidth", "filter", "filter_radius", "refraction",
                        "crystal_beams", "cut_weight", "split_weight", "most_beams"}));
    RenderSettings settings;
    read_coherence(table, settings);
    if (const auto beams = table.text("crystal_beams")) {
        if (*beams != "auto" && *beams != "merged" && *beams != "parted") {
            table.fail(
                "crystal_beams",
                fmt::format("crystal_beams is auto, merged or parted, found \"{}\"", *beams));
        }
        if (*beams != "auto")
            settings.crystal_beams =
                *beams == "merged" ? CrystalBeams::merged : CrystalBeams::parted;
    }
    if (const auto refraction = table.text("refraction")) {
        const std::array<std::string, 3> known{"astigmatic", "perspective", "parallel"};
        const auto found = std::find(known.begin(), known.end(), *refraction);
        if (found == known.end()) {
            table.fail("refraction",
                       fmt::format("no refraction \"{}\"; known: astigmatic, perspective, parallel",
                                   *refraction));
        }
        settings.refraction = static_cast<Refraction>(found - known.begin());
    }
    read_filter(table, settings);
    if (const auto engine = table.text("engine")) {
        const std::vector<std::string> known = engine_names();
        if (std::find(known.begin(), known.end(), *engine) == known.end()) {
            const auto near = nearest_name(*engine, known);
            table.fail("engine", fmt::format("no engine \"{}\"{}; known: {}", *engine,
                                             near ? ", did you mean \"" + *near + "\"?" : "",
                                             fmt::join(known, ", ")));
        }
        settings.engine = *engine;
    }
    if (const auto depth = table.integer("depth")) {
        if (*depth < 0 || *depth > k_deepest)
            table.fail("depth",
                       fmt::format("depth is 0 (by tolerance) to {}, found {}", k_deepest, *depth));
        settings.depth = static_cast<int>(*depth);
    }
    if (const auto tolerance = table.number("tolerance")) {
        if (!(*tolerance >= 0 && *tolerance <= 1)) {
            table.fail("tolerance",
                       fmt::format("tolerance is a fraction, 0 to 1, found {}", *tolerance));
        }
        settings.tolerance = *tolerance;
    }
    if (settings.tolerance == 0 && settings.depth == 0) {
        table.fail("tolerance", "with tolerance = 0 nothing is cut: give a depth");
    }
    const auto weight_in = [&](const char* key) -> std::optional<double> {
        const auto weight = table.number(key);
        if (weight && !(*weight > 0 && *weight <= 1))
            table.fail(key, fmt::format("{} is a share of the light, above 0 to 1, found {}", key,
                                        *weight));
        return weight;
    };
    settings.cut_weight = weight_in("cut_weight");
    settings.split_weight = weight_in("split_weight");
    if (const auto beams = table.integer("most_beams")) {
        if (*beams < 1000 || *beams > (1 << 28)) {
            table.fail("most_beams",
                       fmt::format("most_beams is 1000 to {}, found {}", 1 << 28, *beams));
        }
        settings.most_beams = *beams;
    }
    if (const auto samples = table.integer("samples")) {
        if (*samples < 1 || *samples > 4096)
            table.fail("samples", fmt::format("samples a pixel are 1 to 4096, found {}", *samples));
        settings.samples = static_cast<int>(*samples);
    }
    const auto set_effects = [&](const std::vector<std::string>& names) {
        settings.effects_auto = false;
        settings.effects.fill(false);
        std::vector<std::string> known;
        for (int e = 0; e < k_effect_count; ++e)
            known.emplace_back(name_of(static_cast<Effects>(e)));
        for (const std::string& name : names) {
            const auto found = std::find(known.begin(), known.end(), name);
            if (found == known.end()) {
                const auto near = nearest_name(name, known);
                table.fail("effects", fmt::format("no effect \"{}\"{}; known: {}", name,
                                                  near ? ", did you mean \"" + *near + "\"?" : "",
                                                  fmt::join(known, ", ")));
            }
            settings.effects[static_cast<std::size_t>(found - known.begin())] = true;
        }
    };
    if (table.kind("effects") == TomlTable::Kind::text) {
        const std::string word = *table.text("effects");
        if (word == "none") {
            set_effects({});
        } else if (word == "all") {
            settings.effects_auto = false;
            // Coherence changes what "all" of the others mean: only where the scene calls for it.
            settings.effects[static_cast<std::size_t>(Effects::coherence)] = false;
        } else if (word != "auto") {
            set_effects({word});
        }
    } else if (const auto names = table.texts("effects")) {
        set_effects(*names);
    }
    if (auto wavelengths = table.numbers("wavelengths")) {
        if (wavelengths->size() > k_most_wavelengths) {
            table.fail("wavelengths", fmt::format("up to {} wavelengths are rendered, found {}",
                                                  k_most_wavelengths, wavelengths->size()));
        }
        std::sort(wavelengths->begin(), wavelengths->end());
        for (std::size_t i = 0; i < wavelengths->size(); ++i) {
            const double nm = (*wavelengths)[i];
            if (!(nm >= 200 && nm <= 2500)) {
                table.fail("wavelengths",
                           fmt::format("wavelengths are in nm, 200 to 2500, found {}", nm));
            }
            if (i > 0 && nm == (*wavelengths)[i - 1]) {
                table.fail("wavelengths", fmt::format("wavelength {} nm is given twice", nm));
            }
        }
        settings.wavelengths_nm = *wavelengths;
    }
    return settings;
}

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
    root.refuse_unknown(
        with_view_keys({"stone", "mesh", "material", "unit", "optic_axis", "principal_axes",
                        "convex", "name", "camera", "light", "object", "render", "immersion"}));
    Scene scene;
    if (root.has("object")) root.fail("object", "objects around the stone are not rendered yet");
    if (stone_instead != nullptr) {
        scene.stone = *stone_instead;
    } else {
        scene.stone = scene_stone_of(root, scene.notes);
    }
    if (std::string missing = missing_colour(scene.stone.material); !missing.empty())
        scene.notes.push_back(std::move(missing));
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
