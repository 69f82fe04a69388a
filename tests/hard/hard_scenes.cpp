#include "tests/hard/hard_scenes.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <glm/geometric.hpp>
#include <limits>
#include <random>
#include <stdexcept>

#include "render/scene/scene_io.h"
#include "stone/mesh/mesh_io.h"
#include "stone/text/output_file.h"

namespace culet::hard {

namespace {

// Writes a lat-long map in linear light as PFM, the one format that holds any float: rows from the
// bottom.
void write_map(const TomlTable& map, const std::filesystem::path& file) {
    map.refuse_unknown({"width", "value", "texel", "texels", "poison"});
    const int width = static_cast<int>(map.integer("width").value_or(16)), height = width / 2;
    const auto size = static_cast<std::size_t>(3 * width * height);
    std::vector<float> rgb(size, static_cast<float>(map.number("value").value_or(1)));
    const std::string poison = map.text("poison").value_or("");
    float texel = static_cast<float>(map.number("texel").value_or(1));
    if (poison == "nan") texel = std::numeric_limits<float>::quiet_NaN();
    if (poison == "inf") texel = std::numeric_limits<float>::infinity();
    if (poison == "largest") texel = std::numeric_limits<float>::max();
    if (poison == "denormal") texel = std::numeric_limits<float>::denorm_min();
    const auto texels = static_cast<std::size_t>(map.integer("texels").value_or(1));
    for (std::size_t i = 0; i < 3 * texels && i < size; ++i) rgb[(size / 2 + 7 * i) % size] = texel;
    std::string bytes = fmt::format("PF\n{} {}\n-1.0\n", width, height);
    bytes.append(reinterpret_cast<const char*>(rgb.data()), rgb.size() * sizeof(float));
    write_text(file, bytes);
}

}  // namespace

Scene hard_scene(const HardCase& hard_case, const HardPoint& point, const TomlTable& parameters) {
    // A folder per case: several may run at once.
    const std::filesystem::path folder = std::filesystem::path(CULET_HARD_RESULTS) / "scenes" /
                                         (hard_case.section + "." + hard_case.name);
    std::filesystem::create_directories(folder);
    const std::string name = point.label.empty() ? "scene" : point.label;
    const Solid solid = hard_solid(parameters.table("stone").value());
    write_mesh(solid, folder / (name + ".obj"));
    // A case's [environment] is the file "environment.pfm" of its scene.
    if (const auto map = parameters.table("environment")) {
        write_map(*map, folder / "environment.pfm");
    }
    write_text(folder / (name + ".toml"), scene_text(hard_case, point, name + ".obj"));
    Scene scene = read_scene(folder / (name + ".toml"));
    scene.stone.solid = solid;  // exactly as it is: reading a mesh may repair it
    return scene;
}

Scene turned(Scene scene, const Turn& turn) {
    if (scene.lights.environment) throw std::logic_error("an environment map does not turn");
    scene.stone.solid = turned(std::move(scene.stone.solid), turn);
    for (Vec3& axis : scene.stone.crystal.axes) axis = turn(axis);
    scene.stone.up = turn(scene.stone.up);
    Camera& camera = scene.camera;
    for (Vec3* v : {&camera.position, &camera.look_at, &camera.up}) *v = turn(*v);
    Lights& lights = scene.lights;
    for (SphereLight& l : lights_of_type<SphereLight>(lights)) l.center = turn(l.center);
    for (CosinePowerLight& l : lights_of_type<CosinePowerLight>(lights))
        l.direction = turn(l.direction);
    for (HemisphereLight& l : lights_of_type<HemisphereLight>(lights))
        l.direction = turn(l.direction);
    for (DiscLight& l : lights_of_type<DiscLight>(lights)) l.direction = turn(l.direction);
    for (PlaneLight& l : lights_of_type<PlaneLight>(lights)) {
        l.point = turn(l.point);
        l.normal = turn(l.normal);
        if (l.u) l.u = turn(*l.u);
        if (l.v) l.v = turn(*l.v);
    }
    return scene;
}

Scene scaled(Scene scene, double factor) {
    scene.stone.solid = scaled(std::move(scene.stone.solid), factor);
    scene.camera.position *= factor;
    scene.camera.look_at *= factor;
    scene.camera.aperture_radius *= factor;
    scene.camera.focus_distance *= factor;
    if (scene.camera.orthographic_width) *scene.camera.orthographic_width *= factor;
    for (SphereLight& l : lights_of_type<SphereLight>(scene.lights)) {
        l.center *= factor;
        l.radius *= factor;
    }
    for (PlaneLight& l : lights_of_type<PlaneLight>(scene.lights)) {
        l.point *= factor;
        if (l.u) *l.u *= factor;
        if (l.v) *l.v *= factor;
    }
    for (Spectrum& k : scene.stone.material.absorption_per_mm) k = k.scaled(1 / factor);
    return scene;
}

Scene reordered(Scene scene, unsigned seed) {
    std::shuffle(scene.stone.solid.facets.begin(), scene.stone.solid.facets.end(),
                 std::mt19937_64(seed));
    return scene;
}

Scene nudged(Scene scene, unsigned seed) {
    for (Vec3& v : scene.stone.solid.vertices) v = nudged(v, seed);
    for (Facet& f : scene.stone.solid.facets) {
        f.plane.normal = nudged(f.plane.normal, seed);
        f.plane.offset = nudged(f.plane.offset, seed);
    }
    for (Vec3& axis : scene.stone.crystal.axes) axis = nudged(axis, seed);
    scene.camera.position = nudged(scene.camera.position, seed);
    scene.camera.look_at = nudged(scene.camera.look_at, seed);
    return scene;
}

}  // namespace culet::hard
