#include "compare/light_probe/ball_view.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include "render/scene/environment_layout.h"
#include "stone/progress/check_stop.h"

namespace culet {

namespace {

constexpr double k_least_quality = 1e-7;
constexpr double k_rim = 0.21, k_near_rim = 0.05;  // radians before the blind cone

double ramp(double value, double from, double to) {
    const double t = std::clamp((value - from) / std::max(to - from, 1e-12), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

bool is_left_out(const BallView& view, const Vec3& direction) {
    const auto place = view.ball.place_of(direction);
    if (!place) return false;
    const long x = std::lround(place->x), y = std::lround(place->y);
    const int width = view.picture->width;
    if (x < 0 || y < 0 || x >= width || y >= view.picture->height) return false;
    return (*view.left_out)[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                            static_cast<std::size_t>(x)] != 0;
}

}  // namespace

double BallView::quality(const Vec3& direction) const {
    const double cosine = glm::dot(direction, ball.towards_camera());
    const double theta = std::acos(std::clamp(cosine, -1.0, 1.0));
    const double limit = std::numbers::pi - ball.blind_half_angle();
    if (theta >= limit - k_near_rim) return 0;  // pixels there are half background
    if (left_out && is_left_out(*this, direction)) return 0;
    const double density = (1 + cosine) / 2;
    const double q = density * density * ramp(theta, photographer.within, photographer.beyond) *
                     (1 - ramp(theta, limit - k_rim, limit - k_near_rim));
    return std::max(q, k_least_quality);
}

SeenLight light_at(const Photo& picture, const PixelPlace& place) {
    const double x = std::clamp(place.x, 0.0, picture.width - 1.0);
    const double y = std::clamp(place.y, 0.0, picture.height - 1.0);
    const int x0 = std::min(static_cast<int>(x), std::max(picture.width - 2, 0));
    const int y0 = std::min(static_cast<int>(y), std::max(picture.height - 2, 0));
    const double u = x - x0, v = y - y0;
    SeenLight seen;
    for (int corner = 0; corner < 4; ++corner) {
        const int i = std::min(x0 + corner % 2, picture.width - 1);
        const int j = std::min(y0 + corner / 2, picture.height - 1);
        const double share = (corner % 2 ? u : 1 - u) * (corner / 2 ? v : 1 - v);
        const std::size_t pixel = static_cast<std::size_t>(j) * picture.width + i;
        for (std::size_t c = 0; c < 3; ++c) seen.rgb[c] += share * picture.rgb[3 * pixel + c];
        if (!picture.saturated.empty()) seen.over += share * picture.saturated[pixel];
    }
    return seen;
}

ViewMap view_map(const BallView& view, int width) {
    ViewMap map;
    map.width = width;
    map.height = width / 2;
    const std::size_t texels = static_cast<std::size_t>(map.width) * map.height;
    map.rgb.resize(3 * texels);
    map.quality.resize(texels);
    map.over.resize(texels);
    const double texel = 2 * std::numbers::pi / width;
    const double pixel = std::sqrt(view.ball.solid_angle_per_pixel());
    const int steps = std::clamp(static_cast<int>(std::ceil(2 * texel / pixel)), 2, 12);
    const glm::dmat3 camera_from_world = glm::transpose(view.world_from_camera);
    tbb::parallel_for(0, map.height, [&](int y) {
        check_stop();
        for (int x = 0; x < map.width; ++x) {
            Rgb sum{};
            double weight = 0, over = 0, quality = 0, solid = 0;
            for (int k = 0; k < steps * steps; ++k) {
                const Vec3 d =
                    lat_long_direction(x + (k % steps + 0.5) / steps, y + (k / steps + 0.5) / steps,
                                       map.width, map.height);
                const double density = std::hypot(d.x, d.y);
                solid += density;
                const Vec3 in_camera = camera_from_world * d;
                const double q = view.quality(in_camera);
                if (q <= 0) continue;
                const auto place = view.ball.place_of(in_camera);
                if (!place) continue;
                const SeenLight seen = light_at(*view.picture, *place);
                for (std::size_t c = 0; c < 3; ++c) sum[c] += density * q * seen.rgb[c];
                weight += density * q;
                over += density * q * seen.over;
                quality += density * q;
            }
            const std::size_t at = static_cast<std::size_t>(y) * map.width + x;
            if (weight <= 0) continue;
            for (std::size_t c = 0; c < 3; ++c)
                map.rgb[3 * at + c] = static_cast<float>(sum[c] / weight);
            map.quality[at] = static_cast<float>(quality / solid);
            map.over[at] = static_cast<float>(over / weight);
        }
    });
    return map;
}

}  // namespace culet
