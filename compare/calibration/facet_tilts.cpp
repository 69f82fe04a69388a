#include "compare/calibration/facet_tilts.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "compare/calibration/facet_error.h"
#include "compare/photo/in_batches.h"
#include "stone/numbers/units.h"
#include "stone/solid/checks.h"

namespace culet {

namespace {

// Tilt angle of the sketches. Changes are linear up to about here; smaller ones drown in what a
// sketch leaves out.
constexpr double k_step_deg = 0.15;
// Noise of the root of light beside the non-linearity: 10000 electrons give 0.005.
constexpr double k_least_noise = 0.01;
constexpr double k_blur = k_sample_blur * k_samples_across;

}  // namespace

cv::Mat FacetTilts::seen_finely(const Photo& picture, double psf_px) const {
    return samples_.fine_picture(picture, camera_, psf_px, k_blur);
}

cv::Mat FacetTilts::at_samples(const Photo& picture) const {
    return samples_.at_samples(seen_finely(picture, camera_.psf_px));
}

bool FacetTilts::lay_samples(const Scene& model, const DraftRenderer& renderer) {
    if (!is_convex(model.stone.solid)) return false;
    samples_ = StoneSamples(model, renderer);
    if (!samples_.sketch) return false;
    mask_ = samples_.outline_distance > k_inside * k_samples_across;
    if (cv::countNonZero(mask_) < AlignedPair::k_least_pixels) return false;
    // From the picture itself, not its sketch.
    picture_ = at_samples(renderer.picture());
    return true;
}

FacetTilts::FacetTilts(const Scene& model, const DraftRenderer& renderer, const CameraModel& camera,
                       TiltVariance kept)
    : camera_(camera) {
    if (!lay_samples(model, renderer)) return;
    if (static_cast<std::size_t>(cv::countNonZero(mask_)) == kept.samples()) {
        variance_ = std::move(kept);
    }
}

FacetTilts::FacetTilts(const Scene& model, const DraftRenderer& renderer, const CameraModel& camera,
                       int threads, const Progress& progress)
    : camera_(camera) {
    if (!lay_samples(model, renderer)) return;
    const Solid& solid = model.stone.solid;
    const auto seen = [&](const Photo& sketch) {
        return samples_.sketched(sketch, camera_, k_blur);
    };
    const cv::Mat untilted = seen(*samples_.sketch);
    const std::size_t tilts = 2 * solid.facets.size();
    TiltModel parts;
    parts.changes.resize(tilts);
    std::vector<std::vector<double>> second_differences(tilts);
    const auto column = [&](std::size_t tilt) {
        cv::Mat either[2];
        for (const int side : {0, 1}) {
            Scene scene = samples_.scene;
            const auto solid_there = with_facet_tilted(solid, tilt / 2, static_cast<int>(tilt % 2),
                                                       radians(side ? -k_step_deg : k_step_deg));
            if (solid_there) scene.stone.solid = *solid_there;
            either[side] = solid_there ? seen(*renderer.sketch(scene)) : untilted;
        }
        parts.changes[tilt] = samples_of((either[0] - either[1]) / (2 * k_step_deg), mask_);
        second_differences[tilt] = samples_of(either[0] + either[1] - 2 * untilted, mask_);
    };
    in_batches(tilts, threads, progress, column);
    const std::size_t samples = second_differences.front().size();
    parts.noise.assign(samples, k_least_noise * k_least_noise);
    for (const auto& values : second_differences) {
        for (std::size_t i = 0; i < samples; ++i) parts.noise[i] += values[i] * values[i] / 2;
    }
    for (double& n : parts.noise) n = std::sqrt(n);
    const cv::Mat fine = seen_finely(renderer.picture(), camera.psf_px),
                  softer = seen_finely(renderer.picture(), k_softer * camera.psf_px);
    for (const cv::Mat& nuisance : nuisances_of(fine, softer, samples_)) {
        parts.nuisances.push_back(samples_of(nuisance, mask_));
    }
    variance_ = TiltVariance(parts);
}

std::optional<double> FacetTilts::facet_error_deg(const AlignedPair& pair,
                                                  const Photo* picture) const {
    if (!usable() || !pair.enough()) return std::nullopt;
    const SampledPhoto photo(pair, samples_);
    cv::Mat difference = photo.at_samples(mask_.size(), k_sample_blur) -
                         (picture != nullptr ? at_samples(*picture) : picture_);
    photo.keep_usable(difference);
    // Each of a facet's two tilts has half the facet error's variance.
    const auto rms = variance_.rms(samples_of(difference, mask_));
    return rms ? std::optional(std::sqrt(2.0) * *rms) : std::nullopt;
}

}  // namespace culet
