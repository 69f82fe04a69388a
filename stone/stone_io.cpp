#include "stone/stone_io.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "stone/design/design.h"
#include "stone/material/material_io.h"
#include "stone/solid/perpendicular.h"
#include "stone/text/errors.h"
#include "stone/text/name_suggestions.h"
#include "stone/upright.h"

namespace culet {

namespace {

constexpr const char* k_no_material =
    "has no material: name one of the catalogue (material = \"diamond\") or add a [material] table";

// For `up = "table"` in a mesh without facet names: the table by its shape, else the largest facet
// that faces up more than sideways, else -1.
int table_of(const Solid& solid) {
    if (const auto table = table_by_shape(solid)) return *table;
    int best = -1;
    double best_area = 0;
    for (std::size_t i = 0; i < solid.facets.size(); ++i) {
        if (solid.facets[i].plane.normal.z < std::sqrt(0.5)) continue;
        const double size = area(solid, solid.facets[i]);
        if (size > best_area) {
            best_area = size;
            best = static_cast<int>(i);
        }
    }
    return best;
}

Vec3 unit_vector(const TomlTable& table, const char* key, const Vec3& value) {
    const double length = glm::length(value);
    if (!(length > 0) || !std::isfinite(length)) {
        table.fail(key, fmt::format("{} must not be the zero vector", key));
    }
    return value / length;
}

// Turns the stone, and what the file states in the mesh's frame, so that `up` faces +z. A facet
// named by `up` may be tilted as tables are.
void turn_as_stated(bool crystal_is_given, StoneFile& file) {
    Stone& stone = file.stone;
    const Vec3 up = stone.up_facet.empty() ? stone.up : axis_near(stone.up);
    if (up != Vec3{0, 0, 1}) {
        file.notes.push_back(fmt::format(
            "up of the stone file is {} of the mesh: the stone was turned so that it faces +z",
            words_for_direction(up)));
        stone.file_up = up;
        stone.solid = turned(std::move(stone.solid), turn_upright(up));
        stone.up = stone.up_facet.empty() ? Vec3{0, 0, 1} : turn_upright(up) * stone.up;
    }
    if (!crystal_is_given) return;
    for (Vec3& axis : stone.crystal.axes) axis = turn_upright(stone.file_up) * axis;
}

// Facets are found by their names.
void take_design(const TomlTable& table, Solid& solid) {
    const auto file = table.path("design");
    if (!file) return;
    solid.design = read_solid(*file).solid.design;
    if (!solid.design)
        table.fail("design", fmt::format("{} holds no design: name a GemCad .asc or .gem, or a "
                                         "mesh of culet cut",
                                         file->filename().string()));
    const std::vector<DesignPlace> places = places_of(solid);
    if (std::none_of(places.begin(), places.end(), [](const auto& at) { return at.tier >= 0; }))
        table.fail("design", fmt::format("no facet of the mesh has a name of the design {}: give "
                                         "the facets the design's names (culet info -v lists them)",
                                         file->filename().string()));
}

void take_material(const TomlTable& table, const TomlTable& root, StoneFile& result) {
    Stone& stone = result.stone;
    result.has_material = table.has("material") || root.has("material");
    if (result.has_material) stone.material = material_named_in(table, root);
    if (const auto own = table.number("density")) {
        if (!(*own > 0.1 && *own < 30))
            table.fail("density",
                       fmt::format("density is {}; expected g/cm3 between 0.1 and 30", *own));
        stone.material.density_g_cm3 = own;
    }
    if (result.has_material) stone.crystal = crystal_frame_in(table, stone.material.optic);
}

void take_mesh(const TomlTable& table, StoneFile& result) {
    Stone& stone = result.stone;
    const auto mesh = table.path("mesh");
    if (!mesh) table.fail("", "[stone] has no mesh: name the hand-made mesh, mesh = \"hand.obj\"");
    result.mesh_file = *mesh;
    SolidFile file = read_solid(result.mesh_file,
                                table.has("up") ? Orientation::as_given : Orientation::upright);
    stone.solid = std::move(file.solid);
    stone.file_up = file.file_up;
    result.notes = std::move(file.notes);
    if (std::string odd = doubtful_size(stone.solid); !odd.empty() && !table.has("unit"))
        result.notes.push_back("the mesh " + odd);
    stone.facets_are_whole = file.facets_are_whole;
    stone.changed = std::move(file.changed);
    result.details = std::move(file.details);
}

// A direction, or the facet of that name.
void take_up(const TomlTable& table, const std::string& mesh, Stone& stone) {
    switch (table.kind("up")) {
        case TomlTable::Kind::missing:
            break;
        case TomlTable::Kind::text: {
            const std::string name = *table.text("up");
            int facet = find_facet(stone.solid, name);
            if (facet < 0 && name == "table") facet = table_of(stone.solid);
            if (facet < 0) {
                std::vector<std::string> names;
                for (const Facet& f : stone.solid.facets) names.push_back(f.name);
                const auto near = nearest_name(name, names);
                table.fail(
                    "up",
                    fmt::format(
                        "the mesh {} has no facet \"{}\"{}; culet info -v lists its facets", mesh,
                        name,
                        near ? fmt::format(" (did you mean \"{}\"?)", *near) : std::string()));
            }
            stone.up_facet = stone.solid.facets[facet].name;
            stone.up = stone.solid.facets[facet].plane.normal;
            break;
        }
        default:
            stone.up = unit_vector(table, "up", *table.vector("up"));
    }
}

}  // namespace

CrystalFrame crystal_frame_in(const TomlTable& table, OpticCharacter optic) {
    CrystalFrame frame;
    const auto axis = table.vector("optic_axis");
    const auto axes = table.vectors("principal_axes");
    if (axis && axes)
        table.fail("optic_axis",
                   "give optic_axis (uniaxial) or principal_axes (biaxial), not both");
    if (axis) {
        if (optic == OpticCharacter::biaxial) {
            table.fail("optic_axis",
                       "the material is biaxial: give principal_axes for alpha, beta, gamma");
        }
        const Vec3 a = unit_vector(table, "optic_axis", *axis);
        const Vec3 b = perpendicular_to(a);
        frame.axes = {a, b, glm::cross(a, b)};
    }
    if (axes) {
        if (axes->size() != 3) {
            table.fail(
                "principal_axes",
                fmt::format("needs three vectors, for alpha, beta, gamma; found {}", axes->size()));
        }
        std::array<Vec3, 3> given;
        for (int i = 0; i < 3; ++i) given[i] = unit_vector(table, "principal_axes", (*axes)[i]);
        // Axes typed with a few digits are made orthonormal; axes that are far from it are refused.
        for (int i = 0; i < 3; ++i) {
            const double cosine = glm::dot(given[i], given[(i + 1) % 3]);
            if (std::abs(cosine) > std::sin(radians(1.0))) {
                table.fail("principal_axes",
                           fmt::format("axes {} and {} are {:.2f} degrees apart; principal axes "
                                       "are at right angles",
                                       i + 1, (i + 1) % 3 + 1, degrees(std::acos(cosine))));
            }
        }
        const Vec3 a = given[0];
        const Vec3 b = glm::normalize(given[1] - glm::dot(given[1], a) * a);
        Vec3 c = glm::cross(a, b);
        if (glm::dot(c, given[2]) < 0) c = -c;
        frame.axes = {a, b, c};
    }
    return frame;
}

Material material_named_in(const TomlTable& table, const TomlTable& root) {
    if (const auto name = table.text("material")) {
        if (std::filesystem::path(*name).extension() == ".toml")
            return read_material(*table.path("material"));
        try {
            return catalogue_material(*name);
        } catch (const InputError& error) {
            table.fail("material", error.what());
        }
    }
    if (const auto own = root.table("material")) return material_of(*own);
    table.fail("", k_no_material);
}

StoneFile stone_of(const TomlTable& root) {
    root.refuse_unknown({"stone", "material", "reading", "silhouette", "line", "fit"});
    const auto table = root.table("stone");
    if (!table) root.fail("", "there is no [stone] table");
    table->refuse_unknown({"name", "mesh", "unit", "material", "density", "optic_axis",
                           "principal_axes", "up", "azimuth_zero", "readings", "convex", "design"});
    StoneFile result;
    Stone& stone = result.stone;
    stone.name = table->text("name").value_or(root.file().stem().string());

    const std::string unit = table->text("unit").value_or("mm");
    if (const auto known = length_unit(unit)) {
        stone.unit = *known;
    } else {
        table->fail("unit", fmt::format("unit is \"{}\"; expected mm, cm, m or in", unit));
    }

    take_material(*table, root, result);
    result.states_convex = table->has("convex");
    stone.convex = table->boolean("convex").value_or(true);

    const std::string zero = table->text("azimuth_zero").value_or("free");
    if (zero != "free" && zero != "mesh") {
        table->fail("azimuth_zero",
                    fmt::format("azimuth_zero is \"{}\"; expected free or mesh", zero));
    }
    stone.azimuth_from_mesh = zero == "mesh";

    take_mesh(*table, result);
    take_up(*table, result.mesh_file.filename().string(), stone);
    turn_as_stated(table->has("optic_axis") || table->has("principal_axes"), result);

    take_design(*table, stone.solid);
    if (const auto readings = table->path("readings")) result.readings_file = *readings;
    return result;
}

void require_material(const StoneFile& stone, const std::filesystem::path& file) {
    if (!stone.has_material) throw InputError(file, std::string("[stone] ") + k_no_material);
}

StoneFile read_stone(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
    return stone_of(read_toml(file, overrides));
}

}  // namespace culet
