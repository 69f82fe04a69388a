#include "viewer/engine/view_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <map>
#include <utility>

#include "page/html.h"
#include "render/scene/scene_io.h"
#include "render/scene/view_presets.h"
#include "stone/cuts/cuts.h"
#include "stone/design/design.h"
#include "stone/text/output_file.h"
#include "viewer/engine/panorama.h"
#include "viewer/engine/shown_stone.h"

namespace culet {

namespace {

constexpr const char* k_map_name = "environment.pfm";

bool is_scene_file(const ViewSource& source) {
    return !source.cut && source.file.extension() == ".toml" &&
           read_toml(source.file).kind("stone") != TomlTable::Kind::table;
}

// A scene file without its stone; for a stone alone, the scene in which `read_any_scene` shows it.
std::string scene_text(const ViewSource& source, const Scene& scene) {
    std::vector<std::string> keys = source.overrides;
    const bool of_scene = is_scene_file(source);
    const std::string& light = source.choices.light;
    if (is_view_preset(light)) {
        keys.push_back("preset=\"" + light + "\"");
    } else if (!light.empty()) {
        keys.push_back(fmt::format("light={{preset=\"{}\"}}", light));
    } else if (!of_scene && !scene.light_preset.empty() &&
               std::none_of(keys.begin(), keys.end(),
                            [](const std::string& key) { return key.starts_with("light"); })) {
        keys.push_back(fmt::format("light={{preset=\"{}\"}}", scene.light_preset));
    }
    if (scene.lights.environment)
        keys.push_back(fmt::format("light.environment=\"{}\"", k_map_name));
    // The page's view starts there: another light of the page must not frame the stone anew.
    const Camera& camera = scene.camera;
    const auto place = [&keys](const char* key, const Vec3& v) {
        keys.push_back(fmt::format("camera.{}=[{},{},{}]", key, v.x, v.y, v.z));
    };
    place("position", camera.position);
    place("look_at", camera.look_at);
    place("up", camera.up);
    keys.push_back(camera.orthographic_width
                       ? fmt::format("camera.orthographic_width={}", *camera.orthographic_width)
                       : fmt::format("camera.fov={}", degrees(camera.fov)));
    return rewritten_text(of_scene ? read_text(source.file) : std::string(), source.file, keys,
                          {"stone", "mesh", "material", "unit", "convex", "name", "object"});
}

Scene scene_of(const ViewSource& source) {
    if (source.cut) {
        Stone stone;
        stone.name = source.cut->kind;
        stone.solid = make_cut(source.cut->kind, source.cut->values);
        stone.convex = cut_kind(source.cut->kind).convex;
        return scene_around(stone, source.overrides, source.choices);
    }
    if (source.stone != nullptr && is_scene_file(source))
        return read_scene(source.file, source.overrides, source.stone);
    Scene scene = read_any_scene(source.file, source.overrides, source.choices);
    if (source.stone != nullptr) scene.stone = *source.stone;
    return scene;
}

// Direction from the middle to a notch, seen from above: the mean of the edges at which the stone
// bends inwards. Nothing if there is none on one side.
std::optional<Vec3> notch_of(const Solid& solid) {
    constexpr double k_least = 1e-6, k_least_apart = 1e-3;  // of the stone's size
    const double size = diameter(solid);
    const Vec3 middle = centroid(solid);
    std::map<std::pair<int, int>, std::size_t> owners;
    Vec3 sum{0, 0, 0};
    for (std::size_t f = 0; f < solid.facets.size(); ++f) {
        const std::vector<int>& corners = solid.facets[f].corners;
        for (std::size_t i = 0; i < corners.size(); ++i)
            owners[{corners[i], corners[(i + 1) % corners.size()]}] = f;
    }
    for (const auto& [ends, f] : owners) {
        const auto other = owners.find({ends.second, ends.first});
        if (other == owners.end()) continue;
        const Facet& across = solid.facets[other->second];
        const Plane& plane = solid.facets[f].plane;
        const bool inwards =
            std::any_of(across.corners.begin(), across.corners.end(), [&](int corner) {
                const Vec3& at = solid.vertices[static_cast<std::size_t>(corner)];
                return glm::dot(plane.normal, at) - plane.offset > k_least * size;
            });
        if (!inwards) continue;
        const Vec3 &a = solid.vertices[static_cast<std::size_t>(ends.first)],
                   &b = solid.vertices[static_cast<std::size_t>(ends.second)];
        sum += glm::length(b - a) * (0.5 * (a + b) - middle);
    }
    sum.z = 0;
    if (!(glm::length(sum) > k_least_apart * size * size)) return std::nullopt;
    return glm::normalize(sum);
}

// A heart stands on its tip, with the notch up, unless a scene file decides.
ViewSource upright(const ViewSource& source, const Scene& scene) {
    ViewSource turned = source;
    if (scene.stone.convex || is_scene_file(source)) return turned;
    for (const std::string& key : source.overrides) {
        if (key.starts_with("camera")) return turned;
    }
    if (const std::optional<Vec3> notch = notch_of(scene.stone.solid))
        turned.overrides.push_back(fmt::format("camera.up=[{:.6g},{:.6g},0]", notch->x, notch->y));
    return turned;
}

// It gets the material of the shown stone.
std::optional<Stone> catalogue_of(const ViewSource& source, const Stone& looked_at) {
    Stone catalogue = looked_at;
    if (source.catalogue != nullptr) {
        catalogue.solid = *source.catalogue;
    } else if (!source.before.empty()) {
        StoneScene choices;
        choices.material = "diamond";  // not used
        const Stone before = read_any_scene(source.before, {}, choices).stone;
        catalogue.solid = before.solid;
        catalogue.name = before.name;
        catalogue.unit = before.unit;
        catalogue.convex = before.convex;
    } else {
        return std::nullopt;
    }
    return catalogue;
}

// Pages draw by beams, which know no ground facets.
void polish(Solid& solid, std::vector<std::string>& notes) {
    const std::string frosted = frosted_tiers(solid);
    if (frosted.empty()) return;
    notes.push_back(fmt::format("frosted tiers are shown polished: {}", frosted));
    Design design = *solid.design;
    for (DesignTier& tier : design.tiers) tier.frosting = 0;
    solid.design = std::make_shared<const Design>(std::move(design));
}

}  // namespace

std::string render_command(const ViewSource& source) {
    const std::string file = source.file.string();
    std::string command = "culet render " + shell_word((file.starts_with('-') ? "./" : "") + file);
    const StoneScene& choices = source.choices;
    if (!choices.material.empty()) command += " --material " + shell_word(choices.material);
    if (!choices.light.empty()) command += " --light " + shell_word(choices.light);
    if (choices.width_mm) command += fmt::format(" --width {}", *choices.width_mm);
    for (const std::string& key : source.overrides) command += " --set " + shell_word(key);
    return command;
}

ViewItem item_of(const ViewSource& as_given, std::vector<std::string>& notes, Scene& scene) {
    scene = scene_of(as_given);
    const ViewSource source = upright(as_given, scene);
    if (source.overrides != as_given.overrides) scene = scene_of(source);
    notes.insert(notes.end(), scene.notes.begin(), scene.notes.end());
    polish(scene.stone.solid, notes);
    ViewItem item;
    item.name = !scene.stone.name.empty() ? scene.stone.name : source.file.stem().string();
    item.refused =
        scene.has_stone() ? refused_by_page(scene) : "beams draw a stone, and this scene has none";
    if (scene.has_stone()) {
        if (std::optional<Stone> before = catalogue_of(source, scene.stone)) {
            std::vector<std::string> said;
            polish(before->solid, said);
            ViewedStone catalogue;
            catalogue.role = "catalogue";
            catalogue.stone = std::move(*before);
            item.stones.push_back(std::move(catalogue));
        }
        ViewedStone viewed;
        viewed.role = source.cut                                            ? "design"
                      : !source.fit_json.empty() || item.stones.size() == 1 ? "fitted"
                                                                            : "stone";
        viewed.stone = scene.stone;
        viewed.cut = source.cut;
        item.stones.push_back(std::move(viewed));
        item.scene = scene_text(source, scene);
    }
    if (scene.lights.environment) {
        const EnvironmentMap& map = *scene.lights.environment;
        item.files[k_map_name] = pfm_of(map.width, map.height, map.rgb);
    }
    item.command = source.cut || source.stone != nullptr ? std::string() : render_command(source);
    return item;
}

}  // namespace culet
