#include "compare/calibration/facet_tilts.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "compare/calibration/cropped_camera.h"
#include "compare/calibration/facet_error.h"
#include "compare/calibration/photo_blur.h"
#include "compare/photo/pixels.h"
#include "compare/photo/resampling.h"
#include "stone/checks.h"
#include "stone/units.h"

namespace culet {

namespace {

constexpr double k_diameter = 192;       // of the sketches' stone, pixels
constexpr double k_margin = 0.05;        // around it, of the diameter
constexpr double k_blur = 0.008;         // likewise
constexpr double k_inside = 0.025;       // of the outline, where blurs would bring in the ground
constexpr double k_nuisance_step = 0.3;  // pixels of the sketches
constexpr double k_softer = 1.4;         // times the photograph's own blur
// Of the angles by which facets are tilted. Changes are straight in the tilts up to about there;
// smaller ones drown in what a sketch leaves out.
constexpr double k_step_deg = 0.15;
// Of the root of light, beside what is not straight: 10000 electrons make 0.005 of noise in it.
constexpr double k_least_noise = 0.01;

// Root of luminance, each colour clipped at white.
cv::Mat root_light(const cv::Mat& colour, double white) {
    cv::Mat root = luminance(cv::min(cv::max(colour / white, 0), 1));
    cv::sqrt(root, root);
    return root;
}

cv::Mat exposed(const Photo& picture, const CameraModel& camera) {
    cv::Mat colour = colour_of(softened(picture, camera.psf_px)).clone();
    multiply_channels(colour, camera.gain);
    return colour;
}

cv::Mat coverage_of(const Photo& photo) {
    return cv::Mat(photo.height, photo.width, CV_32F, const_cast<float*>(photo.coverage.data()));
}

cv::Mat inside_of(const Photo& sketch) {
    return coverage_of(sketch) > 0.99f;
}

Scene small_of(const Scene& model) {
    Scene small = model;
    small.camera = cropped_to_stone(model.camera, model.stone.solid, k_diameter, k_margin);
    return small;
}

double reduction_of(const Scene& model) {
    return k_diameter / projected_diameter(model.stone.solid, model.camera);
}

// The model's picture through a lens, as fine as it is drawn.
cv::Mat fine_picture(const DraftRenderer& renderer, const CameraModel& camera, double psf_px,
                     double reduction) {
    CameraModel lens = camera;
    lens.psf_px = psf_px;
    return softened(root_light(exposed(renderer.picture(), lens), 1),
                    k_blur * k_diameter / reduction);
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

cv::Matx23d first_rows(const cv::Matx33d& m) {
    return {m(0, 0), m(0, 1), m(0, 2), m(1, 0), m(1, 1), m(1, 2)};
}

// Ways in which a photograph may differ from the model's picture that no facet is to blame for.
// Derivatives by whole steps of the fine picture: on the samples' own grid they would be a fifth
// too small where detail is finest, and what is left of a shift would look like tilts.
std::vector<cv::Mat> nuisances_of(const cv::Mat& fine, const cv::Mat& softer,
                                  const cv::Matx33d& fine_from_sample, cv::Size size) {
    const auto moved = [&](double x, double y, double scale, double turn) {
        const double mx = size.width / 2.0, my = size.height / 2.0;
        const cv::Matx33d map(1 + scale, -turn, x - scale * mx + turn * my, turn, 1 + scale,
                              y - scale * my - turn * mx, 0, 0, 1);
        return resampled(fine, first_rows(fine_from_sample * map), size, Kernel::cubic,
                         Beyond::nearest);
    };
    const double d = k_nuisance_step, around = 2 * k_nuisance_step / k_diameter;
    const cv::Mat still = moved(0, 0, 0, 0);
    const cv::Mat right = moved(d, 0, 0, 0), left = moved(-d, 0, 0, 0), down = moved(0, d, 0, 0),
                  up = moved(0, -d, 0, 0);
    return {// Exposure and stray light.
            still, cv::Mat(size, CV_32F, cv::Scalar(1)),
            // To first order, registration.
            right - left, down - up, moved(0, 0, around, 0) - moved(0, 0, -around, 0),
            moved(0, 0, 0, around) - moved(0, 0, 0, -around),
            // Blur, of light: through the root it brightens edges on either side.
            resampled(softer, first_rows(fine_from_sample), size, Kernel::cubic, Beyond::nearest) -
                still,
            // Shift to second order.
            right + left - 2 * still, down + up - 2 * still,
            moved(d, d, 0, 0) + moved(-d, -d, 0, 0) - moved(d, -d, 0, 0) - moved(-d, d, 0, 0)};
}

}  // namespace

std::optional<Photo> FacetTilts::lay_samples(const Scene& model, const Scene& small,
                                             const DraftRenderer& renderer,
                                             const CameraModel& camera) {
    const double reduction = reduction_of(model);
    const auto from = line_of_sight_in(small.camera), to = line_of_sight_in(model.camera);
    model_from_sample_ = cv::Matx33d::eye();
    for (int i = 0; i < 2; ++i) {
        const auto k = static_cast<std::size_t>(i);
        model_from_sample_(i, i) = 1 / reduction;
        model_from_sample_(i, 2) = (0.5 - from[k]) / reduction + to[k] - 0.5;
    }
    std::optional<Photo> first = renderer.sketch(small);
    if (!first) return std::nullopt;
    cv::Mat distance;
    cv::distanceTransform(inside_of(*first), distance, cv::DIST_L2, cv::DIST_MASK_PRECISE, CV_32F);
    mask_ = distance > k_inside * k_diameter;
    if (cv::countNonZero(mask_) < AlignedPair::k_least_pixels) return std::nullopt;
    // Of the picture itself, not of its sketch.
    fine_ = fine_picture(renderer, camera, camera.psf_px, reduction);
    picture_ = resampled(fine_, first_rows(model_from_sample_), mask_.size(), Kernel::cubic,
                         Beyond::nearest);
    return first;
}

FacetTilts::FacetTilts(const Scene& model, const DraftRenderer& renderer, const CameraModel& camera,
                       TiltVariance kept) {
    if (!is_convex(model.stone.solid)) return;
    lay_samples(model, small_of(model), renderer, camera);
    if (static_cast<std::size_t>(cv::countNonZero(mask_)) == kept.samples()) {
        variance_ = std::move(kept);
    }
}

FacetTilts::FacetTilts(const Scene& model, const DraftRenderer& renderer, const CameraModel& camera,
                       int threads, const Progress& progress) {
    const Solid& solid = model.stone.solid;
    if (!is_convex(solid)) return;
    const Scene small = small_of(model);
    const auto first = lay_samples(model, small, renderer, camera);
    if (!first) return;
    const double reduction = reduction_of(model);
    CameraModel reduced = camera;
    reduced.psf_px *= reduction;
    // What is outside is another's ground.
    const cv::Mat inside = inside_of(*first);
    const auto seen = [&](const Photo& sketch) {
        cv::Mat root = root_light(exposed(sketch, reduced), 1);
        root.setTo(0, ~inside);
        return softened(root, k_blur * k_diameter);
    };
    const cv::Mat untilted = seen(*first);
    const std::size_t tilts = 2 * solid.facets.size();
    TiltModel parts;
    parts.changes.resize(tilts);
    std::vector<std::vector<double>> bends(tilts);  // second differences
    const auto column = [&](std::size_t tilt) {
        cv::Mat either[2];
        for (const int side : {0, 1}) {
            Scene scene = small;
            const auto solid_there = with_facet_tilted(solid, tilt / 2, static_cast<int>(tilt % 2),
                                                       radians(side ? -k_step_deg : k_step_deg));
            if (solid_there) scene.stone.solid = *solid_there;
            either[side] = solid_there ? seen(*renderer.sketch(scene)) : untilted;
        }
        parts.changes[tilt] = samples_of((either[0] - either[1]) / (2 * k_step_deg), mask_);
        bends[tilt] = samples_of(either[0] + either[1] - 2 * untilted, mask_);
    };
    tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
    const auto batch = static_cast<std::size_t>(4 * arena.max_concurrency());
    for (std::size_t done = 0; done < tilts; done += batch) {
        if (progress && !progress(static_cast<double>(done) / static_cast<double>(tilts))) {
            ended_early_ = true;
            return;
        }
        arena.execute([&] { tbb::parallel_for(done, std::min(tilts, done + batch), column); });
    }
    const std::size_t samples = bends.front().size();
    parts.noise.assign(samples, k_least_noise * k_least_noise);
    for (const auto& bend : bends) {
        for (std::size_t i = 0; i < samples; ++i) parts.noise[i] += bend[i] * bend[i] / 2;
    }
    for (double& n : parts.noise) n = std::sqrt(n);
    const cv::Mat softer = fine_picture(renderer, camera, k_softer * camera.psf_px, reduction);
    for (const cv::Mat& nuisance : nuisances_of(fine_, softer, model_from_sample_, mask_.size())) {
        parts.nuisances.push_back(samples_of(nuisance, mask_));
    }
    variance_ = TiltVariance(parts);
}

std::optional<double> FacetTilts::facet_error_deg(const AlignedPair& pair) const {
    if (!usable() || !pair.enough()) return std::nullopt;
    const Frame& frame = pair.frame;
    const MatchedPictures& pictures = pair.pictures;
    const cv::Mat seen =
        softened(root_light(pictures.photo, pictures.white), k_blur * pictures.diameter);
    const double scale = frame.photo.scale;
    const cv::Matx33d close_up_from_photo(scale, 0, scale * (0.5 - frame.photo.corner.x) - 0.5, 0,
                                          scale, scale * (0.5 - frame.photo.corner.y) - 0.5, 0, 0,
                                          1);
    const cv::Matx33d photo_from_model = squared(matrix_of(frame.render_from_photo)).inv();
    const cv::Matx23d close_up_from_sample =
        first_rows(close_up_from_photo * photo_from_model * model_from_sample_);
    cv::Mat difference =
        resampled(seen, close_up_from_sample, mask_.size(), Kernel::cubic, Beyond::nearest) -
        picture_;
    difference.setTo(0, resampled_mask(pictures.mask, close_up_from_sample, mask_.size()) == 0);
    // Each of a facet's two tilts has half the facet error's variance.
    const auto rms = variance_.rms(samples_of(difference, mask_));
    return rms ? std::optional(std::sqrt(2.0) * *rms) : std::nullopt;
}

}  // namespace culet
