#include "render/scene/framing.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "stone/numbers/units.h"

namespace culet {

namespace {

// The eye's distance, in sizes of the stone; irrelevant for an orthographic view.
constexpr double k_distance = 5;
constexpr double k_along_view = 1e-9;

// Moves the camera back along `towards_eye` until every corner lies within the framed share.
void frame_in_perspective(const Solid& solid, const Vec3& right, const Vec3& upwards,
                          const Vec3& towards_eye, Camera& camera) {
    camera.orthographic_width.reset();
    camera.fov = radians(k_photograph_fov_deg);
    const double half_height = k_framed_share * std::tan(camera.fov / 2),
                 half_width = half_height * camera.width / camera.height;
    double distance = 0;
    for (const Vec3& v : solid.vertices) {
        const Vec3 from = v - camera.look_at;
        distance =
            std::max({distance, glm::dot(from, towards_eye) +
                                    std::max(std::abs(glm::dot(from, right)) / half_width,
                                             std::abs(glm::dot(from, upwards)) / half_height)});
    }
    camera.position = camera.look_at + distance * towards_eye;
}

Vec3 direction_to(Facing facing) {
    if (facing == Facing::photograph) return direction_to_photographer();
    return {0, 0, facing == Facing::crown ? 1.0 : -1.0};
}

}  // namespace

Vec3 direction_to_photographer() {
    const double tilt = radians(k_photograph_tilt_deg);
    return {0, -std::sin(tilt), std::cos(tilt)};
}

void frame_stone(const Solid& solid, Facing facing, Camera& camera) {
    if (solid.vertices.empty()) return;
    Vec3 low = solid.vertices.front(), high = low;
    for (const Vec3& v : solid.vertices) {
        low = glm::min(low, v);
        high = glm::max(high, v);
    }
    const Vec3 towards_eye = direction_to(facing);
    if (!(glm::length(glm::cross(towards_eye, camera.up)) > k_along_view * glm::length(camera.up)))
        camera.up = {0, 1, 0};
    const Vec3 right = glm::normalize(glm::cross(camera.up, towards_eye)),
               upwards = glm::cross(towards_eye, right);
    const auto [left_end, right_end] = std::minmax_element(
        solid.vertices.begin(), solid.vertices.end(),
        [&right](const Vec3& a, const Vec3& b) { return glm::dot(a, right) < glm::dot(b, right); });
    const auto [lower_end, upper_end] = std::minmax_element(
        solid.vertices.begin(), solid.vertices.end(), [&upwards](const Vec3& a, const Vec3& b) {
            return glm::dot(a, upwards) < glm::dot(b, upwards);
        });
    const double x = glm::dot(*left_end + *right_end, right) / 2,
                 y = glm::dot(*lower_end + *upper_end, upwards) / 2;
    const double wide = glm::dot(*right_end - *left_end, right),
                 high_up = glm::dot(*upper_end - *lower_end, upwards);
    camera.look_at =
        x * right + y * upwards + glm::dot((low + high) / 2.0, towards_eye) * towards_eye;
    if (facing == Facing::photograph)
        return frame_in_perspective(solid, right, upwards, towards_eye, camera);
    camera.position = camera.look_at + k_distance * diameter(solid) * towards_eye;
    camera.orthographic_width =
        std::max(wide, high_up * camera.width / camera.height) / k_framed_share;
}

}  // namespace culet
