#include "bench/stored_views.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "stone/text/errors.h"

namespace culet {

namespace {

constexpr double k_pi = std::numbers::pi;
// Smaller weights are rounding errors of zero.
constexpr double k_no_share = 1e-9;
// Sine of the least angle between `up` and a view.
constexpr double k_upright = 0.02;

// Even steps of a range, and the position of an angle in them.
struct Steps {
    int count;
    double size;
    Steps(double range, double step)
        : count(std::max(1, static_cast<int>(std::ceil(range / step - 1e-9)))),
          size(range / count) {}
};

struct Place {
    int below;
    double part;  // of a step, 0..1
    Place(double angle, const Steps& steps) {
        const double at = angle / steps.size;
        // A whole step apart from rounding counts as whole.
        const double whole = std::round(at);
        const double exact = std::abs(at - whole) < k_no_share ? whole : at;
        below = std::clamp(static_cast<int>(std::floor(exact)), 0, steps.count - 1);
        part = exact - below;
    }
};

}  // namespace

std::vector<StoredView> stored_views(const Camera& camera, double step) {
    if (camera.cone || camera.aperture_radius > 0)
        throw InputError("views are interpolated for cameras without a lens");
    const Vec3 offset = camera.position - camera.look_at;
    const double distance = glm::length(offset);
    const Steps polar_steps(k_pi, step), azimuth_steps(2 * k_pi, step);
    const double turn = std::atan2(offset.y, offset.x);
    const Place polar(std::atan2(std::hypot(offset.x, offset.y), offset.z), polar_steps),
        azimuth(turn < 0 ? turn + 2 * k_pi : turn, azimuth_steps);
    std::vector<StoredView> views;
    for (const int i : {0, 1}) {
        for (const int j : {0, 1}) {
            const double share =
                (i == 0 ? 1 - polar.part : polar.part) * (j == 0 ? 1 - azimuth.part : azimuth.part);
            if (share < k_no_share) continue;
            const int p = polar.below + i;
            // All azimuths of a pole are one view.
            const bool pole = p == 0 || p == polar_steps.count;
            const int a = pole ? 0 : (azimuth.below + j) % azimuth_steps.count;
            StoredView view;
            view.name = fmt::format("polar-{:04}-azimuth-{:04}.rays", p, a);
            const auto same = std::find_if(views.begin(), views.end(), [&](const StoredView& v) {
                return v.name == view.name;
            });
            if (same != views.end()) {
                same->share += share;
                continue;
            }
            const double theta = p * polar_steps.size, phi = a * azimuth_steps.size;
            const Vec3 towards{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                               std::cos(theta)};
            if (glm::length(glm::cross(towards, glm::normalize(camera.up))) < k_upright) {
                throw InputError(
                    "the camera's up lies along a view that is stored: give another up");
            }
            view.camera = camera;
            view.camera.position = camera.look_at + distance * towards;
            view.share = share;
            views.push_back(view);
        }
    }
    return views;
}

ScreenPlace::ScreenPlace(const Camera& camera)
    : parallel_(camera.orthographic_width.has_value()),
      forward_(glm::normalize(camera.look_at - camera.position)) {
    const EyeRays eyes(camera);
    const double w = camera.width, h = camera.height;
    const EyeRay corner = eyes.through(0, 0), right = eyes.through(w, 0), down = eyes.through(0, h);
    // In a parallel view the origins are linear in the pixel, else the directions scaled to a depth
    // of 1.
    const auto place = [&](const EyeRay& ray) {
        return parallel_ ? ray.origin : ray.direction / glm::dot(ray.direction, forward_);
    };
    origin_ = corner.origin;
    corner_ = place(corner);
    right_ = (place(right) - corner_) / w;
    down_ = (place(down) - corner_) / h;
}

std::array<double, 2> ScreenPlace::of(const Vec3& point) const {
    const Vec3 from = point - origin_;
    const Vec3 across = parallel_ ? point - corner_ : from / glm::dot(from, forward_) - corner_;
    return {glm::dot(across, right_) / glm::dot(right_, right_),
            glm::dot(across, down_) / glm::dot(down_, down_)};
}

}  // namespace culet
