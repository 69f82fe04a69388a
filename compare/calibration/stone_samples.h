#pragma once
// The stone's picture as facets' tilts are read from it: the root of luminance, clipped at white
// and blurred, on samples 192 across the stone.

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "compare/calibration/draft_renderer.h"
#include "compare/calibration/simulated_camera.h"
#include "compare/scores/aligned_pair.h"

namespace culet {

constexpr double k_samples_across = 192;  // of the stone's diameter
constexpr double k_sample_blur = 0.008;   // of the diameter
constexpr double k_softer = 1.4;          // a softer lens: times the photograph's own blur
constexpr double k_inside = 0.025;        // least distance from the outline, of the diameter

/// The scene with the camera of the samples.
Scene sampled_scene(const Scene& model);

/// Where a model's samples lie, and its pictures on them.
struct StoneSamples {
    StoneSamples() = default;
    /// Sketches the stone once.
    StoneSamples(const Scene& model, const DraftRenderer& renderer);

    Scene scene;                    ///< with the camera of the samples
    double reduction = 1;           ///< samples a pixel of the model's own camera
    cv::Matx33d model_from_sample;  ///< pixels of the model's camera; centres at whole numbers
    std::optional<Photo> sketch;    ///< nothing: the stone is drawn by rays
    cv::Mat outline_distance;       ///< CV_32F: samples inside the outline; 0 outside
    cv::Size size() const { return outline_distance.size(); }

    /// A sketch as the photograph's camera would see it, blurred by `blur` samples; nothing of what
    /// is outside, which is another's ground.
    cv::Mat sketched(const Photo& sketch, const CameraModel& camera, double blur) const;
    /// The model's picture through the camera with a lens of `psf_px`, blurred by `blur` samples,
    /// as fine as it is drawn.
    cv::Mat fine_picture(const Photo& picture, const CameraModel& camera, double psf_px,
                         double blur) const;
    /// A fine picture at the samples' places.
    cv::Mat at_samples(const cv::Mat& fine) const;
};

/// A photograph that was aligned with the model's picture, for the samples.
struct SampledPhoto {
    SampledPhoto() = default;
    SampledPhoto(const AlignedPair& pair, const StoneSamples& samples);

    cv::Mat light, mask;  ///< of the close-up: root of light, and where it may be used
    double diameter = 0;
    cv::Matx33d close_up_from_sample;

    /// The photograph on the samples, blurred by a share of its diameter; `moved`: samples from
    /// where the photograph shows them.
    cv::Mat at_samples(cv::Size size, double blur,
                       const cv::Matx33d& moved = cv::Matx33d::eye()) const;
    /// Takes away what may not be used of it.
    void keep_usable(cv::Mat& samples, const cv::Matx33d& moved = cv::Matx33d::eye()) const;
};

std::vector<double> samples_of(const cv::Mat& plane, const cv::Mat& mask);

cv::Matx33d squared(const cv::Matx23d& m);

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
                                  const StoneSamples& samples);

}  // namespace culet
