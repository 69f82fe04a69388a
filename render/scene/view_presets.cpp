#include "render/scene/view_presets.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>

#include "stone/numbers/units.h"

namespace culet {

namespace {

constexpr double k_cone_deg = 30;

// Accepts either spelling.
std::optional<double> angle_in(const TomlTable& table, const char* american, const char* british) {
    if (table.has(american) && table.has(british))
        table.fail(british, fmt::format("give {} or {}, not both", american, british));
    return table.number(table.has(british) ? british : american);
}

}  // namespace

std::vector<std::string_view> with_view_keys(std::vector<std::string_view> keys) {
    keys.insert(keys.end(), {"preset", "polarizer", "polariser", "analyzer", "analyser", "cone",
                             "retarder_nm", "retarder_angle"});
    return keys;
}

bool is_view_preset(std::string_view name) {
    return name == "polariscope" || name == "conoscope" || name == "dichroscope";
}

void read_eye_optics(const TomlTable& table, Camera& camera) {
    if (const auto analyzer = angle_in(table, "analyzer", "analyser"))
        camera.optics.analyzer = radians(*analyzer);
    if (const auto cone = table.number("cone")) {
        if (!(*cone > 0 && *cone <= 90))
            table.fail("cone", fmt::format("cone is an angle of 0 to 90 degrees, found {}", *cone));
        camera.cone = radians(*cone);
    }
    if (table.has("retarder_angle") && !table.has("retarder_nm"))
        table.fail("retarder_angle", "a retarder needs retarder_nm, its retardation");
    if (const auto nm = table.number("retarder_nm")) {
        if (!(*nm >= 0))
            table.fail("retarder_nm",
                       fmt::format("retarder_nm must not be negative, found {}", *nm));
        camera.optics.retarder = {*nm, radians(table.number("retarder_angle").value_or(45))};
    }
}

void apply_view_preset(std::string_view name, const TomlTable& table, Scene& scene) {
    Camera& camera = scene.camera;
    read_eye_optics(table, camera);
    const double polarizer = radians(angle_in(table, "polarizer", "polariser").value_or(0));
    const Vec3 forward = glm::normalize(camera.look_at - camera.position);
    HemisphereLight light{forward, {1.0}};
    if (name == "dichroscope") {
        camera.optics.two_windows = true;
        if (!camera.optics.analyzer) camera.optics.analyzer = 0;
        if (camera.width % 2 != 0) {
            table.fail("preset",
                       fmt::format("a dichroscope's two windows need an even width of the "
                                   "picture, found {}",
                                   camera.width));
        }
    } else {
        const EyeFrame frame = EyeRays(camera).frame(forward);
        light.radiance.polarisation = LinearPolarisation{
            std::cos(polarizer) * frame.x + std::sin(polarizer) * frame.y, forward, 1};
        if (!camera.optics.analyzer) camera.optics.analyzer = polarizer + std::numbers::pi / 2;
        if (name == "conoscope" && !camera.cone) camera.cone = radians(k_cone_deg);
    }
    scene.lights.sources.push_back(light);
}

}  // namespace culet
