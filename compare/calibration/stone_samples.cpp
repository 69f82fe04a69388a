#include "compare/calibration/stone_samples.h"

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "compare/calibration/cropped_camera.h"
#include "compare/calibration/photo_blur.h"
#include "compare/photo/pixels.h"
#include "compare/photo/resampling.h"

namespace culet {

namespace {

constexpr double k_sample_margin = 0.05;  // around the stone, of the diameter
constexpr double k_nuisance_step = k_moved_by_unit / 2;

cv::Matx23d first_rows(const cv::Matx33d& m) {
    return {m(0, 0), m(0, 1), m(0, 2), m(1, 0), m(1, 1), m(1, 2)};
}

// Root of luminance, with each colour clipped at white.
cv::Mat root_light(const cv::Mat& colour, double white) {
    cv::Mat root = luminance(cv::min(cv::max(colour / white, 0), 1));
    cv::sqrt(root, root);
    return root;
}

// Applies the camera's lens and exposure.
cv::Mat root_seen(const Photo& picture, const CameraModel& camera, double psf_px) {
    cv::Mat colour = colour_of(softened(picture, psf_px)).clone();
    multiply_channels(colour, camera.gain);
    return root_light(colour, 1);
}

cv::Matx33d close_up_from_model(const Frame& frame) {
    const double scale = frame.photo.scale;
    const cv::Matx33d close_up_from_photo(scale, 0, scale * (0.5 - frame.photo.corner.x) - 0.5, 0,
                                          scale, scale * (0.5 - frame.photo.corner.y) - 0.5, 0, 0,
                                          1);
    return close_up_from_photo * squared(matrix_of(frame.render_from_photo)).inv();
}

}  // namespace

Scene sampled_scene(const Scene& model) {
    Scene sampled = model;
    sampled.camera =
        cropped_to_stone(model.camera, model.stone.solid, k_samples_across, k_sample_margin);
    return sampled;
}

StoneSamples::StoneSamples(const Scene& model, const DraftRenderer& renderer)
    : scene(sampled_scene(model)),
      reduction(k_samples_across / projected_diameter(model.stone.solid, model.camera)),
      model_from_sample(cv::Matx33d::eye()),
      sketch(renderer.sketch(scene)) {
    const auto from = line_of_sight_in(scene.camera), to = line_of_sight_in(model.camera);
    for (int i = 0; i < 2; ++i) {
        const auto k = static_cast<std::size_t>(i);
        model_from_sample(i, i) = 1 / reduction;
        model_from_sample(i, 2) = (0.5 - from[k]) / reduction + to[k] - 0.5;
    }
    if (!sketch) return;
    const cv::Mat coverage(sketch->height, sketch->width, CV_32F, sketch->coverage.data());
    cv::distanceTransform(coverage > 0.99f, outline_distance, cv::DIST_L2, cv::DIST_MASK_PRECISE,
                          CV_32F);
}

cv::Mat StoneSamples::sketched(const Photo& picture, const CameraModel& camera, double blur) const {
    cv::Mat root = root_seen(picture, camera, camera.psf_px * reduction);
    root.setTo(0, outline_distance <= 0);
    return softened(root, blur);
}

cv::Mat StoneSamples::fine_picture(const Photo& picture, const CameraModel& camera, double psf_px,
                                   double blur) const {
    return softened(root_seen(picture, camera, psf_px), blur / reduction);
}

cv::Mat StoneSamples::at_samples(const cv::Mat& fine) const {
    return resampled(fine, first_rows(model_from_sample), size(), Kernel::cubic, Beyond::nearest);
}

SampledPhoto::SampledPhoto(const AlignedPair& pair, const StoneSamples& samples)
    : light(root_light(pair.pictures.photo, pair.pictures.white)),
      mask(pair.pictures.mask),
      diameter(pair.pictures.diameter),
      close_up_from_sample(close_up_from_model(pair.frame) * samples.model_from_sample) {}

cv::Mat SampledPhoto::at_samples(cv::Size size, double blur, const cv::Matx33d& moved) const {
    return resampled(softened(light, blur * diameter), first_rows(close_up_from_sample * moved),
                     size, Kernel::cubic, Beyond::nearest);
}

void SampledPhoto::keep_usable(cv::Mat& samples, const cv::Matx33d& moved) const {
    samples.setTo(
        0, resampled_mask(mask, first_rows(close_up_from_sample * moved), samples.size()) == 0);
}

std::vector<double> samples_of(const cv::Mat& plane, const cv::Mat& mask) {
    std::vector<double> values;
    for (int y = 0; y < mask.rows; ++y) {
        for (int x = 0; x < mask.cols; ++x) {
            if (mask.at<unsigned char>(y, x)) {
                values.push_back(static_cast<double>(plane.at<float>(y, x)));
            }
        }
    }
    return values;
}

cv::Matx33d squared(const cv::Matx23d& m) {
    return {m(0, 0), m(0, 1), m(0, 2), m(1, 0), m(1, 1), m(1, 2), 0, 0, 1};
}

// Derivatives by whole steps of the fine picture. On the samples' grid they would be a fifth too
// small for the finest detail, and the rest of a shift would look like tilts.
std::vector<cv::Mat> nuisances_of(const cv::Mat& fine, const cv::Mat& softer,
                                  const StoneSamples& samples) {
    const cv::Size size = samples.size();
    const auto moved = [&](double x, double y, double scale, double turn) {
        const double mx = size.width / 2.0, my = size.height / 2.0;
        const cv::Matx33d map(1 + scale, -turn, x - scale * mx + turn * my, turn, 1 + scale,
                              y - scale * my - turn * mx, 0, 0, 1);
        return resampled(fine, first_rows(samples.model_from_sample * map), size, Kernel::cubic,
                         Beyond::nearest);
    };
    const double d = k_nuisance_step, around = 2 * k_nuisance_step / k_samples_across;
    const cv::Mat still = moved(0, 0, 0, 0);
    const cv::Mat right = moved(d, 0, 0, 0), left = moved(-d, 0, 0, 0), down = moved(0, d, 0, 0),
                  up = moved(0, -d, 0, 0);
    return {// Exposure and stray light.
            still, cv::Mat(size, CV_32F, cv::Scalar(1)),
            // Registration to first order.
            right - left, down - up, moved(0, 0, around, 0) - moved(0, 0, -around, 0),
            moved(0, 0, 0, around) - moved(0, 0, 0, -around),
            // Blur of light, which after the root brightens edges on both sides.
            samples.at_samples(softer) - still,
            // Shift to second order.
            right + left - 2 * still, down + up - 2 * still,
            moved(d, d, 0, 0) + moved(-d, -d, 0, 0) - moved(d, -d, 0, 0) - moved(-d, d, 0, 0)};
}

}  // namespace culet
