#include "render/scene_io.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "render/image_io.h"
#include "render/light_presets.h"
#include "stone/errors.h"
#include "stone/material_io.h"
#include "stone/stone_io.h"

namespace culet {

namespace {

constexpr int k_most_pixels_a_side = 32768;

Vec3 direction_in(const TomlTable& table, const char* key) {
    const auto value = table.vector(key);
    if (!value) table.fail("", fmt::format("{} is missing", key));
    const double length = glm::length(*value);
    if (!(length > 0) || !std::isfinite(length))
        table.fail(key, fmt::format("{} must not be the zero vector", key));
    return *value / length;
}

Vec3 point_in(const TomlTable& table, const char* key) {
    const auto value = table.vector(key);
    if (!value) table.fail("", fmt::format("{} is missing", key));
    return *value;
}

double positive_in(const TomlTable& table, const char* key,
                   std::optional<double> otherwise = std::nullopt) {
    const auto value = table.number(key);
    if (!value && !otherwise) table.fail("", fmt::format("{} is missing", key));
    if (value && !(*value > 0))
        table.fail(key, fmt::format("{} must be positive, found {}", key, *value));
    return value ? *value : *otherwise;
}

LightColour radiance_in(const TomlTable& table) {
    switch (table.kind("radiance")) {
        case TomlTable::Kind::missing:
            return {1.0};
        case TomlTable::Kind::number: {
            const double value = *table.number("radiance");
            if (value < 0)
                table.fail("radiance",
                           fmt::format("radiance must not be negative, found {}", value));
            return {value};
        }
        case TomlTable::Kind::list: {
            const auto list = *table.numbers("radiance");
            if (list.size() != 3)
                table.fail("radiance",
                           fmt::format("a colour has three numbers, found {}", list.size()));
            for (double v : list) {
                if (v < 0)
                    table.fail("radiance",
                               fmt::format("radiance must not be negative, found {}", v));
            }
            return {Rgb{list[0], list[1], list[2]}};
        }
        case TomlTable::Kind::text: {
            const std::string name = *table.text("radiance");
            if (illuminant(name.c_str()) == nullptr) {
                table.fail("radiance", fmt::format("no spectrum \"{}\"; known: D65, A", name));
            }
            return {name};
        }
        default:
            table.fail("radiance",
                       "radiance is a number, [r, g, b], or a spectrum by name (D65, A)");
    }
}

Camera read_camera(const TomlTable& table) {
    table.refuse_unknown({"position", "look_at", "up", "fov", "orthographic_width", "size",
                          "aperture_radius", "focus_distance"});
    Camera camera;
    if (const auto position = table.vector("position")) camera.position = *position;
    if (const auto look_at = table.vector("look_at")) camera.look_at = *look_at;
    if (const auto up = table.vector("up")) camera.up = *up;
    const Vec3 view = camera.look_at - camera.position;
    if (!(glm::length(view) > 0)) table.fail("look_at", "the camera looks at its own position");
    const double sine = glm::length(glm::cross(glm::normalize(view), camera.up));
    if (!(sine > 1e-9 * glm::length(camera.up)) || !(glm::length(camera.up) > 0)) {
        table.fail("up",
                   "camera up must not be zero nor along the view: for a face-up picture use up = "
                   "[0, 1, 0]");
    }
    if (table.has("fov") && table.has("orthographic_width")) {
        table.fail("fov", "give fov (perspective) or orthographic_width, not both");
    }
    const double fov_deg = table.number("fov").value_or(20);
    if (!(fov_deg > 0 && fov_deg < 180)) {
        table.fail("fov", fmt::format("fov must lie between 0 and 180 degrees, found {}", fov_deg));
    }
    camera.fov = radians(fov_deg);
    if (table.has("orthographic_width"))
        camera.orthographic_width = positive_in(table, "orthographic_width");
    if (const auto size = table.numbers("size")) {
        if (size->size() != 2)
            table.fail("size", "size has two numbers, width and height in pixels");
        for (double s : *size) {
            if (!(s >= 1 && s <= k_most_pixels_a_side) || s != std::floor(s)) {
                table.fail("size", fmt::format("size must be whole numbers from 1 to {}, found {}",
                                               k_most_pixels_a_side, s));
            }
        }
        camera.width = static_cast<int>((*size)[0]);
        camera.height = static_cast<int>((*size)[1]);
    }
    camera.aperture_radius = table.number("aperture_radius").value_or(0);
    if (camera.aperture_radius < 0)
        table.fail("aperture_radius", "aperture_radius must not be negative");
    camera.focus_distance = table.number("focus_distance").value_or(0);
    if (camera.aperture_radius > 0 && !(camera.focus_distance > 0)) {
        table.fail("aperture_radius",
                   "an aperture needs focus_distance, the distance at which the picture is sharp");
    }
    return camera;
}

std::shared_ptr<const EnvironmentMap> read_environment(const TomlTable& table,
                                                       std::vector<std::string>& notes) {
    const auto path = *table.path("environment");
    ReadPicture read = [&] {
        try {
            return read_picture(path);
        } catch (const InputError& error) {
            table.fail("environment", error.what());
        }
    }();
    auto map = std::make_shared<EnvironmentMap>();
    map->width = read.picture.width;
    map->height = read.picture.height;
    map->rgb = std::move(read.picture.rgb);
    if (map->width != 2 * map->height) {
        table.fail("environment",
                   fmt::format("{} is {} x {} pixels; a lat-long map is twice as wide as high",
                               path.filename().string(), map->width, map->height));
    }
    std::size_t negative = 0;
    for (std::size_t i = 0; i < map->rgb.size(); ++i) {
        if (!std::isfinite(map->rgb[i])) {
            const std::size_t pixel = i / 3;
            table.fail("environment", fmt::format("{} holds {} at pixel {},{}: repair the map",
                                                  path.filename().string(), map->rgb[i],
                                                  pixel % static_cast<std::size_t>(map->width),
                                                  pixel / static_cast<std::size_t>(map->width)));
        }
        if (map->rgb[i] < 0) {
            map->rgb[i] = 0;
            ++negative;
        }
    }
    if (negative > 0) {
        notes.push_back(
            fmt::format("{}: {} negative values were taken as 0", path.string(), negative));
    }
    return map;
}

Lights read_lights(const TomlTable& table, double stone_diameter, std::vector<std::string>& notes) {
    table.refuse_unknown(
        {"environment", "constant", "preset", "sphere", "lobe", "hemisphere", "cap", "plane"});
    Lights lights;
    if (const auto preset = table.text("preset")) {
        const auto known = light_preset(*preset, stone_diameter);
        if (!known) {
            table.fail(
                "preset",
                fmt::format("no light \"{}\"; known: aset, hearts, arrows, lightbox, daylight",
                            *preset));
        }
        lights = *known;
    }
    if (table.has("environment")) {
        if (table.has("constant"))
            table.fail("constant", "give an environment or a constant, not both");
        lights.environment = read_environment(table, notes);
    }
    if (const auto constant = table.number("constant")) {
        if (*constant < 0)
            table.fail("constant",
                       fmt::format("constant must not be negative, found {}", *constant));
        lights.constant = *constant;
    }
    for (const TomlTable& t : table.tables("sphere")) {
        t.refuse_unknown({"center", "radius", "radiance"});
        lights.spheres.push_back({point_in(t, "center"), positive_in(t, "radius"), radiance_in(t)});
    }
    for (const TomlTable& t : table.tables("lobe")) {
        t.refuse_unknown({"direction", "exponent", "radiance"});
        const double exponent = t.number("exponent").value_or(1);
        if (exponent < 0)
            t.fail("exponent", fmt::format("exponent must not be negative, found {}", exponent));
        lights.lobes.push_back({direction_in(t, "direction"), exponent, radiance_in(t)});
    }
    for (const TomlTable& t : table.tables("hemisphere")) {
        t.refuse_unknown({"direction", "radiance"});
        lights.hemispheres.push_back({direction_in(t, "direction"), radiance_in(t)});
    }
    for (const TomlTable& t : table.tables("cap")) {
        t.refuse_unknown({"direction", "half_angle", "from", "to", "radiance"});
        if (t.has("half_angle") == t.has("to"))
            t.fail("", "a cap needs half_angle, or a band from .. to, in degrees");
        const double from = t.number("from").value_or(0);
        const double to = t.has("to") ? *t.number("to") : *t.number("half_angle");
        if (!(from >= 0 && from < to && to <= 180)) {
            t.fail(t.has("to") ? "to" : "half_angle",
                   fmt::format("a cap's angles are 0 <= from < to <= 180 degrees, found {} to {}",
                               from, to));
        }
        lights.caps.push_back(
            {direction_in(t, "direction"), radians(from), radians(to), radiance_in(t)});
    }
    for (const TomlTable& t : table.tables("plane")) {
        t.refuse_unknown({"point", "normal", "u", "v", "radiance"});
        PlaneLight plane;
        plane.point = point_in(t, "point");
        plane.normal = direction_in(t, "normal");
        plane.u = t.vector("u");
        plane.v = t.vector("v");
        plane.radiance = radiance_in(t);
        if (plane.u.has_value() != plane.v.has_value())
            t.fail("", "a plane has both half-extents u and v, or none");
        if (plane.u && !(glm::length(glm::cross(*plane.u, *plane.v)) >
                         1e-12 * glm::length(*plane.u) * glm::length(*plane.v))) {
            t.fail("u", "u and v must span the plane");
        }
        lights.planes.push_back(plane);
    }
    const bool dark = !lights.environment && lights.constant == 0 && lights.spheres.empty() &&
                      lights.lobes.empty() && lights.hemispheres.empty() && lights.caps.empty() &&
                      lights.planes.empty();
    if (dark && !table.has("constant")) table.fail("", "the scene is dark: [light] names no light");
    return lights;
}

RenderSettings read_settings(const TomlTable& table) {
    table.refuse_unknown({"engine", "depth", "tolerance", "effects", "wavelengths", "samples"});
    RenderSettings settings;
    if (const auto engine = table.text("engine")) {
        const std::vector<std::string> known{"auto", "reference", "beams", "preview", "raytable"};
        if (std::find(known.begin(), known.end(), *engine) == known.end()) {
            table.fail("engine", fmt::format("no engine \"{}\"; known: auto, reference", *engine));
        }
        if (*engine != "auto" && *engine != "reference") {
            table.fail("engine",
                       fmt::format("the engine {} is not built yet: use reference", *engine));
        }
        settings.engine = *engine;
    }
    if (const auto depth = table.integer("depth")) {
        if (*depth < 0 || *depth > 1000)
            table.fail("depth", fmt::format("depth is 0 (by tolerance) to 1000, found {}", *depth));
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
        } else if (word != "auto") {
            set_effects({word});
        }
    } else if (const auto names = table.texts("effects")) {
        set_effects(*names);
    }
    if (auto wavelengths = table.numbers("wavelengths")) {
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

Stone read_scene_stone(const TomlTable& root) {
    if (root.has("stone") == root.has("mesh")) {
        root.fail("",
                  "a scene names its stone: stone = \"stone.toml\", or mesh = \"...\" with "
                  "material = \"...\"");
    }
    if (root.has("stone")) {
        const StoneFile file = read_stone(*root.path("stone"));
        Stone stone = file.stone;
        if (root.has("material")) stone.material = material_named_in(root, root);
        return stone;
    }
    Stone stone;
    stone.solid = read_solid(*root.path("mesh")).solid;
    stone.name = root.path("mesh")->stem().string();
    if (const auto unit = root.text("unit")) {
        const auto known = length_unit(*unit);
        if (!known)
            root.fail("unit", fmt::format("unit is \"{}\"; expected mm, cm, m or in", *unit));
        stone.unit = *known;
    }
    stone.material = root.kind("material") == TomlTable::Kind::table
                         ? material_of(*root.table("material"))
                         : material_named_in(root, root);
    stone.crystal = crystal_frame_in(root, stone.material.optic);
    stone.convex = root.boolean("convex").value_or(true);
    return stone;
}

}  // namespace

Scene read_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                 const Stone* stone_instead) {
    const TomlTable root = read_toml(file, overrides);
    root.refuse_unknown({"stone", "mesh", "material", "unit", "optic_axis", "principal_axes",
                         "convex", "name", "camera", "light", "object", "render"});
    Scene scene;
    if (root.has("object")) root.fail("object", "objects around the stone are not rendered yet");
    if (stone_instead != nullptr) {
        scene.stone = *stone_instead;
    } else {
        scene.stone = read_scene_stone(root);
    }
    if (const auto camera = root.table("camera")) scene.camera = read_camera(*camera);
    const auto light = root.table("light");
    if (!light) root.fail("", "the scene is dark: add a [light] table, e.g. constant = 1.0");
    scene.lights = read_lights(*light, diameter(scene.stone.solid), scene.notes);
    if (const auto settings = root.table("render")) scene.settings = read_settings(*settings);
    return scene;
}

}  // namespace culet
