#pragma once
// The stone's picture as facets' tilts are read from it: the root of luminance, clipped at white
// and blurred, on samples 192 across the stone.

#include <opencv2/core/mat.hpp>
#include <vector>

#include "compare/calibration/draft_renderer.h"
#include "compare/calibration/simulated_camera.h"
#include "compare/registration/frame.h"

namespace culet {

constexpr double k_samples_across = 192;  // of the stone's diameter
constexpr double k_sample_blur = 0.008;   // of the diameter
constexpr double k_softer = 1.4;          // a softer lens: times the photograph's own blur
constexpr double k_inside = 0.025;        // least distance from the outline, of the diameter

/// Root of luminance, each colour clipped at white.
cv::Mat root_light(const cv::Mat& colour, double white);

/// The picture as the camera would expose it, through its lens.
cv::Mat exposed(const Photo& picture, const CameraModel& camera);

/// CV_8U: samples wholly inside the stone's outline.
cv::Mat inside_of(const Photo& sketch);

/// The scene with the camera of the samples.
Scene sampled_scene(const Scene& model);
/// Samples a pixel of the model's own camera.
double sample_reduction(const Scene& model);
/// Pixels of the model's camera from samples; centres at whole numbers.
cv::Matx33d model_from_samples(const Scene& model, const Scene& sampled);

/// Pixels of a photograph's close-up from those of the model, as they were aligned.
cv::Matx33d close_up_from_model(const Frame& frame);

/// A model's picture through a lens of `psf_px` and blurred by `blur` (pixels), as fine as it is
/// drawn.
cv::Mat fine_picture(const Photo& picture, const CameraModel& camera, double psf_px, double blur);

std::vector<double> samples_of(const cv::Mat& plane, const cv::Mat& mask);

cv::Matx33d squared(const cv::Matx23d& m);
cv::Matx23d first_rows(const cv::Matx33d& m);

/// Ways in which a photograph may differ from the model's picture that no facet is to blame for, in
/// this order.
struct Nuisance {
    enum Of { exposure, stray_light, right, down, larger, turned, softer, k_linear, k_all = 10 };
};
/// Pixels of samples by which the unit of `right` and `down` moves the picture, and by which that
/// of `larger` and `turned` does at the stone's outline.
constexpr double k_moved_by_unit = 0.6;
/// `softer`: the fine picture through a softer lens. Of `k_all` the last three are the shift to
/// second order.
std::vector<cv::Mat> nuisances_of(const cv::Mat& fine, const cv::Mat& softer,
                                  const cv::Matx33d& fine_from_sample, cv::Size size);

}  // namespace culet
