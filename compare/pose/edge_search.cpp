#include "compare/pose/edge_search.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "compare/photo/pixels.h"
#include "compare/pose/picture_noise.h"

namespace culet {

namespace {

constexpr double k_smoothing = 0.6;  // pixels, one sigma
constexpr double k_along = 1.0;      // profiles are the mean of three lines this far apart, pixels
constexpr double k_step = 0.5;       // along a profile, pixels
// Error of an edge's place in a clean 8-bit picture, from sampling and neighbouring edges.
constexpr double k_least_sigma = 0.06;
// A clipped side is too dark, so the steepest place of a step to twice the limit is off by 0.4 of
// the blur's sigma, to ten times by 1.3.
constexpr double k_clipped_sigma = 0.6;

/// Adds the picture's bilinearly interpolated colour.
void add_bilinear(const cv::Mat& picture, double x, double y, cv::Vec3f& sum) {
    const double column = std::clamp(x - 0.5, 0.0, picture.cols - 1.001);
    const double row = std::clamp(y - 0.5, 0.0, picture.rows - 1.001);
    const int c = static_cast<int>(column), r = static_cast<int>(row);
    const float u = static_cast<float>(column - c), v = static_cast<float>(row - r);
    const float left_above = (1 - v) * (1 - u), right_above = (1 - v) * u;
    const float left_below = v * (1 - u), right_below = v * u;
    const float* above = picture.ptr<float>(r) + 3 * c;
    const float* below = picture.ptr<float>(r + 1) + 3 * c;
    for (int k = 0; k < 3; ++k) {
        sum[k] += left_above * above[k] + right_above * above[3 + k] + left_below * below[k] +
                  right_below * below[3 + k];
    }
}

float step_between(const cv::Vec3f& a, const cv::Vec3f& b) {
    const cv::Vec3f d = a - b;
    return std::sqrt(d.dot(d));
}

/// Centroid of the part of a peak above its foot; the maximum of the interpolated slope would stick
/// to pixels.
double middle_of_peak(const std::vector<float>& slope, std::size_t top) {
    const float foot = 0.25f * slope[top];
    std::size_t first = top, last = top;
    while (first > 0 && slope[first - 1] > foot && slope[first - 1] <= slope[first]) --first;
    while (last + 1 < slope.size() && slope[last + 1] > foot && slope[last + 1] <= slope[last])
        ++last;
    double weight = 0, sum = 0;
    for (std::size_t i = first; i <= last; ++i) {
        const double above = static_cast<double>(slope[i] - foot);
        weight += above;
        sum += above * static_cast<double>(i);
    }
    return sum / weight;
}

}  // namespace

EdgePicture::EdgePicture(const cv::Mat& colour, double saturation) {
    cv::GaussianBlur(colour, linear, {0, 0}, k_smoothing, k_smoothing, cv::BORDER_REPLICATE);
    cv::Mat shown = culet::encoded(colour);
    const double noise = noise_of(shown);
    cv::GaussianBlur(shown, encoded, {0, 0}, k_smoothing, k_smoothing, cv::BORDER_REPLICATE);
    // After smoothing and averaging along the edge the noise of three colours is about 0.5 of one
    // pixel's sigma. Four of these, and at least the rounding of eight bits.
    least_step = std::max(2.0 / 255, 4 * 0.5 * std::sqrt(2.0) * noise);
    if (saturation > 0) {
        clipped = brightest_channel(colour) >= 0.99 * saturation;
        cv::dilate(clipped, clipped, cv::Mat());
    }
}

std::vector<FoundEdge> edges_across(const EdgePicture& picture, const WirePoint& point,
                                    double reach) {
    const int half = static_cast<int>(std::ceil(reach / k_step)) + 4;
    const int count = 2 * half + 1;
    const auto across = [&](const cv::Mat& plane, std::size_t i) {
        const double t = (static_cast<double>(i) - half) * k_step;
        cv::Vec3f sum(0, 0, 0);
        for (const double s : {-k_along, 0.0, k_along}) {
            const double x = point.at.x + t * point.normal_x - s * point.normal_y;
            const double y = point.at.y + t * point.normal_y + s * point.normal_x;
            add_bilinear(plane, x, y, sum);
        }
        return sum * (1.0f / 3);
    };
    std::vector<cv::Vec3f> linear(static_cast<std::size_t>(count));
    for (std::size_t i = 0; i < linear.size(); ++i) linear[i] = across(picture.linear, i);
    // Encoded values are computed only beside peaks.
    const auto shown_step = [&](std::size_t i, std::size_t apart) {
        return static_cast<double>(
            step_between(across(picture.encoded, i + apart), across(picture.encoded, i - apart)));
    };
    // Slope per pixel.
    std::vector<float> slope(linear.size(), 0.0f);
    for (std::size_t i = 1; i + 1 < linear.size(); ++i)
        slope[i] = step_between(linear[i + 1], linear[i - 1]);
    std::vector<FoundEdge> found;
    for (std::size_t i = 3; i + 3 < slope.size(); ++i) {
        if (!(slope[i] > slope[i - 1] && slope[i] >= slope[i + 1])) continue;
        const double contrast = shown_step(i, 3);
        if (contrast < picture.least_step || shown_step(i, 1) < 0.5 * picture.least_step) continue;
        FoundEdge edge;
        edge.offset = (middle_of_peak(slope, i) - half) * k_step;
        if (std::abs(edge.offset) > reach) continue;
        edge.contrast = contrast;
        // A step's place has a sigma of about the blur's width over its signal-to-noise ratio.
        edge.sigma = std::hypot(k_least_sigma, 0.25 * picture.least_step / contrast);
        const double x = point.at.x + edge.offset * point.normal_x;
        const double y = point.at.y + edge.offset * point.normal_y;
        if (!picture.clipped.empty()) {
            const int column = std::clamp(static_cast<int>(x), 0, picture.clipped.cols - 1);
            const int row = std::clamp(static_cast<int>(y), 0, picture.clipped.rows - 1);
            if (picture.clipped.at<unsigned char>(row, column) != 0)
                edge.sigma = std::hypot(edge.sigma, k_clipped_sigma);
        }
        found.push_back(edge);
    }
    return found;
}

}  // namespace culet
