#include "render/raytable/air_rays.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace culet {

namespace {

std::array<float, 3> floats(const Vec3& v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

}  // namespace

AirRayMaker::AirRayMaker(const Scene& scene, const TableRays& rays, const Vec3& middle)
    : camera_(scene.camera),
      eyes_(scene.camera),
      pattern_(sample_pattern(rays.samples, rays.setup.on(Effects::aperture),
                              scene.settings.filter, scene.settings.filter_radius)),
      middle_(middle),
      plain_(!camera_.cone && !(camera_.aperture_radius > 0)) {
    if (!plain_) return;
    // Divided by their part along the line of sight, directions are linear in x and y.
    const Vec3 forward = glm::normalize(camera_.look_at - camera_.position);
    const double w = camera_.width, h = camera_.height;
    const EyeRay corner = eyes_.through(0, 0), right = eyes_.through(w, 0),
                 down = eyes_.through(0, h);
    const auto level = [&](const EyeRay& ray) {
        return ray.direction / glm::dot(ray.direction, forward);
    };
    direction_ = floats(level(corner));
    direction_x_ = floats((level(right) - level(corner)) / w);
    direction_y_ = floats((level(down) - level(corner)) / h);
    origin_ = floats(corner.origin - middle_);
    origin_x_ = floats((right.origin - corner.origin) / w);
    origin_y_ = floats((down.origin - corner.origin) / h);
}

EyeRay AirRayMaker::eye_ray(std::uint32_t ray) const {
    const auto samples = static_cast<std::uint32_t>(pattern_.size());
    const auto width = static_cast<std::uint32_t>(camera_.width);
    const SamplePoint& p = pattern_[ray % samples];
    const std::uint32_t pixel = ray / samples;
    return eyes_.through(pixel % width + p.x, pixel / width + p.y, p.pupil_x, p.pupil_y);
}

void AirRayMaker::start(AirRays& rays, std::size_t most) const {
    rays.count = 0;
    for (auto* of : {&rays.origin, &rays.direction}) {
        for (std::vector<float>& list : *of) list.resize(most);
    }
}

bool AirRayMaker::add(int x, int y, int sample, AirRays& rays) const {
    const SamplePoint& p = pattern_[static_cast<std::size_t>(sample)];
    const auto i = static_cast<std::size_t>(rays.count);
    if (plain_) {
        const float right = static_cast<float>(x + p.x), down = static_cast<float>(y + p.y);
        std::array<float, 3> d;
        for (std::size_t k = 0; k < 3; ++k) {
            d[k] = direction_[k] + right * direction_x_[k] + down * direction_y_[k];
            rays.origin[k][i] = origin_[k] + right * origin_x_[k] + down * origin_y_[k];
        }
        const float over = 1 / std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        for (std::size_t k = 0; k < 3; ++k) rays.direction[k][i] = over * d[k];
    } else {
        if (!eyes_.sees(x + p.x, y + p.y)) return false;
        const EyeRay ray = eyes_.through(x + p.x, y + p.y, p.pupil_x, p.pupil_y);
        const auto origin = floats(ray.origin - middle_), direction = floats(ray.direction);
        for (std::size_t k = 0; k < 3; ++k) {
            rays.origin[k][i] = origin[k];
            rays.direction[k][i] = direction[k];
        }
    }
    ++rays.count;
    return true;
}

}  // namespace culet
