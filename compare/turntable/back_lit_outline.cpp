#include "compare/turntable/back_lit_outline.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "compare/photo/pixels.h"
#include "compare/turntable/sharp_corners.h"
#include "stone/numbers/upper_median.h"

namespace culet {

namespace {

// Share of the picture's 95 % quantile; darker pixels are not ground.
constexpr double k_ground = 0.5;
constexpr double k_least_contrast = 0.3;
constexpr int k_least_outline_pixels = 400;
// Range of the search across the outline, pixels; a lens's blur is within it.
constexpr double k_reach = 4, k_sample = 0.25;
// Pixels between points: a lens's blur correlates nearer ones.
constexpr int k_spacing = 3;
constexpr std::size_t k_least_points = 40;
constexpr int k_border = 6;  // pixels at the picture's border where the outline is not traced

// The ground as a quadric in the picture's coordinates (-1..1), by least squares.
cv::Mat ground_of(const cv::Mat& light, double bright) {
    cv::Matx<double, 6, 6> normal = cv::Matx<double, 6, 6>::zeros();
    cv::Vec<double, 6> right = cv::Vec<double, 6>::zeros();
    const auto terms = [&](int x, int y) {
        const double u = 2.0 * x / light.cols - 1, v = 2.0 * y / light.rows - 1;
        return cv::Vec<double, 6>{1, u, v, u * u, u * v, v * v};
    };
    const int step = std::max(1, std::min(light.cols, light.rows) / 200);
    for (int y = 0; y < light.rows; y += step) {
        for (int x = 0; x < light.cols; x += step) {
            const double value = double(light.at<float>(y, x));
            if (value < k_ground * bright) continue;
            const auto t = terms(x, y);
            normal += t * t.t();
            right += value * t;
        }
    }
    cv::Vec<double, 6> found;
    cv::solve(normal, right, found, cv::DECOMP_SVD);
    cv::Mat ground(light.size(), CV_32F);
    for (int y = 0; y < light.rows; ++y) {
        for (int x = 0; x < light.cols; ++x)
            ground.at<float>(y, x) =
                static_cast<float>(std::max(0.1 * bright, found.dot(terms(x, y))));
    }
    return ground;
}

// 255 on the largest object before the ground, with its bright spots filled.
cv::Mat stone_before(const cv::Mat& relative) {
    cv::Mat bright = relative > k_ground, labels, stats, centres;
    // The ground is what is connected to the border by bright pixels.
    cv::copyMakeBorder(bright, bright, 1, 1, 1, 1, cv::BORDER_CONSTANT, cv::Scalar(255));
    cv::floodFill(bright, {0, 0}, cv::Scalar(128), nullptr, {}, {}, 4);
    const cv::Mat dark = bright(cv::Rect(1, 1, relative.cols, relative.rows)) != 128;
    const int count = cv::connectedComponentsWithStats(dark, labels, stats, centres, 4);
    int largest = 0;
    for (int i = 1; i < count; ++i) {
        if (largest == 0 ||
            stats.at<int>(i, cv::CC_STAT_AREA) > stats.at<int>(largest, cv::CC_STAT_AREA))
            largest = i;
    }
    if (largest == 0 || stats.at<int>(largest, cv::CC_STAT_AREA) < k_least_outline_pixels)
        return {};
    return labels == largest;
}

struct Crossing {
    cv::Point2d at;
    double contrast = 0;
};

// Searches along the normal, from outside in.
std::optional<Crossing> crossing(const cv::Mat& relative, const cv::Point2d& pixel,
                                 const cv::Point2d& normal) {
    const auto light = [&](double t) {
        return between_pixels(relative, pixel.x + t * normal.x, pixel.y + t * normal.y);
    };
    double outer = 0, inner = 1e300;
    for (int k = 0; k < 4; ++k) outer += light(k_reach - k * k_sample) / 4;
    for (double t = -k_reach; t <= 0; t += k_sample) inner = std::min(inner, light(t));
    if (!(outer > 0) || 1 - inner / outer < k_least_contrast) return std::nullopt;
    const double half = (outer + inner) / 2;
    double before = light(k_reach);
    for (double t = k_reach - k_sample; t >= -k_reach; t -= k_sample) {
        const double now = light(t);
        if (now <= half && before > half) {
            const double at = t + k_sample * (half - now) / (before - now);
            return Crossing{pixel + at * normal, 1 - inner / outer};
        }
        before = now;
    }
    return std::nullopt;
}

}  // namespace

BackLitOutline back_lit_outline(const Photo& photo) {
    BackLitOutline result;
    const cv::Mat light = luminance(colour_of(photo));
    const double bright = quantile(light, {}, 0.95);
    if (!(bright > 0)) {
        result.trouble = "the picture is black";
        return result;
    }
    cv::Mat relative;
    cv::divide(light, ground_of(light, bright), relative);
    const cv::Mat stone = stone_before(relative);
    if (stone.empty()) {
        result.trouble = "nothing dark stands before a bright ground: light the stone from behind";
        return result;
    }
    std::vector<std::vector<cv::Point>> contours;
    cv::findContours(stone, contours, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
    const auto longest =
        std::max_element(contours.begin(), contours.end(),
                         [](const auto& a, const auto& b) { return a.size() < b.size(); });
    cv::Mat smooth, along_x, along_y;
    cv::GaussianBlur(relative, smooth, {0, 0}, 1.5);
    cv::Sobel(smooth, along_x, CV_32F, 1, 0);
    cv::Sobel(smooth, along_y, CV_32F, 0, 1);
    std::vector<double> contrasts;
    int since = k_spacing;
    for (const cv::Point& p : *longest) {
        result.at_left |= p.x < k_border;
        result.at_right |= p.x >= light.cols - k_border;
        result.at_top |= p.y < k_border;
        result.at_bottom |= p.y >= light.rows - k_border;
        if (p.x < k_border || p.y < k_border || p.x >= light.cols - k_border ||
            p.y >= light.rows - k_border || ++since < k_spacing)
            continue;
        const cv::Point2d slope(double(along_x.at<float>(p)), double(along_y.at<float>(p)));
        const double steep = std::hypot(slope.x, slope.y);
        if (!(steep > 0)) continue;
        const auto found = crossing(relative, cv::Point2d(p), slope * (1 / steep));
        if (!found) continue;
        since = 0;
        contrasts.push_back(found->contrast);
        result.points.push_back(
            {found->at.x - (light.cols - 1) / 2.0, (light.rows - 1) / 2.0 - found->at.y});
    }
    if (result.points.size() < k_least_points) {
        result.trouble = fmt::format(
            "the outline is too faint or too small: {} pixels along it are needed, found {}",
            k_least_points * k_spacing, result.points.size() * k_spacing);
        return result;
    }
    SharpOutline sharp = sharpened(result.points);
    result.points = std::move(sharp.points);
    result.corners = std::move(sharp.corners);
    result.contrast = upper_median(contrasts);
    return result;
}

}  // namespace culet
