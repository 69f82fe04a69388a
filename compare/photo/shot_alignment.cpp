#include "compare/photo/shot_alignment.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

#include "compare/photo/exposure_sum.h"
#include "compare/photo/pixels.h"
#include "stone/numbers/upper_median.h"

namespace culet {

namespace {

constexpr double k_dark = 0.004;       // of saturation
constexpr float k_most_shift = 0.125;  // of a side: a tripod that was knocked, not another view

cv::Mat log_of(const Photo& photo, double exposure) {
    cv::Mat plane = luminance(colour_of(photo)) / exposure;
    cv::Mat result;
    cv::log(cv::max(plane, 1e-12), result);
    return result;
}

// Where both shots are neither clipped nor dark.
cv::Mat well_exposed(const Photo& a, const Photo& b) {
    cv::Mat mask(a.height, a.width, CV_8U, cv::Scalar(0));
    const auto level = [](const Photo& p) { return p.saturation > 0 ? p.saturation : 1e30; };
    const cv::Mat ya = luminance(colour_of(a)), yb = luminance(colour_of(b));
    for (int y = 0; y < mask.rows; ++y) {
        for (int x = 0; x < mask.cols; ++x) {
            const std::size_t i = static_cast<std::size_t>(y) * mask.cols + x;
            const bool dark = ya.at<float>(y, x) < k_dark * std::min(level(a), 1.0) ||
                              yb.at<float>(y, x) < k_dark * std::min(level(b), 1.0);
            if (!dark && unclipped(a, i) > 0.5f && unclipped(b, i) > 0.5f)
                mask.at<unsigned char>(y, x) = 255;
        }
    }
    return mask;
}

// Subtracts the plane fitted under the mask.
cv::Mat without_slope(const cv::Mat& plane, const cv::Mat& mask) {
    const auto place = [&](int x, int y) {
        return cv::Vec3d(1, double(x) / plane.cols - 0.5, double(y) / plane.rows - 0.5);
    };
    cv::Matx33d normal = cv::Matx33d::zeros();
    cv::Vec3d right(0, 0, 0);
    for (int y = 0; y < plane.rows; ++y) {
        for (int x = 0; x < plane.cols; ++x) {
            if (mask.at<unsigned char>(y, x) == 0) continue;
            const cv::Vec3d at = place(x, y);
            normal += at * at.t();
            right += at * double(plane.at<float>(y, x));
        }
    }
    const cv::Vec3d slope = normal.solve(right, cv::DECOMP_SVD);
    cv::Mat result = plane.clone();
    for (int y = 0; y < plane.rows; ++y)
        for (int x = 0; x < plane.cols; ++x)
            result.at<float>(y, x) -= static_cast<float>(slope.dot(place(x, y)));
    return result;
}

// 1 for each pixel where the camera clips.
std::vector<float> clipped_pixels(const Photo& photo, float from) {
    std::vector<float> clipped(photo.rgb.size() / 3);
    for (std::size_t i = 0; i < clipped.size(); ++i)
        clipped[i] = unclipped(photo, i) <= from ? 1.0f : 0.0f;
    return clipped;
}

std::vector<float> values_of(const cv::Mat& plane) {
    const auto* first = plane.ptr<float>();
    return {first, first + plane.total() * static_cast<std::size_t>(plane.channels())};
}

}  // namespace

int factor_to(const Photo& photo, double pixels) {
    return static_cast<int>(std::ceil(
        std::sqrt(std::max(static_cast<double>(photo.width) * photo.height / pixels, 1.0))));
}

Photo reduced(const Photo& photo, int factor) {
    Photo result;
    result.saturation = photo.saturation;
    const cv::Size size(std::max(photo.width / factor, 1), std::max(photo.height / factor, 1));
    result.width = size.width;
    result.height = size.height;
    std::vector<float> clipped = clipped_pixels(photo, 0.5f);
    cv::Mat colour, over;
    cv::resize(colour_of(photo), colour, size, 0, 0, cv::INTER_AREA);
    cv::resize(cv::Mat(photo.height, photo.width, CV_32F, clipped.data()), over, size, 0, 0,
               cv::INTER_AREA);
    result.rgb = values_of(colour);
    result.saturated = values_of(over);
    return result;
}

Photo thinned(const Photo& photo, int step) {
    Photo result;
    result.saturation = photo.saturation;
    result.photometric = photo.photometric;
    result.not_photometric = photo.not_photometric;
    result.shot = photo.shot;
    result.encoding = photo.encoding;
    result.width = (photo.width + step - 1) / step;
    result.height = (photo.height + step - 1) / step;
    for (int y = 0; y < photo.height; y += step) {
        for (int x = 0; x < photo.width; x += step) {
            const std::size_t i = static_cast<std::size_t>(y) * photo.width + x;
            result.rgb.insert(result.rgb.end(), &photo.rgb[3 * i], &photo.rgb[3 * i] + 3);
            if (!photo.saturated.empty()) result.saturated.push_back(photo.saturated[i]);
        }
    }
    return result;
}

FrameShift shift_between(const Photo& a, double exposure_a, const Photo& b, double exposure_b) {
    const cv::Mat mask = well_exposed(a, b);
    if (cv::countNonZero(mask) < 400) return {};
    const cv::Mat first = log_of(a, exposure_a), second = log_of(b, exposure_b);
    cv::Mat warp = cv::Mat::eye(2, 3, CV_32F);
    for (int factor = 16; factor >= 1; factor /= 2) {
        if (std::min(first.cols, first.rows) / factor < 24) continue;
        cv::Mat small_a, small_b, small_mask;
        cv::resize(first, small_a, {}, 1.0 / factor, 1.0 / factor, cv::INTER_AREA);
        cv::resize(second, small_b, small_a.size(), 0, 0, cv::INTER_AREA);
        cv::resize(mask, small_mask, small_a.size(), 0, 0, cv::INTER_AREA);
        small_mask = small_mask > 200;
        // ECC's filter reaches two pixels: keep clipped ones away.
        cv::erode(small_mask, small_mask, cv::Mat(), {-1, -1}, 3, cv::BORDER_CONSTANT, {0});
        if (cv::countNonZero(small_mask) < 100) continue;
        // A mere gradient across the picture gives no shift.
        small_a = without_slope(small_a, small_mask);
        small_b = without_slope(small_b, small_mask);
        cv::Mat tried = warp.clone();
        tried.at<float>(0, 2) /= static_cast<float>(factor);
        tried.at<float>(1, 2) /= static_cast<float>(factor);
        try {
            const double fit = cv::findTransformECC(
                small_a, small_b, tried, cv::MOTION_TRANSLATION,
                cv::TermCriteria(cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 30, 1e-5),
                small_mask, 5);
            if (fit < 0.3) continue;
        } catch (const cv::Exception&) {
            continue;  // no structure at this size
        }
        if (std::abs(tried.at<float>(0, 2)) > k_most_shift * float(small_a.cols) ||
            std::abs(tried.at<float>(1, 2)) > k_most_shift * float(small_a.rows))
            continue;
        warp.at<float>(0, 2) = tried.at<float>(0, 2) * static_cast<float>(factor);
        warp.at<float>(1, 2) = tried.at<float>(1, 2) * static_cast<float>(factor);
    }
    return {warp.at<float>(0, 2), warp.at<float>(1, 2)};
}

void move_back(Photo& photo, const FrameShift& shift) {
    const cv::Matx23d matrix(1, 0, shift.x, 0, 1, shift.y);
    const auto warp = [&](std::vector<float>& values, int channels, int how) {
        cv::Mat from(photo.height, photo.width, CV_32FC(channels), values.data()), to;
        cv::warpAffine(from, to, matrix, from.size(), how | cv::WARP_INVERSE_MAP,
                       cv::BORDER_REPLICATE);
        const auto* first = to.ptr<float>();
        values.assign(first, first + to.total() * static_cast<std::size_t>(channels));
    };
    // Mark before resampling: the mean of a clipped pixel and its neighbour looks valid.
    if (photo.saturated.empty()) photo.saturated = clipped_pixels(photo, 0);
    warp(photo.rgb, 3, cv::INTER_LINEAR);
    warp(photo.saturated, 1, cv::INTER_LINEAR);
}

double light_ratio(const Photo& a, const Photo& b) {
    const cv::Mat mask = well_exposed(a, b);
    const cv::Mat ya = luminance(colour_of(a)), yb = luminance(colour_of(b));
    std::vector<double> ratios;
    for (int y = 0; y < mask.rows; ++y) {
        for (int x = 0; x < mask.cols; ++x) {
            const float u = ya.at<float>(y, x), v = yb.at<float>(y, x);
            if (mask.at<unsigned char>(y, x) != 0 && v > 0.02 && u > 0.02) ratios.push_back(u / v);
        }
    }
    return ratios.size() < 100 ? 0 : upper_median(std::move(ratios));
}

}  // namespace culet
