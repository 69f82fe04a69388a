#include "render/scene/scene_io.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "render/scene/camera_io.h"
#include "render/scene/film_io.h"
#include "render/scene/framing.h"
#include "render/scene/light_io.h"
#include "render/scene/light_presets.h"
#include "render/scene/object_io.h"
#include "render/scene/settings_io.h"
#include "render/scene/transform.h"
#include "render/scene/turned_lights.h"
#include "render/scene/view_presets.h"
#include "stone/material/material_io.h"
#include "stone/solid/checks.h"
#include "stone/solid_input.h"
#include "stone/stone_io.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

// The view preset of the scene and the table that names it.
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

// Decides whether a mesh is convex if nobody says so. It is not if it deviates from convex by more
// than the miss of designs' meets. Meshes with non-planar facets are always drawn by their planes.
void detect_convexity(Stone& stone, std::vector<std::string>& notes) {
    const CheckLimits limits{.planarity = k_largest_miss, .must_be_convex = false};
    if (is_convex(stone.solid) || !find_faults(stone.solid, limits).empty()) return;
    const double apart = distance_from_planes_body(stone.solid);
    if (apart <= k_largest_miss * diameter(stone.solid)) return;
    stone.convex = false;
    notes.push_back(fmt::format(
        "{} is not convex{}: it is drawn as it is (convex = true draws its planes' body)",
        stone.name,
        std::isfinite(apart)
            ? fmt::format(", corners up to {:.2g} {} outside the body of its planes", apart,
                          name_of(stone.unit))
            : ""));
}

// Reads a stone file (key `file_key`) or a mesh, and the keys beside it.
Stone stone_in(const TomlTable& table, const char* file_key, std::vector<std::string>& notes) {
    Stone stone;
    if (table.has(file_key)) {
        for (const char* key : {"unit", "convex"}) {
            if (table.has(key))
                table.fail(key, fmt::format("{} belongs to the stone file that the scene names, {}",
                                            key, table.path(file_key)->filename().string()));
        }
        StoneFile file = read_stone(*table.path(file_key));
        if (!table.has("material")) require_material(file, *table.path(file_key));
        stone = std::move(file.stone);
        for (std::string& note : file.notes) notes.push_back(std::move(note));
        if (!file.states_convex) detect_convexity(stone, notes);
    } else {
        const std::string* const held = table.held_file("mesh");
        SolidFile file = held != nullptr ? solid_of_bytes(*held, *table.path("mesh"))
                                         : read_solid(*table.path("mesh"));
        stone.solid = std::move(file.solid);
        for (std::string& note : file.notes) notes.push_back(std::move(note));
        stone.name = table.path("mesh")->stem().string();
        if (const auto unit = table.text("unit")) {
            const auto known = length_unit(*unit);
            if (!known)
                table.fail("unit", fmt::format("unit is \"{}\"; expected mm, cm, m or in", *unit));
            stone.unit = *known;
        }
        stone.convex = table.boolean("convex").value_or(true);
        if (!table.has("convex")) detect_convexity(stone, notes);
    }
    apply_stone_keys(table, stone);
    return stone;
}

void place_stone(const TomlTable& table, Stone& stone) {
    const Transform transform = transform_in(table);
    if (!(transform.scale() > 0) || transform.mirrors())
        table.fail("transform",
                   "a stone may be turned, moved and scaled alike along all directions");
    if (table.has("transform")) move_stone(transform, stone);
}

Stone placed_stone(const TomlTable& table, std::vector<std::string>& notes) {
    table.refuse_unknown({"file", "mesh", "material", "unit", "optic_axis", "principal_axes",
                          "convex", "name", "transform"});
    if (table.has("file") == table.has("mesh")) {
        table.fail("",
                   "a stone names its file: file = \"stone.toml\", or mesh = \"...\" with "
                   "material = \"...\"");
    }
    Stone stone = stone_in(table, "file", notes);
    place_stone(table, stone);
    return stone;
}

void count_in(LengthUnit unit, Stone& stone) {
    if (stone.unit == unit) return;
    Transform transform;
    transform.linear = glm::dmat3(mm_per(stone.unit) / mm_per(unit));
    move_stone(transform, stone);
    stone.unit = unit;
}

bool lists_stones(const TomlTable& root) {
    return root.kind("stone") == TomlTable::Kind::list;
}

bool shines(const std::vector<SceneObject>& objects) {
    return std::any_of(objects.begin(), objects.end(), [](const SceneObject& object) {
        return std::holds_alternative<EmitterMaterial>(object.material);
    });
}

// The main stone comes first; `instead` replaces it.
void read_stones(const TomlTable& root, const Stone* instead, Scene& scene) {
    const std::vector<TomlTable> listed =
        lists_stones(root) ? root.tables("stone") : std::vector<TomlTable>();
    if (instead != nullptr) {
        scene.stone = *instead;
        if (!listed.empty()) place_stone(listed.front(), scene.stone);
    } else if (root.has("stone") || root.has("mesh") || !root.has("object")) {
        scene.stone = scene_stone_of(root, scene.notes);
    }
    for (std::size_t i = 1; i < listed.size(); ++i) {
        scene.more_stones.push_back(placed_stone(listed[i], scene.notes));
        count_in(scene.stone.unit, scene.more_stones.back());
    }
}

// Absorption scale and immersion.
void read_factors(const TomlTable& root, Scene& scene) {
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
}

// Returns the preset's name, or "". `instead`: a preset that replaces the file's lights.
std::string read_lights(const TomlTable& root, std::string_view instead, bool may_be_dark,
                        Scene& scene) {
    const auto light = root.table("light");
    if (!instead.empty()) {
        const auto lights = light_preset(instead);
        if (!lights) throw InputError(no_light_preset(instead));
        scene.lights = *lights;
        return std::string(instead);
    }
    if (!light) {
        if (!may_be_dark)
            root.fail("", "the scene is dark: add a [light] table, e.g. preset = \"jeweller\"");
        return "";
    }
    scene.lights = lights_of(*light, scene.stone.unit, scene.notes);
    if (const auto degrees = light->vector("rotate")) {
        const Vec3 middle = scene.has_stone() ? centroid(scene.stone.solid) : Vec3{0, 0, 0};
        scene.lights = turned_lights(scene.lights, rotation_of(*degrees), middle);
    }
    return light->text("preset").value_or("");
}

void aim_camera(const TomlTable& root, const std::optional<TomlTable>& camera, Facing facing,
                Scene& scene) {
    if (camera) scene.camera = read_camera(*camera);
    if (camera && names_a_view(*camera)) return;
    if (!scene.has_stone())
        root.fail("",
                  "the scene has no stone to look at: add a [camera] with position and look_at");
    frame_stone(scene.stone.solid, facing, scene.camera);
}

}  // namespace

void apply_stone_keys(const TomlTable& table, Stone& stone) {
    // Beside a stone file these keys are for this picture only: the same stone in another material.
    if (const auto name = table.text("name")) stone.name = *name;
    if (table.has("material") || table.has("mesh")) {
        stone.material = table.kind("material") == TomlTable::Kind::table
                             ? material_of(*table.table("material"))
                             : material_named_in(table, table);
    }
    if (table.has("mesh") || table.has("optic_axis") || table.has("principal_axes"))
        stone.crystal = crystal_frame_in(table, stone.material.optic);
}

Stone scene_stone_of(const TomlTable& root, std::vector<std::string>& notes) {
    if (root.has("stone") == root.has("mesh")) {
        root.fail("",
                  "a scene names its stone: stone = \"stone.toml\", or mesh = \"...\" with "
                  "material = \"...\"");
    }
    if (!lists_stones(root)) return stone_in(root, "stone", notes);
    const std::vector<TomlTable> listed = root.tables("stone");
    if (listed.empty()) root.fail("stone", "the list of stones is empty");
    return placed_stone(listed.front(), notes);
}

Scene scene_of(const TomlTable& root, const Stone* stone_instead, std::string_view light_instead) {
    root.refuse_unknown(
        with_view_keys({"stone", "mesh", "material", "unit", "optic_axis", "principal_axes",
                        "convex", "name", "camera", "light", "object", "render", "shading", "film",
                        "immersion", "absorption_scale"}));
    Scene scene;
    read_stones(root, stone_instead, scene);
    scene.objects = objects_of(root, scene.stone.unit);
    for (std::string& note : notes_on(scene.stone.material)) scene.notes.push_back(std::move(note));
    for (const Stone& stone : scene.more_stones) {
        for (std::string& note : notes_on(stone.material)) scene.notes.push_back(std::move(note));
    }
    read_factors(root, scene);
    const auto view = view_in(root);
    const auto camera = root.table("camera");
    const std::string preset =
        read_lights(root, light_instead, view || shines(scene.objects), scene);
    const LightPreset* known = find_light_preset(preset);
    if (known != nullptr) scene.light_preset = known->name;
    aim_camera(root, camera, known != nullptr ? known->facing : Facing::crown, scene);
    if (view) apply_view_preset(view->first, view->second, scene);
    if (const auto shading = root.table("shading")) scene.shading = read_shading(*shading);
    if (known != nullptr) scene.film = known->film;
    if (const auto film = root.table("film")) scene.film = read_film(*film, scene.film);
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
