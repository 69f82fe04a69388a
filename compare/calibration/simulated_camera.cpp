#include "compare/calibration/simulated_camera.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "compare/calibration/photo_blur.h"
#include "compare/photo/pixels.h"
#include "compare/photo/resampling.h"
#include "compare/scores/chance.h"
#include "render/colour/colour.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

cv::Mat coverage_of(const Photo& photo) {
    return cv::Mat(photo.height, photo.width, CV_32F, const_cast<float*>(photo.coverage.data()));
}

double ninety_ninth(const Photo& stone) {
    const cv::Mat mask = coverage_of(stone) > 0.5f;
    return quantile(luminance(colour_of(stone)), mask, 0.99);
}

}  // namespace

double exposure_like(const Photo& stone, const Photo& model) {
    const double here = ninety_ninth(stone), there = ninety_ninth(model);
    return here > 0 && there > 0 ? there / here : 1;
}

Photo photographed(const Photo& stone, const CameraModel& camera, std::uint64_t seed) {
    check(!stone.coverage.empty(), "a picture without coverage cannot be photographed");
    Chance chance(seed);
    // The render's ground is light that passed beside the stone; the photograph's ground is known.
    cv::Mat exposed = colour_of(stone).clone(), coverage = coverage_of(stone);
    for (int y = 0; y < exposed.rows; ++y) {
        for (int x = 0; x < exposed.cols; ++x) {
            cv::Vec3f& v = exposed.at<cv::Vec3f>(y, x);
            const float c = coverage.at<float>(y, x);
            for (int i = 0; i < 3; ++i) {
                const auto k = static_cast<std::size_t>(i);
                const float lit = static_cast<float>(camera.gain[k]) * v[i];
                // A border pixel mixes stone and ground; the render's own ground is left out.
                v[i] = c * lit + (1 - c) * camera.ground[k];
            }
        }
    }
    const double scale = 1 + camera.scale_error * chance.uniform(-1, 1);
    const double dx = chance.uniform(-0.5, 0.5), dy = chance.uniform(-0.5, 0.5);
    const double mx = exposed.cols / 2.0, my = exposed.rows / 2.0;
    const cv::Matx23d from(scale, 0, mx - scale * mx + dx, 0, scale, my - scale * my + dy);
    const cv::Mat seen = softened(
        resampled(exposed, from, exposed.size(), Kernel::cubic, Beyond::nearest), camera.psf_px);

    Photo photo;
    photo.width = stone.width;
    photo.height = stone.height;
    photo.saturation = camera.clips ? 1 : 0;
    photo.encoding = "simulated";
    photo.rgb.resize(3 * seen.total());
    const double steps = camera.bits > 0 ? std::ldexp(1.0, camera.bits) - 1 : 0;
    std::size_t i = 0;
    for (int y = 0; y < seen.rows; ++y) {
        const float* row = seen.ptr<float>(y);
        for (int k = 0; k < 3 * seen.cols; ++k) {
            const double signal = std::max(0.0, static_cast<double>(row[k]));
            const double variance =
                signal / camera.electrons + std::pow(camera.read_noise / camera.electrons, 2);
            double value = std::max(0.0, signal + std::sqrt(variance) * chance.normal());
            if (camera.clips) value = std::min(1.0, value);
            if (steps > 0) {
                value =
                    srgb_decoded(std::round(srgb_encoded(std::min(value, 1.0)) * steps) / steps);
            }
            photo.rgb[i++] = static_cast<float>(value);
        }
    }
    if (!camera.outline_from_background) {
        const cv::Mat moved =
            resampled(coverage, from, coverage.size(), Kernel::linear, Beyond::nothing);
        photo.coverage.assign(moved.begin<float>(), moved.end<float>());
    }
    return photo;
}

}  // namespace culet
