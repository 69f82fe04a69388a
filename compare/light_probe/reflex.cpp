#include "compare/light_probe/reflex.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "compare/photo/pixels.h"

namespace culet {

namespace {

constexpr int k_least_reflex_pixels = 9;
// Share of the radius: the last 23 degrees before the blind cone are only a few pixels wide.
constexpr double k_inside = 0.98;
constexpr int k_reflex_blur = 10;  // pixels: light farther from its edge is another light
constexpr double k_faint = 0.02;   // share of the step at the edge up to which blur is followed
constexpr int k_rounds = 6;

// The seed's 4-connected component above a level, with holes filled; empty if the seed is not above
// it.
cv::Mat grown(const cv::Mat& light, const cv::Mat& on_ball, double level, const cv::Point& seed) {
    cv::Mat over = light > level;
    cv::bitwise_and(over, on_ball, over);
    if (over.at<std::uint8_t>(seed) == 0) return {};
    cv::Mat part;
    cv::connectedComponents(over, part, 4, CV_32S);
    const cv::Mat component = part == part.at<int>(seed);
    // Holes cannot be reached from outside.
    cv::Mat outside;
    cv::copyMakeBorder(component, outside, 1, 1, 1, 1, cv::BORDER_CONSTANT, cv::Scalar(0));
    cv::floodFill(outside, {0, 0}, cv::Scalar(128));
    return outside(cv::Rect(1, 1, component.cols, component.rows)) != 128;
}

cv::Mat dilated(const cv::Mat& mask, int pixels) {
    cv::Mat wider;
    cv::dilate(mask, wider,
               cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * pixels + 1, 2 * pixels + 1}));
    return wider;
}

// Pixels three and four away from the light: past its edge, and still near it.
cv::Mat ring_around(const cv::Mat& inside, const cv::Mat& on_ball) {
    cv::Mat ring = dilated(inside, 4) & ~dilated(inside, 2);
    return ring & on_ball;
}

std::vector<PixelPlace> outline_of(const cv::Mat& light, const cv::Mat& inside, double level) {
    std::vector<PixelPlace> outline;
    for (int y = 1; y + 1 < inside.rows; ++y) {
        for (int x = 1; x + 1 < inside.cols; ++x) {
            if (inside.at<std::uint8_t>(y, x) == 0) continue;
            for (const cv::Point step : {cv::Point(1, 0), {-1, 0}, {0, 1}, {0, -1}}) {
                const cv::Point next = cv::Point(x, y) + step;
                if (inside.at<std::uint8_t>(next) != 0) continue;
                const double here = light.at<float>(y, x), there = light.at<float>(next);
                // A pixel inside may be dark where a hole beside the edge was filled.
                if (!(here > level && there <= level)) continue;
                const double t = (here - level) / (here - there);
                outline.push_back({x + t * step.x, y + t * step.y});
            }
        }
    }
    return outline;
}

std::vector<std::uint8_t> flags_of(const cv::Mat& mask) {
    std::vector<std::uint8_t> flags;
    flags.reserve(mask.total());
    for (int y = 0; y < mask.rows; ++y)
        for (int x = 0; x < mask.cols; ++x) flags.push_back(mask.at<std::uint8_t>(y, x) != 0);
    return flags;
}

}  // namespace

ReflexSearch reflex_at(const Photo& picture, const BallCircle& ball, const PixelPlace& seed) {
    const cv::Point at(static_cast<int>(std::lround(seed.x)),
                       static_cast<int>(std::lround(seed.y)));
    if (std::hypot(at.x - ball.x, at.y - ball.y) > k_inside * ball.radius || at.x < 0 || at.y < 0 ||
        at.x >= picture.width || at.y >= picture.height)
        return {std::nullopt, NoReflex::beside_the_ball};
    const cv::Mat light = luminance(colour_of(picture));
    cv::Mat on_ball(light.size(), CV_8U, cv::Scalar(0));
    for (int y = 0; y < light.rows; ++y)
        for (int x = 0; x < light.cols; ++x)
            if (std::hypot(x - ball.x, y - ball.y) <= k_inside * ball.radius)
                on_ball.at<std::uint8_t>(y, x) = 255;

    Reflex reflex;
    double level = light.at<float>(at) / 2;
    cv::Mat inside;
    for (int round = 0; round < k_rounds; ++round) {
        inside = grown(light, on_ball, level, at);
        if (inside.empty() || !(level > 0)) return {std::nullopt, NoReflex::not_brighter};
        reflex.within = quantile(light, inside, 0.5);
        const cv::Mat ring = ring_around(inside, on_ball);
        if (cv::countNonZero(ring) == 0) return {std::nullopt, NoReflex::not_brighter};
        reflex.around = quantile(light, ring, 0.5);
        const double next = (reflex.within + reflex.around) / 2;
        const bool settled = std::abs(next - level) <= 1e-3 * level;
        level = next;
        if (settled) break;
    }
    if (!(reflex.within >= 2 * reflex.around)) return {std::nullopt, NoReflex::not_brighter};
    inside = grown(light, on_ball, level, at);
    if (inside.empty()) return {std::nullopt, NoReflex::not_brighter};
    reflex.pixels = cv::countNonZero(inside);
    if (reflex.pixels < k_least_reflex_pixels) return {std::nullopt, NoReflex::too_small};
    if (cv::countNonZero(dilated(inside, 1) & ~on_ball) > 0)
        return {std::nullopt, NoReflex::at_the_rim};

    reflex.outline = outline_of(light, inside, level);
    cv::Mat core;
    cv::erode(inside, core, cv::Mat::ones(3, 3, CV_8U));
    const cv::Mat& counted = cv::countNonZero(core) > 0 ? core : inside;
    const cv::Scalar mean = cv::mean(colour_of(picture), counted);
    for (std::size_t c = 0; c < 3; ++c) reflex.radiance[c] = mean[static_cast<int>(c)];
    if (!picture.saturated.empty()) {
        const cv::Mat over(light.size(), CV_32F, const_cast<float*>(picture.saturated.data()));
        reflex.over = cv::mean(over, inside)[0];
    }
    const double faint = reflex.around + k_faint * (reflex.within - reflex.around);
    cv::Mat blur = grown(light, on_ball & dilated(inside, k_reflex_blur), faint, at);
    if (blur.empty()) blur = inside;
    reflex.touched = flags_of(dilated(inside | blur, 2));
    reflex.inside = flags_of(inside);
    return {std::move(reflex), NoReflex::not_brighter};
}

}  // namespace culet
