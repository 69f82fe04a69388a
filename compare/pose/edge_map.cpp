#include "compare/pose/edge_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "compare/photo/pixels.h"
#include "compare/pose/picture_noise.h"

namespace culet {

namespace {

// Fine enough that a degree of tilt, which moves a table by 0.5 % of the diameter, is over a pixel.
constexpr double k_map_diameter = 300;

struct Gradient {
    cv::Mat x, y, strength;  // CV_32F
};

// Direction and strength of the greatest change over three colours: Di Zenzo (1986).
Gradient gradient_of(const cv::Mat& picture) {
    cv::Mat dx, dy;
    cv::Sobel(picture, dx, CV_32F, 1, 0, 3, 0.125);
    cv::Sobel(picture, dy, CV_32F, 0, 1, 3, 0.125);
    Gradient gradient{cv::Mat(picture.size(), CV_32F), cv::Mat(picture.size(), CV_32F),
                      cv::Mat(picture.size(), CV_32F)};
    for (int y = 0; y < picture.rows; ++y) {
        for (int x = 0; x < picture.cols; ++x) {
            const cv::Vec3f a = dx.at<cv::Vec3f>(y, x), b = dy.at<cv::Vec3f>(y, x);
            const float xx = a.dot(a), yy = b.dot(b), xy = a.dot(b);
            const float most = 0.5f * (xx + yy + std::sqrt((xx - yy) * (xx - yy) + 4 * xy * xy));
            const float angle = 0.5f * std::atan2(2 * xy, xx - yy);
            gradient.x.at<float>(y, x) = std::cos(angle);
            gradient.y.at<float>(y, x) = std::sin(angle);
            gradient.strength.at<float>(y, x) = std::sqrt(std::max(0.0f, most));
        }
    }
    return gradient;
}

/// Non-maximum suppression: whether the gradient is largest along its own direction.
bool is_ridge(const Gradient& gradient, int x, int y) {
    const float gx = gradient.x.at<float>(y, x), gy = gradient.y.at<float>(y, x);
    const int dx = static_cast<int>(std::lround(gx)), dy = static_cast<int>(std::lround(gy));
    const float here = gradient.strength.at<float>(y, x);
    return here >= gradient.strength.at<float>(y + dy, x + dx) &&
           here > gradient.strength.at<float>(y - dy, x - dx);
}

}  // namespace

int EdgeMap::direction_of(double normal_x, double normal_y) {
    double angle = std::atan2(normal_y, normal_x);
    if (angle < 0) angle += std::numbers::pi;
    const int direction =
        static_cast<int>(std::lround(angle * k_edge_directions / std::numbers::pi));
    return direction % k_edge_directions;
}

EdgeMap::EdgeMap(const cv::Mat& colour, const cv::Mat& mask, double diameter_px, double reach) {
    scale_ = std::min(1.0, k_map_diameter / diameter_px);
    cv::Mat picture = colour, stone = mask;
    if (scale_ < 1) {
        cv::resize(colour, picture, {}, scale_, scale_, cv::INTER_AREA);
        cv::resize(mask, stone, picture.size(), 0, 0, cv::INTER_AREA);
    }
    cv::Mat shown = encoded(picture);
    cv::GaussianBlur(shown, shown, {0, 0}, 0.8, 0.8, cv::BORDER_REPLICATE);
    const Gradient gradient = gradient_of(shown);
    const float least = static_cast<float>(least_edge(gradient.strength, stone));
    const double reach_px = std::max(2.0, reach * diameter_px * scale_);
    double sum_squares = 0;
    for (int direction = 0; direction < k_edge_directions; ++direction) {
        const auto k = static_cast<std::size_t>(direction);
        const double angle = direction * std::numbers::pi / k_edge_directions;
        const float nx = static_cast<float>(std::cos(angle)),
                    ny = static_cast<float>(std::sin(angle));
        // Directions overlap by half, because an edge's direction is known to about ten degrees.
        const float least_cosine =
            static_cast<float>(std::cos(0.75 * std::numbers::pi / k_edge_directions));
        cv::Mat far(picture.size(), CV_8U, cv::Scalar(255));
        for (int y = 1; y + 1 < picture.rows; ++y) {
            for (int x = 1; x + 1 < picture.cols; ++x) {
                if (gradient.strength.at<float>(y, x) < least) continue;
                const float cosine =
                    gradient.x.at<float>(y, x) * nx + gradient.y.at<float>(y, x) * ny;
                if (std::abs(cosine) < least_cosine || !is_ridge(gradient, x, y)) continue;
                far.at<unsigned char>(y, x) = 0;
            }
        }
        cv::Mat distance;
        cv::distanceTransform(far, distance, cv::DIST_L2, cv::DIST_MASK_5, CV_32F);
        near_[k] = cv::max(1 - distance / reach_px, 0.0);
        chance_[k] = static_cast<float>(cv::mean(near_[k], stone > 127)[0]);
        cv::Mat off = near_[k] - static_cast<double>(chance_[k]);
        sum_squares += cv::mean(off.mul(off), stone > 127)[0];
    }
    spread_ = std::sqrt(std::max(1e-12, sum_squares / k_edge_directions));
}

}  // namespace culet
