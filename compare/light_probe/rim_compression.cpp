#include "compare/light_probe/rim_compression.h"

#include <algorithm>
#include <cmath>

namespace culet {

namespace {

// Of the radius: farther in, what the ball reflects is pressed together little.
constexpr double k_inner = 0.93, k_outer = 0.99;
// Pixels: the rim itself is an edge of any circle, which the lens spreads so far.
constexpr double k_edge = 3;
// Of a file of 8 bits, in light from 0 to 1: smaller changes say nothing.
constexpr double k_step = 1.0 / 255;

}  // namespace

double rim_compression(const cv::Mat& light, const BallCircle& circle) {
    double along = 0, across = 0;
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
            along += std::abs(gx * dx + gy * dy) / r;
            across += std::abs(gx * dy - gy * dx) / r + k_step;
        }
    }
    return across > 0 ? along / across : 0;
}

}  // namespace culet
