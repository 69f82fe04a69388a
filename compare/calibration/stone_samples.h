#pragma once
// The picture for facet tilts: the root of luminance, clipped at white and blurred, on a grid 192
// samples across the stone.

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "compare/calibration/draft_renderer.h"
#include "compare/calibration/simulated_camera.h"
#include "compare/scores/aligned_pair.h"

namespace culet {

constexpr double k_samples_across = 192;  // across the stone's diameter
constexpr double k_sample_blur = 0.008;   // share of the diameter
constexpr double k_softer = 1.4;          // a softer lens: times the photograph's blur
constexpr double k_inside = 0.025;        // least distance from the outline, share of the diameter

Scene sampled_scene(const Scene& model);

/// Where a model's samples lie, and its pictures at them.
struct StoneSamples {
    StoneSamples() = default;
    /// Draws one sketch of the stone.
    StoneSamples(const Scene& model, const DraftRenderer& renderer);

    Scene scene;                    ///< with the samples' camera
    double reduction = 1;           ///< samples a pixel of the model's own camera
    cv::Matx33d model_from_sample;  ///< pixels of the model's camera, centres at whole numbers
    std::optional<Photo> sketch;    ///< nothing: the stone is ray-traced
    cv::Mat outline_distance;       ///< CV_32F: distance inside the outline, samples; 0 outside
    cv::Size size() const { return outline_distance.size(); }

    /// A sketch seen by the photograph's camera, blurred by `blur` samples; black outside the
    /// stone, because the photograph's ground differs.
    cv::Mat sketched(const Photo& sketch, const CameraModel& camera, double blur) const;
    /// The model's picture through a lens of `psf_px`, blurred by `blur` samples, at its full
    /// resolution.
    cv::Mat fine_picture(const Photo& picture, const CameraModel& camera, double psf_px,
                         double blur) const;
    /// A fine picture at the samples.
    cv::Mat at_samples(const cv::Mat& fine) const;
};

/// A photograph aligned with the model's picture, for sampling.
struct SampledPhoto {
    SampledPhoto() = default;
    SampledPhoto(const AlignedPair& pair, const StoneSamples& samples);

    cv::Mat light, mask;  ///< of the close-up: root of light, and where it is usable
    double diameter = 0;
    cv::Matx33d close_up_from_sample;

    /// Blurred by `blur` of the diameter. `moved`: displacement of the samples.
    cv::Mat at_samples(cv::Size size, double blur,
                       const cv::Matx33d& moved = cv::Matx33d::eye()) const;
    /// Masks out samples where the photograph is not usable.
    void keep_usable(cv::Mat& samples, const cv::Matx33d& moved = cv::Matx33d::eye()) const;
};

std::vector<double> samples_of(const cv::Mat& plane, const cv::Mat& mask);

cv::Matx33d squared(const cv::Matx23d& m);

/// Nuisance directions: differences from the model's picture that facets do not cause, in order:
struct Nuisance {
    enum Of { exposure, stray_light, right, down, larger, turned, softer, k_linear, k_all = 10 };
};
/// Shift in pixels of the samples for a unit of `right` and `down`, and at the stone's outline for
/// a unit of `larger` and `turned`.
constexpr double k_moved_by_unit = 0.6;
/// `softer`: through a softer lens. The last three of `k_all` are the shift to second order.
std::vector<cv::Mat> nuisances_of(const cv::Mat& fine, const cv::Mat& softer,
                                  const StoneSamples& samples);

}  // namespace culet
