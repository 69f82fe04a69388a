#include "viewer/engine/engine_lists.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "render/colour/material_colour.h"
#include "render/scene/light_presets.h"
#include "stone/cuts/cuts.h"
#include "stone/numbers/units.h"
#include "viewer/engine/stone_json.h"

namespace culet {

namespace {

using Json = nlohmann::ordered_json;

const char* name_of(OpticCharacter optic) {
    switch (optic) {
        case OpticCharacter::isotropic:
            return "isotropic";
        case OpticCharacter::uniaxial:
            return "uniaxial";
        case OpticCharacter::biaxial:
            return "biaxial";
    }
    return "";
}

}  // namespace

Json material_list() {
    Json list = Json::array();
    for (const std::string& id : catalogue_names()) {
        const Material material = catalogue_material(id);
        Json index = Json::array();
        for (int ray = 0; ray < ray_count(material.optic); ++ray)
            index.push_back(material.index[static_cast<std::size_t>(ray)].at(k_d_line_nm));
        Json entry{{"name", id},
                   {"title", material.name},
                   {"optic", name_of(material.optic)},
                   {"index", index},
                   {"summary", material.usual_colour}};
        if (material.density_g_cm3) entry["density_g_cm3"] = *material.density_g_cm3;
        if (material.has_absorption()) {
            const StoneColour colour = body_colour(material);
            entry["summary"] = colour.name;
            entry["colour"] = display_hex(colour.rgb);
        }
        list.push_back(std::move(entry));
    }
    return list;
}

Json light_list() {
    Json list = Json::array();
    for (const LightPreset& preset : light_presets()) {
        list.push_back({{"name", preset.name},
                        {"summary", preset.summary},
                        {"from_below", preset.facing == Facing::pavilion},
                        {"instrument", preset.instrument}});
    }
    return list;
}

Json cut_list() {
    Json list = Json::array();
    for (const CutKind& kind : cut_kinds()) {
        Json parameters = Json::array();
        for (const CutParameter& parameter : kind.parameters) {
            parameters.push_back({{"name", parameter.name},
                                  {"value", parameter.value},
                                  {"least", parameter.least},
                                  {"most", parameter.most},
                                  {"unit", parameter.unit},
                                  {"what", parameter.what}});
        }
        list.push_back({{"name", kind.name},
                        {"summary", kind.summary},
                        {"convex", kind.convex},
                        {"parameters", parameters}});
    }
    return list;
}

std::string cut_list_json() {
    return cut_list().dump();
}

Json summary_of(const ViewedStone& viewed) {
    const Solid& solid = viewed.stone.solid;
    Json facets = Json::array();
    for (const Facet& facet : solid.facets) facets.push_back(facet.name);
    const Vec3 middle = solid.vertices.empty() ? Vec3(0) : centroid(solid);
    double radius = 0;
    for (const Vec3& vertex : solid.vertices)
        radius = std::max(radius, glm::distance(vertex, middle));
    Json json{{"role", viewed.role},
              {"name", viewed.stone.name},
              {"facets", facets},
              {"center", json_of(middle)},
              {"radius", radius},
              {"dimensions",
               {{"length", width_along(solid, {1, 0, 0})},
                {"width", width_along(solid, {0, 1, 0})},
                {"depth", width_along(solid, {0, 0, 1})},
                {"unit", name_of(viewed.stone.unit)}}},
              {"material", viewed.stone.material.id},
              {"material_title", viewed.stone.material.name},
              {"optic", name_of(viewed.stone.material.optic)},
              {"crystal",
               {json_of(viewed.stone.crystal.axes[0]), json_of(viewed.stone.crystal.axes[1]),
                json_of(viewed.stone.crystal.axes[2])}}};
    if (viewed.cut) json["cut"] = {{"kind", viewed.cut->kind}, {"values", viewed.cut->values}};
    return json;
}

Json json_of(const Camera& camera) {
    Json json{{"position", json_of(camera.position)},
              {"look_at", json_of(camera.look_at)},
              {"up", json_of(camera.up)},
              {"size", {camera.width, camera.height}}};
    if (camera.orthographic_width) {
        json["width"] = *camera.orthographic_width;
    } else {
        json["fov_deg"] = degrees(camera.fov);
    }
    if (camera.optics.analyzer) json["analyzer_deg"] = degrees(*camera.optics.analyzer);
    return json;
}

Json settings_of(const Scene& scene) {
    const RenderSettings& settings = scene.settings;
    Json effects = Json::object();
    for (int i = 0; i < k_effect_count; ++i)
        effects[name_of(static_cast<Effects>(i))] = settings.effects[static_cast<std::size_t>(i)];
    const LightPreset* const preset = find_light_preset(scene.light_preset);
    const bool to_the_stone = preset != nullptr && !preset->instrument;
    return {{"engine", settings.engine},
            {"depth", settings.depth},
            {"tolerance", settings.tolerance},
            {"samples", settings.samples},
            {"wavelengths", settings.wavelengths_nm},
            {"effects_auto", settings.effects_auto},
            {"effects", effects},
            {"immersion", scene.immersion},
            {"light_preset", scene.light_preset},
            {"exposure", to_the_stone ? Json("auto") : Json(1)},
            {"tonemap", name_of(scene.film.tone_map)}};
}

}  // namespace culet
