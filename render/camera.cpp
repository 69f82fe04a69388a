#include <cmath>
#include <glm/geometric.hpp>

#include "render/scene.h"

namespace culet {

EyeRays::EyeRays(const Camera& camera) : camera_(camera) {
    forward_ = glm::normalize(camera.look_at - camera.position);
    const Vec3 right = glm::normalize(glm::cross(forward_, camera.up));
    const Vec3 down = glm::cross(forward_, right);
    // One pixel: a length for the orthographic camera, else a length at unit distance. Pixels are
    // square.
    const double pixel = camera.orthographic_width ? *camera.orthographic_width / camera.width
                                                   : 2 * std::tan(camera.fov / 2) / camera.height;
    right_ = pixel * right;
    down_ = pixel * down;
}

EyeRay EyeRays::through(double x, double y, double pupil_x, double pupil_y) const {
    const Vec3 across = (x - 0.5 * camera_.width) * right_ + (y - 0.5 * camera_.height) * down_;
    EyeRay ray;
    if (camera_.orthographic_width) {
        ray = {camera_.position + across, forward_};
    } else {
        ray = {camera_.position, glm::normalize(forward_ + across)};
    }
    if (camera_.aperture_radius > 0) {
        // Thin lens: every ray of a pixel meets in the plane at the focus distance.
        const Vec3 focus =
            ray.origin + camera_.focus_distance / glm::dot(ray.direction, forward_) * ray.direction;
        ray.origin += camera_.aperture_radius *
                      (pupil_x * glm::normalize(right_) + pupil_y * glm::normalize(down_));
        ray.direction = glm::normalize(focus - ray.origin);
    }
    return ray;
}

}  // namespace culet
