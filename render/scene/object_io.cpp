#include "render/scene/object_io.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "render/scene/table_values.h"
#include "render/scene/transform.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

constexpr double k_usual_crease_deg = 30;

Vec3 center_in(const TomlTable& table) {
    return table.vector("center").value_or(Vec3(0));
}

Vec3 normal_in(const TomlTable& table) {
    return table.has("normal") ? direction_in(table, "normal") : Vec3{0, 0, 1};
}

Shape shape_of(const TomlTable& table, const SphereShape*, LengthUnit) {
    return SphereShape{center_in(table), positive_in(table, "radius")};
}

Shape shape_of(const TomlTable& table, const PlaneShape*, LengthUnit) {
    if (table.has("center") && table.has("point"))
        table.fail("point", "a plane is given by one point of it: center or point");
    return PlaneShape{table.has("point") ? point_in(table, "point") : center_in(table),
                      normal_in(table)};
}

Shape shape_of(const TomlTable& table, const DiscShape*, LengthUnit) {
    return DiscShape{center_in(table), normal_in(table), positive_in(table, "radius")};
}

Shape shape_of(const TomlTable& table, const BoxShape*, LengthUnit) {
    Vec3 size;
    if (table.kind("size") == TomlTable::Kind::number) {
        size = Vec3(*table.number("size"));
    } else {
        size = point_in(table, "size");
    }
    if (!(size.x > 0 && size.y > 0 && size.z > 0))
        table.fail("size", "size is the three lengths of a box's edges, or one; all over 0");
    BoxShape box;
    box.center = center_in(table);
    box.half = 0.5 * size;
    return box;
}

// Factor from the file's lengths to the stone's.
double factor_of(const TomlTable& table, const std::filesystem::path& file, LengthUnit unit) {
    if (const auto name = table.text("unit")) {
        const auto known = length_unit(*name);
        if (!known)
            table.fail("unit", fmt::format("unit is \"{}\"; expected mm, cm, m or in", *name));
        return mm_per(*known) / mm_per(unit);
    }
    return is_gltf(file) ? mm_per(LengthUnit::m) / mm_per(unit) : 1;
}

Shape shape_of(const TomlTable& table, const MeshShape*, LengthUnit unit) {
    const auto file = table.path("file");
    if (!file) table.fail("", "file is missing: the mesh (.obj, .off, .ply, .stl, .gltf, .glb)");
    auto mesh = std::make_shared<TriangleMesh>(read_triangle_mesh(*file));
    const double factor = factor_of(table, *file, unit);
    for (Vec3& vertex : mesh->vertices) vertex *= factor;
    if (table.kind("smooth") == TomlTable::Kind::boolean) {
        if (*table.boolean("smooth")) smooth_normals(*mesh, radians(k_usual_crease_deg));
    } else if (const auto crease = table.number("smooth")) {
        if (!(*crease > 0 && *crease <= 180))
            table.fail("smooth",
                       fmt::format("smooth is true, false, or the largest angle between triangles "
                                   "that are one surface, up to 180 degrees; found {}",
                                   *crease));
        smooth_normals(*mesh, radians(*crease));
    }
    return MeshShape{mesh};
}

std::vector<std::string_view> keys_of(const SphereShape*) {
    return {"center", "radius"};
}
std::vector<std::string_view> keys_of(const PlaneShape*) {
    return {"center", "point", "normal"};
}
std::vector<std::string_view> keys_of(const DiscShape*) {
    return {"center", "normal", "radius"};
}
std::vector<std::string_view> keys_of(const BoxShape*) {
    return {"center", "size"};
}
std::vector<std::string_view> keys_of(const MeshShape*) {
    return {"file", "unit", "smooth"};
}

// Calls visit(null pointer of the type) for every shape type.
template <class Visit, class... S>
void each_type(const std::variant<S...>*, Visit&& visit) {
    (visit(static_cast<const S*>(nullptr)), ...);
}

Shape shape_in(const TomlTable& table, LengthUnit unit) {
    const auto name = table.text("shape");
    std::optional<Shape> shape;
    std::string known;
    each_type(static_cast<const Shape*>(nullptr), [&](const auto* type) {
        const char* type_name = std::remove_pointer_t<decltype(type)>::k_name;
        known += (known.empty() ? "" : ", ") + std::string(type_name);
        if (name != type_name) return;
        std::vector<std::string_view> keys = keys_of(type);
        keys.insert(keys.end(), {"shape", "transform", "material", "name"});
        table.refuse_unknown(keys);
        shape = shape_of(table, type, unit);
    });
    if (!name) table.fail("", fmt::format("shape is missing: one of {}", known));
    if (!shape) table.fail("shape", fmt::format("no shape \"{}\"; known: {}", *name, known));
    if (!move_shape(transform_in(table), *shape)) {
        table.fail("transform",
                   fmt::format("a {} may be turned, moved and scaled alike along all directions; "
                               "say shape = \"mesh\" for others",
                               *name));
    }
    return *shape;
}

// Reads index and extinction, or the reflectance at normal incidence.
MetalMaterial metal_in(const TomlTable& table) {
    table.refuse_unknown({"kind", "f0", "index", "absorption", "roughness"});
    MetalMaterial metal;
    if (table.has("f0")) {
        if (table.has("index") || table.has("absorption"))
            table.fail("f0", "a metal has f0, or index and absorption, not both");
        metal.f0 = share_in(table, "f0", 1);
    } else {
        if (!table.has("index") || !table.has("absorption")) {
            table.fail("",
                       "a metal needs f0, its reflectance at normal incidence, or index (n) "
                       "and absorption (k)");
        }
        metal.n = colour_in(table, "index");
        metal.k = colour_in(table, "absorption");
    }
    metal.roughness = table.number("roughness").value_or(0);
    if (!(metal.roughness >= 0 && metal.roughness <= 1))
        table.fail("roughness", fmt::format("roughness is 0 to 1, found {}", metal.roughness));
    return metal;
}

DielectricMaterial dielectric_in(const TomlTable& table) {
    table.refuse_unknown({"kind", "index", "absorption"});
    DielectricMaterial glass;
    glass.index = table.number("index").value_or(glass.index);
    if (!(glass.index >= 1 && glass.index <= 10))
        table.fail("index",
                   fmt::format("index is a refractive index, 1 to 10, found {}", glass.index));
    if (table.has("absorption")) glass.absorption = colour_in(table, "absorption");
    return glass;
}

SurfaceMaterial material_in(const TomlTable& object) {
    if (!object.has("material"))
        object.fail("", "material is missing: material = { kind = \"diffuse\", albedo = 0.5 }");
    const TomlTable table = *object.table("material");
    const auto kind = table.text("kind");
    if (!kind) table.fail("", "kind is missing: diffuse, metal, mirror, dielectric or emitter");
    if (*kind == DiffuseMaterial::k_name) {
        table.refuse_unknown({"kind", "albedo"});
        return DiffuseMaterial{share_in(table, "albedo", 0.5)};
    }
    if (*kind == MetalMaterial::k_name) return metal_in(table);
    if (*kind == MirrorMaterial::k_name) {
        table.refuse_unknown({"kind", "albedo"});
        return MirrorMaterial{share_in(table, "albedo", 1)};
    }
    if (*kind == DielectricMaterial::k_name) return dielectric_in(table);
    if (*kind == EmitterMaterial::k_name) {
        table.refuse_unknown({"kind", "radiance"});
        return EmitterMaterial{unpolarised_radiance_in(table)};
    }
    table.fail("kind", fmt::format("no kind \"{}\"; known: diffuse, metal, mirror, dielectric, "
                                   "emitter",
                                   *kind));
}

}  // namespace

std::vector<SceneObject> objects_of(const TomlTable& root, LengthUnit unit) {
    std::vector<SceneObject> objects;
    for (const TomlTable& table : root.tables("object")) {
        SceneObject object{shape_in(table, unit), material_in(table)};
        const bool open = std::holds_alternative<PlaneShape>(object.shape) ||
                          std::holds_alternative<DiscShape>(object.shape);
        if (open && std::holds_alternative<DielectricMaterial>(object.material))
            table.fail("material", "glass fills a closed shape: sphere, box or mesh");
        objects.push_back(std::move(object));
    }
    return objects;
}

}  // namespace culet
