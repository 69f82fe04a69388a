#include "compare/calibration/photo_noise.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "compare/calibration/photo_blur.h"
#include "compare/photo/pixels.h"
#include "compare/pose/picture_noise.h"
#include "compare/scores/chance.h"

namespace culet {

namespace {

constexpr double k_least_electrons = 100, k_most_electrons = 1e6;
// Shares of white: below, read noise exceeds shot noise; above, the file clips shot noise.
constexpr double k_dark = 0.02, k_bright = 0.9;
constexpr int k_least_pixels = 400;
constexpr int k_halvings = 12;
constexpr double k_least_psf_px = 0.3;  // blur by a camera's pixels alone
constexpr double k_psf_step_px = 0.1;
constexpr double k_steps_per_octave = 4;  // of electrons

// Where all three channels lie between `low` and `high`.
cv::Mat between(const cv::Mat& colour, double low, double high) {
    cv::Mat result;
    cv::inRange(colour, cv::Scalar::all(low), cv::Scalar::all(high), result);
    return result;
}

// Quantises roots of light like an sRGB file (IEC 61966-2-1, above its linear part), which for
// noise below one step differs from adding quantisation noise.
cv::Mat in_steps(const cv::Mat& root, int bits) {
    if (bits <= 0) return root;
    const double steps = std::ldexp(1.0, bits) - 1;
    cv::Mat code, result;
    cv::pow(cv::max(root, 0), 2 / 2.4, code);
    code.convertTo(code, CV_16U, 1.055 * steps, -0.055 * steps);
    code.convertTo(code, CV_32F, 1 / (1.055 * steps), 0.055 / 1.055);
    cv::pow(code, 2.4 / 2, result);
    return result;
}

// Noise of standard deviation 1, the same at each call.
cv::Mat unit_noise(cv::Size size) {
    Chance chance(1);
    cv::Mat noise(size, CV_32FC3);
    for (cv::Vec3f& pixel : cv::Mat_<cv::Vec3f>(noise)) {
        for (int i = 0; i < 3; ++i) pixel[i] = static_cast<float>(chance.normal());
    }
    return noise;
}

}  // namespace

double photo_electrons(const MatchedPictures& pictures, double psf_px, int bits) {
    const double white = pictures.white;
    const cv::Mat render = softened(pictures.render, psf_px);
    const cv::Mat inside = pictures.mask &
                           between(pictures.photo, k_dark * white, k_bright * white) &
                           between(render, k_dark * white, k_bright * white);
    if (cv::countNonZero(inside) < k_least_pixels) return k_most_electrons;
    const double wanted = noise_of(root_of(pictures.photo, white), inside);
    const cv::Mat root = root_of(render, white), unit = unit_noise(root.size());
    const auto seen = [&](double sigma) {
        return noise_of(in_steps(root + sigma * unit, bits), inside);
    };
    double low = 0, high = 1 / (2 * std::sqrt(k_least_electrons));
    if (!(wanted > seen(low))) return k_most_electrons;
    for (int i = 0; i < k_halvings; ++i) {
        const double middle = (low + high) / 2;
        (seen(middle) < wanted ? low : high) = middle;
    }
    return std::clamp(1 / (4 * low * low), k_least_electrons, k_most_electrons);
}

void set_blur_and_noise(CameraModel& camera, const MatchedPictures& pictures) {
    camera.psf_px = std::max(k_least_psf_px,
                             k_psf_step_px * std::round(photo_blur_px(pictures) / k_psf_step_px));
    const double electrons = photo_electrons(pictures, camera.psf_px, camera.bits);
    camera.electrons =
        std::exp2(std::round(k_steps_per_octave * std::log2(electrons)) / k_steps_per_octave);
}

CameraModel camera_of(const Photo& photo, const AlignedPair& pair) {
    CameraModel camera;
    camera.clips = photo.saturation > 0;
    camera.bits = bits_of(photo);
    const double white = pair.pictures.white;
    for (std::size_t c = 0; c < 3; ++c) camera.gain[c] = pair.gain[c] / white;
    set_blur_and_noise(camera, pair.pictures);
    const CloseUp& shown = pair.frame.photo;
    camera.outline_from_background = shown.silhouette.source == "background";
    // The median colour around the stone.
    const cv::Mat around = shown.silhouette.mask == 0;
    std::vector<cv::Mat> channels;
    cv::split(shown.colour, channels);
    for (std::size_t c = 0; c < 3; ++c) {
        camera.ground[c] = static_cast<float>(quantile(channels[c], around, 0.5) / white);
    }
    return camera;
}

}  // namespace culet
