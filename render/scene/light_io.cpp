#include "render/scene/light_io.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "render/image/image_io.h"
#include "render/scene/environment_layout.h"
#include "render/scene/lamp_io.h"
#include "render/scene/light_presets.h"
#include "render/scene/table_values.h"
#include "render/scene/view_presets.h"
#include "stone/numbers/units.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

// Largest sine between a plane and its half-extents; allows for directions typed with a few digits.
constexpr double k_in_plane = 0.01;

std::vector<std::string_view> with_polarisation_keys(std::vector<std::string_view> keys) {
    keys.insert(keys.end(), {"polarization", "degree_of_polarization"});
    return keys;
}

// `normal`: of the polariser's sheet, if the light has one.
std::optional<LinearPolarisation> polarisation_in(const TomlTable& table,
                                                  const std::optional<Vec3>& normal) {
    if (!table.has("polarization")) {
        if (table.has("degree_of_polarization"))
            table.fail("degree_of_polarization",
                       "degree_of_polarization needs polarization, the direction of vibration");
        return std::nullopt;
    }
    LinearPolarisation polarisation{direction_in(table, "polarization"), normal, 1};
    if (const auto degree = table.number("degree_of_polarization")) {
        if (!(*degree >= 0 && *degree <= 1))
            table.fail("degree_of_polarization",
                       fmt::format("degree_of_polarization is 0 to 1, found {}", *degree));
        polarisation.degree = *degree;
    }
    if (normal && !(glm::length(glm::cross(*normal, polarisation.vibration)) > 1e-9)) {
        table.fail("polarization",
                   "light cannot vibrate along the way it goes: polarization must not be parallel "
                   "to the light's direction or normal");
    }
    return polarisation;
}

LightColour radiance_in(const TomlTable& table, const std::optional<Vec3>& normal) {
    LightColour colour = unpolarised_radiance_in(table);
    colour.polarisation = polarisation_in(table, normal);
    return colour;
}

ReadPicture picture_in(const TomlTable& table, const std::filesystem::path& path) {
    try {
        const std::string* const held = table.held_file("environment");
        return held != nullptr ? picture_of_bytes(*held, path) : read_picture(path);
    } catch (const InputError& error) {
        table.fail("environment", error.what());
    }
}

// Decides by the map's shape.
bool is_cube(const EnvironmentMap& map, const TomlTable& table, const std::string& file) {
    const auto shaped = [&](int across, int down) {
        return map.width * static_cast<long long>(down) ==
               map.height * static_cast<long long>(across);
    };
    if (shaped(6, 1) || shaped(4, 3) || shaped(3, 4)) {
        table.fail("environment",
                   fmt::format("{} is {} x {} pixels, a cube map by its shape; six squares in a "
                               "column are read (OpenEXR's layout), and lat-long maps",
                               file, map.width, map.height));
    }
    const bool cube = shaped(1, 6);
    if (!cube && !shaped(2, 1)) {
        table.fail("environment",
                   fmt::format("{} is {} x {} pixels; a lat-long map is twice as wide as high",
                               file, map.width, map.height));
    }
    return cube;
}

void add_notes(const ReadPicture& read, const std::string& file, std::vector<std::string>& notes) {
    for (const std::string& note : read.notes) notes.push_back(fmt::format("{}: {}", file, note));
    if (!read.not_photometric.empty()) {
        notes.push_back(
            fmt::format("{}: {}: the map is not photometric", file, read.not_photometric));
    }
    if (read.was_encoded) {
        notes.push_back(fmt::format(
            "{}: lights brighter than white are missing in a picture of 8 or 16 bits; an EXR or "
            "HDR map holds them",
            file));
    }
}

// Sets negative values to 0; returns how many.
std::size_t clear_negative(EnvironmentMap& map, const TomlTable& table, const std::string& file) {
    std::size_t negative = 0;
    for (std::size_t i = 0; i < map.rgb.size(); ++i) {
        if (!std::isfinite(map.rgb[i])) {
            const std::size_t pixel = i / 3;
            table.fail("environment",
                       fmt::format("{} holds {} at pixel {},{}: repair the map", file, map.rgb[i],
                                   pixel % static_cast<std::size_t>(map.width),
                                   pixel / static_cast<std::size_t>(map.width)));
        }
        if (map.rgb[i] < 0) {
            map.rgb[i] = 0;
            ++negative;
        }
    }
    return negative;
}

std::shared_ptr<const EnvironmentMap> read_environment(const TomlTable& table,
                                                       std::vector<std::string>& notes) {
    const auto path = *table.path("environment");
    const std::string file = path.filename().string();
    ReadPicture read = picture_in(table, path);
    auto map = std::make_shared<EnvironmentMap>();
    map->width = read.picture.width;
    map->height = read.picture.height;
    map->rgb = std::move(read.picture.rgb);
    const bool cube = is_cube(*map, table, file);
    add_notes(read, file, notes);
    if (const std::size_t negative = clear_negative(*map, table, file); negative > 0) {
        notes.push_back(
            fmt::format("{}: {} negative values were taken as 0", path.string(), negative));
    }
    // A lat-long map keeps a cube's detail if its equator has as many texels.
    if (cube) *map = lat_long_of_cube(*map, std::min(4 * map->width, 4096));
    return map;
}

// Overloads read one source each; the unused pointer selects the type.
SphereLight source_of(const TomlTable& t, const SphereLight*) {
    t.refuse_unknown(with_polarisation_keys({"center", "radius", "radiance"}));
    return {point_in(t, "center"), positive_in(t, "radius"), radiance_in(t, std::nullopt)};
}

CosinePowerLight source_of(const TomlTable& t, const CosinePowerLight*) {
    t.refuse_unknown(with_polarisation_keys({"direction", "exponent", "radiance"}));
    const double exponent = t.number("exponent").value_or(1);
    if (exponent < 0)
        t.fail("exponent", fmt::format("exponent must not be negative, found {}", exponent));
    const Vec3 direction = direction_in(t, "direction");
    return {direction, exponent, radiance_in(t, direction)};
}

HemisphereLight source_of(const TomlTable& t, const HemisphereLight*) {
    t.refuse_unknown(with_polarisation_keys({"direction", "radiance"}));
    const Vec3 direction = direction_in(t, "direction");
    return {direction, radiance_in(t, direction)};
}

DiscLight source_of(const TomlTable& t, const DiscLight*) {
    t.refuse_unknown(with_polarisation_keys({"direction", "half_angle", "from", "to", "radiance"}));
    if (t.has("half_angle") == t.has("to"))
        t.fail("", "a cap needs half_angle, or a band from .. to, in degrees");
    const double from = t.number("from").value_or(0);
    const double to = t.has("to") ? *t.number("to") : *t.number("half_angle");
    if (!(from >= 0 && from < to && to <= 180)) {
        t.fail(t.has("to") ? "to" : "half_angle",
               fmt::format("a cap's angles are 0 <= from < to <= 180 degrees, found {} to {}", from,
                           to));
    }
    const Vec3 direction = direction_in(t, "direction");
    return {direction, radians(from), radians(to), radiance_in(t, direction)};
}

PlaneLight source_of(const TomlTable& t, const PlaneLight*) {
    t.refuse_unknown(with_polarisation_keys({"point", "normal", "u", "v", "radiance"}));
    PlaneLight plane;
    plane.point = point_in(t, "point");
    plane.normal = direction_in(t, "normal");
    plane.u = t.vector("u");
    plane.v = t.vector("v");
    plane.radiance = radiance_in(t, plane.normal);
    if (plane.u.has_value() != plane.v.has_value())
        t.fail("", "a plane has both half-extents u and v, or none");
    if (plane.u && !(glm::length(glm::cross(*plane.u, *plane.v)) >
                     1e-12 * glm::length(*plane.u) * glm::length(*plane.v))) {
        t.fail("u", "u and v must span the plane");
    }
    for (auto [key, extent] : {std::pair{"u", &plane.u}, std::pair{"v", &plane.v}}) {
        if (!*extent) continue;
        const double out = glm::dot(**extent, plane.normal);
        if (std::abs(out) > k_in_plane * glm::length(**extent)) {
            t.fail(key,
                   fmt::format("{} must lie in the plane, at right angles to its normal", key));
        }
        **extent -= out * plane.normal;
    }
    return plane;
}

}  // namespace

Lights lights_of(const TomlTable& table, LengthUnit unit, std::vector<std::string>& notes) {
    std::vector<std::string_view> keys{"environment", "constant", "rotate"};
    for_each_light_type([&]<class L>() { keys.push_back(L::k_name); });
    table.refuse_unknown(with_view_keys(with_polarisation_keys(std::move(keys))));
    Lights lights;
    const auto preset = table.text("preset");
    const bool is_view = preset && is_view_preset(*preset);
    if (preset && !is_view) {
        const auto known = light_preset(*preset);
        if (!known) table.fail("preset", no_light_preset(*preset));
        lights = *known;
    }
    if (table.has("environment")) {
        if (table.has("constant"))
            table.fail("constant", "give an environment or a constant, not both");
        lights.environment = read_environment(table, notes);
    }
    if (const auto constant = table.number("constant")) {
        lights.constant = checked_radiance(table, "constant", *constant);
    }
    lights.polarisation = polarisation_in(table, std::nullopt);
    for_each_light_type([&]<class L>() {
        for (const TomlTable& t : table.tables(L::k_name)) {
            if constexpr (std::is_same_v<L, LampLight>) {
                lights.sources.push_back(lamp_of(t, unit));
                colour_of(lights.sources.back()).polarisation = polarisation_in(t, std::nullopt);
            } else {
                lights.sources.push_back(source_of(t, static_cast<const L*>(nullptr)));
            }
        }
    });
    const bool dark = !lights.environment && lights.constant == 0 && lights.sources.empty();
    if (dark && !table.has("constant") && !is_view)
        table.fail("", "the scene is dark: [light] names no light");
    return lights;
}

}  // namespace culet
