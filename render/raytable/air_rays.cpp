#include "render/raytable/air_rays.h"

#include <algorithm>
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
      pattern_(sample_pattern(rays.samples, rays.setup.on(Effects::aperture), scene.settings.filter,
                              scene.settings.filter_radius)),
      middle_(middle),
      plain_(!camera_.cone && !(camera_.aperture_radius > 0)) {
    if (!plain_) return;
    // Scaled to depth 1 along the line of sight, directions are linear in x and y.
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

void AirRayMaker::make(int y, std::vector<RaySample>& samples, bool origins, AirRays& rays) const {
    const std::size_t count = samples.size();
    rays.count = static_cast<int>(count);
    for (auto* of : {&rays.origin, &rays.direction}) {
        for (std::vector<float>& list : *of) list.resize(std::max(list.size(), count));
    }
    if (plain_) {
        make_plain(y, samples, origins, rays);
        return;
    }
    for (std::size_t i = 0; i < count; ++i) {
        const SamplePoint& p = pattern_[static_cast<std::size_t>(samples[i].sample)];
        const double x = samples[i].x + p.x, down = y + p.y;
        const bool sees = eyes_.sees(x, down);
        const EyeRay ray =
            sees ? eyes_.through(x, down, p.pupil_x, p.pupil_y) : EyeRay{middle_, Vec3(0, 0, 1)};
        if (!sees) samples[i].x = -1;
        const auto origin = floats(ray.origin - middle_), direction = floats(ray.direction);
        for (std::size_t k = 0; k < 3; ++k) {
            rays.origin[k][i] = origin[k];
            rays.direction[k][i] = direction[k];
        }
    }
}

void AirRayMaker::make_plain(int y, const std::vector<RaySample>& samples, bool origins,
                             AirRays& rays) const {
    const std::size_t count = samples.size();
    float *dx = rays.direction[0].data(), *dy = rays.direction[1].data(),
          *dz = rays.direction[2].data();
    for (std::size_t i = 0; i < count; ++i) {
        const SamplePoint& p = pattern_[static_cast<std::size_t>(samples[i].sample)];
        const float right = static_cast<float>(samples[i].x + p.x),
                    down = static_cast<float>(y + p.y);
        const float x = direction_[0] + right * direction_x_[0] + down * direction_y_[0],
                    up = direction_[1] + right * direction_x_[1] + down * direction_y_[1],
                    z = direction_[2] + right * direction_x_[2] + down * direction_y_[2];
        const float over = 1 / std::sqrt(x * x + up * up + z * z);
        dx[i] = over * x;
        dy[i] = over * up;
        dz[i] = over * z;
    }
    for (std::size_t k = 0; origins && k < 3; ++k) {
        float* at = rays.origin[k].data();
        for (std::size_t i = 0; i < count; ++i) {
            const SamplePoint& p = pattern_[static_cast<std::size_t>(samples[i].sample)];
            at[i] = origin_[k] + static_cast<float>(samples[i].x + p.x) * origin_x_[k] +
                    static_cast<float>(y + p.y) * origin_y_[k];
        }
    }
}

}  // namespace culet
