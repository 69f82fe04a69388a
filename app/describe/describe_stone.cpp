#include <fmt/format.h>

#include "app/describe/describe.h"
#include "render/colour/material_colour.h"
#include "stone/material/material_io.h"
#include "stone/numbers/units.h"
#include "stone/stone_io.h"

namespace culet {

namespace {

using Json = nlohmann::ordered_json;

const char* word_for(OpticCharacter optic) {
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

void describe_material(const Material& material, Description& about) {
    // At the sodium line, where the trade states indices.
    Json object{{"id", material.id}, {"name", material.name}, {"optic", word_for(material.optic)}};
    std::string line =
        fmt::format("material {}: {}", material.name.empty() ? material.id : material.name,
                    word_for(material.optic));
    for (int ray = 0; ray < ray_count(material.optic); ++ray) {
        const double n = material.index[ray].at(k_d_line_nm);
        const double loss = material.absorption_per_mm[ray].at(k_d_line_nm);
        const std::string name = ray_name(material.optic, ray);
        object["index_589nm"][name] = n;
        object["absorption_per_mm_589nm"][name] = loss;
        line += fmt::format(", {} {:.4f} (absorption {:.4g}/mm)", name, n, loss);
    }
    if (material.density_g_cm3)
        line += fmt::format(", density {:g} g/cm3", *material.density_g_cm3);
    object["body_colour"] = Json();
    if (material.has_absorption()) {
        const StoneColour colour = body_colour(material);
        object["body_colour"] = {{"name", colour.name}, {"srgb", display_hex(colour.rgb)}};
        line += fmt::format(", body colour {} at {:g} mm", colour.name, k_usual_width_mm);
    }
    object["density"] = material.density_g_cm3 ? Json(*material.density_g_cm3) : Json();
    object["valid_nm"] = {material.valid_from_nm, material.valid_to_nm};
    object["confidence"] = material.confidence;
    object["source"] = material.source;
    about.object["material"] = std::move(object);
    about.lines.push_back(line);
}

Description describe_stone_file(const DescribeOptions& options) {
    const StoneFile file = read_stone(options.file, options.overrides);
    const Stone& stone = file.stone;
    Description about;
    about.notes = file.notes;
    about.notes.insert(about.notes.end(), file.details.begin(), file.details.end());
    Json& object = about.object;
    object["format"] = "stone";
    object["name"] = stone.name;
    object["mesh"] = file.mesh_file.string();
    object["readings"] = file.readings_file.empty() ? Json() : Json(file.readings_file.string());
    object["unit"] = name_of(stone.unit);
    object["up"] = {stone.up.x, stone.up.y, stone.up.z};
    object["up_facet"] = stone.up_facet;
    object["changed"] = stone.changed;
    about.lines.push_back(fmt::format("{}: stone \"{}\", mesh {}, unit {}", options.file.string(),
                                      stone.name, file.mesh_file.string(), name_of(stone.unit)));
    if (file.has_material) {
        describe_material(stone.material, about);
        for (std::string& note : notes_on(stone.material)) about.notes.push_back(std::move(note));
    } else {
        object["material"] = Json();
        about.lines.push_back("no material is named: a fit does without, a picture does not");
    }
    if (stone.material.optic != OpticCharacter::isotropic) {
        Json axes = Json::array();
        for (const Vec3& axis : stone.crystal.axes) axes.push_back({axis.x, axis.y, axis.z});
        object["principal_axes"] = std::move(axes);
    }
    const double mm = mm_per(stone.unit), volume_mm3 = volume(stone.solid) * mm * mm * mm;
    object["volume_mm3"] = volume_mm3;
    if (const auto density = stone.material.density_g_cm3) {
        object["carat"] = carat(volume_mm3, *density);
        about.lines.push_back(fmt::format("volume {:.5g} mm³, {:.4g} ct at {:g} g/cm3", volume_mm3,
                                          carat(volume_mm3, *density), *density));
    }
    describe_solid(stone.solid, stone.convex && !options.may_be_concave, options.facet_table,
                   about);
    return about;
}

Description describe_material_file(const DescribeOptions& options) {
    Description about;
    about.object["format"] = "material";
    about.lines.push_back(fmt::format("{}: material", options.file.string()));
    const Material material = read_material(options.file, options.overrides);
    describe_material(material, about);
    about.notes.insert(about.notes.end(), material.notes.begin(), material.notes.end());
    return about;
}

}  // namespace culet
