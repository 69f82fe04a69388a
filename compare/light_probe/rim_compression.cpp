#include "compare/light_probe/rim_compression.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "stone/progress/check_stop.h"

namespace culet {

namespace {

// Ring, in radii: farther in, reflections are hardly compressed.
constexpr double k_inner = 0.93, k_outer = 0.99;
// Width in pixels of the rim's own edge after blur, which any circle has.
constexpr double k_edge = 3;
// A step of an 8-bit file in light from 0 to 1: smaller changes mean nothing.
constexpr double k_least_change = 1.0 / 255;
constexpr std::size_t k_rings = 6;

}  // namespace

RimLook rim_look(const cv::Mat& light, const BallCircle& circle) {
    check_stop();
    double along = 0, across = 0;
    std::array<double, k_rings> outwards{};
    const double reach = std::min(k_outer * circle.radius, circle.radius - k_edge);
    const int top = std::max(1, static_cast<int>(std::ceil(circle.y - reach))),
              bottom = std::min(light.rows - 2, static_cast<int>(std::floor(circle.y + reach))),
              left = std::max(1, static_cast<int>(std::ceil(circle.x - reach))),
              right = std::min(light.cols - 2, static_cast<int>(std::floor(circle.x + reach)));
    for (int y = top; y <= bottom; ++y) {
        for (int x = left; x <= right; ++x) {
            const double dx = x - circle.x, dy = y - circle.y, r = std::hypot(dx, dy);
            if (r < k_inner * circle.radius || r > reach || r == 0) continue;
            const double gx = double(light.at<float>(y, x + 1) - light.at<float>(y, x - 1)),
                         gy = double(light.at<float>(y + 1, x) - light.at<float>(y - 1, x));
            const double radial = (gx * dx + gy * dy) / r;
            const double depth = (r / circle.radius - k_inner) / (k_outer - k_inner);
            outwards[std::min(static_cast<std::size_t>(depth * k_rings), k_rings - 1)] += radial;
            along += std::abs(radial);
            across += std::abs(gx * dy - gy * dx) / r + k_least_change;
        }
    }
    RimLook look;
    if (across > 0) look.compression = along / across;
    for (const double sum : outwards) look.alike += along > 0 ? std::abs(sum) / along : 0;
    return look;
}

}  // namespace culet
