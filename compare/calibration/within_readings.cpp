#include "compare/calibration/within_readings.h"

#include <cmath>
#include <limits>
#include <opencv2/core.hpp>

#include "compare/calibration/photo_blur.h"
#include "compare/calibration/photo_noise.h"
#include "compare/calibration/simulated_camera.h"
#include "compare/registration/frame.h"
#include "compare/scores/aligned_pair.h"
#include "render/colour/colour.h"

namespace culet {

namespace {

// Three of the bands' levels as a picture, blurred and registered with the photograph as the render
// is.
cv::Mat moved_levels(const AlignedPair& pair, const Photo& render, double psf_px,
                     const std::array<std::size_t, 3>& levels) {
    Photo picture;
    picture.width = render.width;
    picture.height = render.height;
    picture.coverage = render.coverage;
    for (std::size_t p = 0; p < render.bands.size() / 4; ++p) {
        for (const std::size_t level : levels) picture.rgb.push_back(render.bands[4 * p + level]);
    }
    return moved_as_render(pair.frame, softened(picture, psf_px));
}

double variance_of(double light, double white, const CameraModel& camera) {
    const double level = std::max(0.0, light / white);
    double variance = level / camera.electrons + std::pow(camera.read_noise / camera.electrons, 2);
    if (camera.bits > 0) {
        const double step = std::exp2(-camera.bits), shown = srgb_encoded(level);
        variance += std::pow(srgb_decoded(shown + step) - srgb_decoded(shown), 2) / 12;
    }
    return variance * white * white;
}

struct SeenLight {
    double value = 0, variance = 0;  ///< luminance
};

// The photograph's luminance in the render's units.
SeenLight light_in_render(const cv::Vec3f& photo, const AlignedPair& pair,
                          const CameraModel& camera) {
    SeenLight light;
    for (int c = 0; c < 3; ++c) {
        Rgb unit{0, 0, 0};
        unit[std::size_t(c)] = 1;
        const double share = luminance(unit) / pair.gain[std::size_t(c)];
        const double sample = double(photo[c]);
        light.value += share * sample;
        light.variance += share * share * variance_of(sample, pair.pictures.white, camera);
    }
    return light;
}

}  // namespace

std::optional<WithinReadings> within_readings(const AlignedPair& pair, const Photo& photo,
                                              const Photo& render) {
    if (render.bands.empty() || !pair.comparable()) return std::nullopt;
    const CameraModel camera = camera_of(photo, pair);
    const cv::Mat lower = moved_levels(pair, render, camera.psf_px, {0, 1, 2}),
                  upper = moved_levels(pair, render, camera.psf_px, {3, 3, 3});
    const cv::Mat& shown = pair.pictures.photo;
    WithinReadings result;
    result.map = {shown.cols, shown.rows, {}};
    for (int y = 0; y < shown.rows; ++y) {
        for (int x = 0; x < shown.cols; ++x) {
            float& value = result.map.values.emplace_back(std::numeric_limits<float>::quiet_NaN());
            if (pair.usable.at<unsigned char>(y, x) == 0) continue;
            const SeenLight light = light_in_render(shown.at<cv::Vec3f>(y, x), pair, camera);
            const auto& band = lower.at<cv::Vec3f>(y, x);
            const double middle = (double(band[1]) + double(band[2])) / 2;
            // The stone's spread and the camera's noise are independent.
            const auto is_within = [&](double low, double high, double sigmas) {
                const double noise = sigmas * std::sqrt(light.variance);
                return light.value >= middle - std::hypot(middle - low, noise) &&
                       light.value <= middle + std::hypot(high - middle, noise);
            };
            const bool one = is_within(double(band[1]), double(band[2]), 1),
                       two = is_within(double(band[0]), double(upper.at<cv::Vec3f>(y, x)[0]), 2);
            ++result.pixels;
            if (one) ++result.within_one;
            if (one || two) ++result.within_two;
            value = one ? 0.0f : two ? 0.5f : 1.0f;
        }
    }
    if (result.pixels == 0) return std::nullopt;
    result.within_one /= result.pixels;
    result.within_two /= result.pixels;
    return result;
}

}  // namespace culet
