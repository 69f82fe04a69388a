#include "render/scene/camera_io.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "render/scene/view_presets.h"
#include "stone/numbers/units.h"

namespace culet {

namespace {

constexpr int k_most_pixels_a_side = 32768;
constexpr double k_most_pixels = 268435456;  // 2^28, the limit for reading picture files

void read_picture_size(const TomlTable& table, Camera& camera) {
    if (const auto size = table.numbers("size")) {
        if (size->size() != 2)
            table.fail("size", "size has two numbers, width and height in pixels");
        for (double s : *size) {
            if (!(s >= 1 && s <= k_most_pixels_a_side) || s != std::floor(s)) {
                table.fail("size", fmt::format("size must be whole numbers from 1 to {}, found {}",
                                               k_most_pixels_a_side, s));
            }
        }
        if ((*size)[0] * (*size)[1] > k_most_pixels) {
            table.fail("size", fmt::format("{} x {} pixels are more than one picture may have, "
                                           "2^28",
                                           (*size)[0], (*size)[1]));
        }
        camera.width = static_cast<int>((*size)[0]);
        camera.height = static_cast<int>((*size)[1]);
    }
    if (const auto point = table.numbers("principal_point")) {
        if (point->size() != 2)
            table.fail("principal_point", "principal_point has two numbers, x and y in pixels");
        for (double at : *point) {
            if (!(std::abs(at) <= 100.0 * k_most_pixels_a_side))
                table.fail("principal_point",
                           fmt::format("principal_point {} px is too far off", at));
        }
        camera.principal_point = {(*point)[0], (*point)[1]};
    }
}

}  // namespace

Camera read_camera(const TomlTable& table) {
    table.refuse_unknown(
        with_view_keys({"position", "look_at", "up", "fov", "orthographic_width", "size",
                        "principal_point", "aperture_radius", "focus_distance"}));
    Camera camera;
    read_eye_optics(table, camera);
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
    if (const auto width = table.number("orthographic_width")) {
        if (!(*width > 0)) {
            table.fail("orthographic_width",
                       fmt::format("orthographic_width must be positive, found {}", *width));
        }
        camera.orthographic_width = *width;
    }
    read_picture_size(table, camera);
    camera.aperture_radius = table.number("aperture_radius").value_or(0);
    if (camera.aperture_radius < 0)
        table.fail("aperture_radius", "aperture_radius must not be negative");
    camera.focus_distance = table.number("focus_distance").value_or(0);
    if (camera.aperture_radius > 0 && !(camera.focus_distance > 0) && !camera.cone) {
        table.fail("aperture_radius",
                   "an aperture needs focus_distance, the distance at which the picture is sharp");
    }
    return camera;
}

bool names_a_view(const TomlTable& table) {
    for (const char* key : {"position", "look_at", "fov", "orthographic_width", "principal_point",
                            "aperture_radius", "focus_distance", "cone"}) {
        if (table.has(key)) return true;
    }
    return false;
}

}  // namespace culet
