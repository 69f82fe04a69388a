#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "render/scene/scene.h"
#include "stone/solid/least_rotation.h"

namespace culet {

EyeRays::EyeRays(const Camera& camera) : camera_(camera), middle_(line_of_sight_in(camera)) {
    forward_ = glm::normalize(camera.look_at - camera.position);
    const Vec3 right = glm::normalize(glm::cross(forward_, camera.up));
    const Vec3 down = glm::cross(forward_, right);
    // Size of a square pixel: a length (orthographic), a sine (conoscope), or a length at unit
    // distance.
    double pixel = 0;
    if (camera.cone) {
        pixel = 2 * std::sin(*camera.cone) / std::min(camera.width, camera.height);
    } else if (camera.orthographic_width) {
        pixel = *camera.orthographic_width / camera.width;
    } else {
        pixel = 2 * std::tan(camera.fov / 2) / camera.height;
    }
    right_ = pixel * right;
    down_ = pixel * down;
}

bool EyeRays::sees(double x, double y) const {
    if (!camera_.cone) return true;
    const Vec3 across = (x - middle_[0]) * right_ + (y - middle_[1]) * down_;
    return glm::dot(across, across) < 1;
}

EyeRay EyeRays::through(double x, double y, double pupil_x, double pupil_y) const {
    const Vec3 across = (x - middle_[0]) * right_ + (y - middle_[1]) * down_;
    if (camera_.cone) {
        const double cosine = std::sqrt(std::max(0.0, 1 - glm::dot(across, across)));
        const Vec3 direction = glm::normalize(cosine * forward_ + across);
        const Vec3 beside = camera_.aperture_radius *
                            (pupil_x * glm::normalize(right_) + pupil_y * glm::normalize(down_));
        const double distance = glm::length(camera_.look_at - camera_.position);
        return {camera_.look_at + beside - distance * direction, direction};
    }
    EyeRay ray;
    if (camera_.orthographic_width) {
        ray = {camera_.position + across, forward_};
    } else {
        ray = {camera_.position, glm::normalize(forward_ + across)};
    }
    if (camera_.aperture_radius > 0) {
        // Thin lens: all rays of a pixel meet at one point of the focal plane.
        const Vec3 focus =
            ray.origin + camera_.focus_distance / glm::dot(ray.direction, forward_) * ray.direction;
        ray.origin += camera_.aperture_radius *
                      (pupil_x * glm::normalize(right_) + pupil_y * glm::normalize(down_));
        ray.direction = glm::normalize(focus - ray.origin);
    }
    return ray;
}

EyeFrame EyeRays::frame(const Vec3& direction) const {
    const Vec3 x = turned_with(forward_, direction, glm::normalize(right_));
    return {x, glm::cross(x, direction)};
}

}  // namespace culet
