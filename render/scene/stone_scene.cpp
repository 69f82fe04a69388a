#include "render/scene/stone_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "render/scene/scene_io.h"
#include "render/scene/view_presets.h"
#include "stone/design/design.h"
#include "stone/material/material.h"
#include "stone/material/material_io.h"
#include "stone/solid_input.h"
#include "stone/text/errors.h"
#include "stone/text/output_file.h"
#include "stone/text/text_scan.h"
#include "stone/text/toml_file.h"

namespace culet {

namespace {

// Designs are 1 or 2 wide (a radius of 1); cut stones are hardly ever under 2 mm.
constexpr double k_widest_of_no_size = 2 + 1e-6;
constexpr std::size_t k_suggestions = 3;

enum class InputKind { scene, stone, mesh, cut };

InputKind input_kind_of(const std::filesystem::path& file) {
    const std::string extension = extension_of(file);
    if (extension == "asc" || extension == "gem") return InputKind::cut;
    if (is_solid_file(file)) return InputKind::mesh;
    if (extension != "toml") {
        throw InputError(
            file,
            "is not a scene, stone (.toml), mesh (.obj .off .ply .stl .glb .step) or cut "
            "design (.asc .gem .gcs)");
    }
    const TomlTable root = read_toml(file);
    if (root.kind("stone") == TomlTable::Kind::table) return InputKind::stone;
    if (root.has("fit") && !root.has("stone") && !root.has("mesh")) {
        throw InputError(file, fmt::format("is a job: culet run {} -o DIR draws its picture",
                                           file.filename().string()));
    }
    return InputKind::scene;
}

// Catalogue materials whose index is near the design's.
std::string materials_of_index(double index) {
    std::vector<std::pair<double, std::string>> near;
    for (const std::string& name : catalogue_names())
        near.emplace_back(std::abs(catalogue_material(name).index[0].at(k_d_line_nm) - index),
                          name);
    std::sort(near.begin(), near.end());
    std::string names;
    for (std::size_t i = 0; i < std::min(k_suggestions, near.size()); ++i)
        names += (i == 0 ? "" : ", ") + near[i].second;
    return names;
}

[[noreturn]] void ask_for_material(const std::filesystem::path& file, InputKind kind) {
    require_file(file);
    std::string hint = "e.g. --material diamond";
    if (kind == InputKind::cut) {
        const auto index = read_solid(file).solid.design->refractive_index;
        if (index && *index > 1) {
            hint =
                fmt::format("its index {:.4g} is that of {}", *index, materials_of_index(*index));
        }
    }
    throw InputError(file, fmt::format("names no material: say which with --material NAME ({}; "
                                       "culet info --materials lists them)",
                                       hint));
}

double width_mm(const Stone& stone) {
    return mm_per(stone.unit) * outline_width(stone.solid);
}

void scale(Solid& solid, double factor) {
    for (Vec3& v : solid.vertices) v *= factor;
    for (Facet& facet : solid.facets) facet.plane.offset *= factor;
}

void set_size(const std::filesystem::path& file, InputKind kind,
              const std::optional<double>& wanted, Stone& stone, std::vector<std::string>& notes) {
    const double width = width_mm(stone);
    if (!(width > 0) || !std::isfinite(width)) return;
    const std::string name = file.filename().string();
    const bool is_sized =
        kind == InputKind::stone || (kind == InputKind::mesh && has_size(stone.solid));
    if (wanted) {
        withdraw_size_doubt(stone.solid, notes);
        scale(stone.solid, *wanted / width);
    } else if (!is_sized) {
        scale(stone.solid, k_usual_width_mm / width);
        notes.push_back(fmt::format("{} has no size: drawn {:g} mm wide (--width MM for another)",
                                    name, k_usual_width_mm));
    } else if (kind == InputKind::mesh) {
        notes.push_back(fmt::format("{} is taken in {}: {:.4g} mm wide (--width MM for another)",
                                    name, name_of(stone.unit), width));
    }
}

std::vector<std::string> keys_of(std::vector<std::string> overrides, const StoneScene& choices) {
    if (choices.width_mm && !(*choices.width_mm > 0 && std::isfinite(*choices.width_mm)))
        throw InputError(fmt::format("--width is in mm, found {:g}", *choices.width_mm));
    if (is_view_preset(choices.light)) overrides.push_back("preset=\"" + choices.light + "\"");
    return overrides;
}

std::string light_of(const StoneScene& choices) {
    return is_view_preset(choices.light) ? std::string() : choices.light;
}

Scene alone(const TomlTable& root, const Stone& stone, const StoneScene& choices,
            const std::vector<std::string>& notes) {
    std::string light = light_of(choices);
    // A view (preset = "polariscope") brings its own.
    if (choices.light.empty() && !root.has("light") && !root.has("preset")) light = k_usual_light;
    Scene scene = scene_of(root, &stone, light);
    scene.notes.insert(scene.notes.begin(), notes.begin(), notes.end());
    return scene;
}

}  // namespace

double outline_width(const Solid& solid) {
    return std::min(width_along(solid, {1, 0, 0}), width_along(solid, {0, 1, 0}));
}

bool has_size(const Solid& solid) {
    return outline_width(solid) > k_widest_of_no_size;
}

Scene read_any_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                     const StoneScene& choices) {
    const InputKind kind = input_kind_of(file);
    const std::vector<std::string> keys = keys_of(overrides, choices);
    // Relative to the working directory, like other files of the command line.
    std::string material = choices.material;
    if (std::filesystem::path(material).extension() == ".toml")
        material = std::filesystem::absolute(material).string();
    if (kind == InputKind::scene) {
        if (choices.width_mm)
            throw InputError(file, "is a scene, which gives the stone's size: leave out --width");
        TomlTable root = material.empty() ? read_toml(file, keys)
                                          : read_toml_with(file, {{"material", material}}, keys);
        return scene_of(root, nullptr, light_of(choices));
    }
    std::vector<std::pair<std::string, std::string>> texts{
        {kind == InputKind::stone ? "stone" : "mesh", file.filename().string()}};
    if (!material.empty()) texts.emplace_back("material", material);
    const TomlTable root = toml_beside(file, texts, keys, choices.held);
    if (kind != InputKind::stone && !root.has("material")) ask_for_material(file, kind);
    if (kind == InputKind::stone && !root.has("material")) {
        const TomlTable own = read_toml(file);
        if (!own.has("material") && !own.table("stone")->has("material"))
            ask_for_material(file, kind);
    }
    std::vector<std::string> notes;
    Stone stone = scene_stone_of(root, notes);
    set_size(file, kind, choices.width_mm, stone, notes);
    return alone(root, stone, choices, notes);
}

Scene scene_around(const Stone& stone, const std::vector<std::string>& overrides,
                   const StoneScene& choices) {
    const std::filesystem::path name = stone.name.empty() ? "the stone" : stone.name;
    const TomlTable root = toml_beside(name, {}, keys_of(overrides, choices));
    Stone shown = stone;
    if (!choices.material.empty()) shown.material = material_called(choices.material);
    apply_stone_keys(root, shown);
    std::vector<std::string> notes;
    set_size(name, has_size(stone.solid) ? InputKind::stone : InputKind::mesh, choices.width_mm,
             shown, notes);
    return alone(root, shown, choices, notes);
}

}  // namespace culet
