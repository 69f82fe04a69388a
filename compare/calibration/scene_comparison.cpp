#include "compare/calibration/scene_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <opencv2/core.hpp>

#include "compare/calibration/calibrate.h"
#include "compare/calibration/calibration_cache.h"
#include "compare/calibration/cropped_camera.h"
#include "compare/calibration/draft_renderer.h"
#include "compare/calibration/photo_blur.h"
#include "compare/calibration/photo_noise.h"
#include "compare/calibration/within_readings.h"
#include "compare/photo/pixels.h"
#include "compare/scores/aligned_pair.h"
#include "compare/scores/scored_pair.h"
#include "render/uncertainty/picture_uncertainty.h"
#include "stone/checks.h"
#include "stone/errors.h"
#include "stone/part_of_progress.h"
#include "stone/units.h"

namespace culet {

namespace {

using Clock = std::chrono::steady_clock;

constexpr double k_margin = 0.18;     // of the diameter, around the stone
constexpr double k_tolerance = 0.03;  // of the pictures that are compared
// Of the time that is left: a stone of hundreds of facets must leave some for draws.
constexpr double k_most_for_tilts = 0.4;
constexpr double k_bar_for_pose = 0.1, k_bar_for_stones = 0.6;   // likewise
constexpr double k_bar_for_tilts = 0.2, k_bar_for_scores = 0.3;  // of the progress: their ends
// A pose is taken when it is sure (99 %) to two degrees, and to half a percent of the diameter:
// reflexes are matched within 2 %. Such poses are 0.2 degrees off in the median (bench_pose), which
// costs the scores what about 0.1 degrees of facet error cost; with one degree, three in four
// stones of 0.2 degrees of facet error would be left with the scene's camera, which is farther off.
constexpr double k_pose_angle = radians(2.0), k_pose_shift = 0.005;

// What a pose is off by less than this costs the scores nothing that shows.
constexpr double k_worth_saying = radians(0.1);

// What is left out, seen from the model's picture.
std::vector<float> ignored_in_model(const Frame& frame, const Photo& model) {
    if (frame.photo.ignored.empty()) return {};
    std::vector<float> result(
        static_cast<std::size_t>(model.width) * static_cast<std::size_t>(model.height), 0.0f);
    const cv::Mat& ignored = frame.photo.ignored;
    for (int y = 0; y < ignored.rows; ++y) {
        for (int x = 0; x < ignored.cols; ++x) {
            if (ignored.at<unsigned char>(y, x) == 0) continue;
            const cv::Point2d at =
                frame.render_from_photo(frame.photo.in_picture(cv::Point2d(x, y)));
            const int column = static_cast<int>(std::lround(at.x)),
                      row = static_cast<int>(std::lround(at.y));
            if (column < 0 || row < 0 || column >= model.width || row >= model.height) continue;
            result[static_cast<std::size_t>(row) * static_cast<std::size_t>(model.width) +
                   static_cast<std::size_t>(column)] = 1;
        }
    }
    return result;
}

// Against a render as soft as the photograph, as the draws are: a score is one thing in the
// photograph and in its calibration.
void compare_calibrated(SceneComparison& result, AlignedPair pair, const Photo& photo,
                        const DraftRenderer& renderer, const SceneCompareOptions& options,
                        const CompareOptions& how, Clock::time_point start,
                        const Progress& progress) {
    CalibrateOptions calibration;
    calibration.camera = camera_of(photo, pair);
    calibration.draws = options.draws;
    calibration.null_draws = 3 * options.draws;
    if (options.budget_seconds > 0) {
        calibration.deadline = start + std::chrono::duration_cast<Clock::duration>(
                                           std::chrono::duration<double>(options.budget_seconds));
    }
    calibration.seed = how.seed;
    calibration.threads = how.threads;
    calibration.largest = options.largest;
    calibration.ignored = ignored_in_model(pair.frame, result.render);
    calibration.start = options.start;
    const CameraModel& camera = calibration.camera;

    const CalibrationCache cache(options.cache);
    auto kept = cache.find(calibration_hash(result.scene, calibration));
    const auto begun = Clock::now();
    const std::chrono::duration<double> left = calibration.deadline - begun;
    const Progress of_tilts = part_of(progress, 0, k_bar_for_tilts);
    const FacetTilts tilts =
        kept ? FacetTilts(result.scene, renderer, camera, std::move(kept->tilts))
             : FacetTilts(result.scene, renderer, camera, calibration.threads, [&](double done) {
                   if (of_tilts && !of_tilts(done)) throw Interrupted();
                   return Clock::now() - begun < k_most_for_tilts * left;
               });
    calibration.tilts = &tilts;
    const double tilt_seconds = std::chrono::duration<double>(Clock::now() - begun).count();

    pair = with_render(std::move(pair), softened(result.render, camera.psf_px));
    const CalibratedScoring scoring{camera.psf_px, tilts.facet_error_deg(pair)};
    Comparison& comparison = result.comparison;
    comparison = scored(pair, photo, result.render, how,
                        part_of(progress, k_bar_for_tilts, k_bar_for_scores), &scoring);

    Calibration made = kept ? std::move(kept->calibration)
                            : calibrate(result.scene, result.render, renderer, calibration,
                                        part_of(progress, k_bar_for_scores, 1));
    if (!kept) {
        made.seconds += tilt_seconds;
        made.psf_px = camera.psf_px;
        made.electrons = camera.electrons;
        made.stone_px = pair.frame.render_diameter_px;
        if (tilts.ended_early()) {
            made.notes.push_back(
                "the budget left no time for what each facet's tilt changes: that score is "
                "missing");
        } else {
            cache.keep(made, tilts.variance());
        }
    }
    result.calibrated =
        calibrated_verdict(comparison.scores, std::move(made), comparison.geometry_only);
    comparison.verdict = result.calibrated->verdict;
    comparison.reason = result.calibrated->reason;
}

}  // namespace

SceneComparison compare_with_scene(const Photo& photo, const Scene& scene,
                                   const SceneCompareOptions& options, const Progress& progress) {
    const auto start = Clock::now();
    SceneComparison result;
    result.scene = scene;
    CompareOptions how = options.compare;
    how.largest = options.largest;
    std::vector<std::string> notes;

    if (options.find_pose && !is_convex(scene.stone.solid)) {
        notes.push_back(
            "pose: only convex stones are found in a photograph, and this mesh is not convex (a "
            "fitted one is, unless the stone is not); the scene's own camera was taken instead");
    } else if (options.find_pose) {
        PoseOptions pose_options;
        pose_options.mask = how.mask;
        pose_options.threads = how.threads;
        pose_options.limits.angle = k_pose_angle;
        pose_options.limits.shift_px =
            std::max(1.0, k_pose_shift * stone_diameter_px(photo, how.mask));
        result.pose = find_pose(photo, scene.stone.solid, scene.camera, pose_options,
                                part_of(progress, 0, k_bar_for_pose));
        if (result.pose->usable()) {
            result.pose_used = true;
            result.scene.camera = result.pose->camera;
            if (result.pose->sigmas.angle_99 > k_worth_saying) {
                notes.push_back(fmt::format(
                    "pose: known to {:.2f} degrees (99 %); what it is off counts as facet error, "
                    "0.5 degrees as 0.15 to 0.25",
                    degrees(result.pose->sigmas.angle_99)));
            }
        } else {
            notes.push_back("pose: " + result.pose->trouble +
                            "; the scene's own camera was taken instead. What to do: culet "
                            "register finds the pose by itself and takes options. " +
                            result.pose->remedy);
        }
    }

    const double across = stone_diameter_px(photo, how.mask);
    const double diameter = std::min(across > 0 ? across : options.largest, options.largest);
    result.scene.camera =
        cropped_to_stone(result.scene.camera, scene.stone.solid, diameter, k_margin);
    const DraftRenderer renderer(result.scene, k_tolerance);
    result.scene.settings = renderer.settings();
    result.stats = renderer.stats();
    result.render = renderer.picture();
    const double drawn = options.uncertainty ? k_bar_for_stones : k_bar_for_pose;
    if (options.uncertainty) {
        result.render.bands =
            picture_uncertainty(result.scene, plan_drawn(result.scene, result.stats),
                                *options.uncertainty, options.drawn_stones,
                                part_of(progress, k_bar_for_pose, drawn))
                .bands;
    }
    const AlignedPair pair =
        aligned(photo, how.mask, result.render, {.largest = how.largest, .ignored = how.ignored});
    const Progress rest = part_of(progress, drawn, 1);
    if (options.calibrate && pair.comparable()) {
        compare_calibrated(result, pair, photo, renderer, options, how, start, rest);
    } else {
        result.comparison = scored(pair, photo, result.render, how, rest);
    }
    result.comparison.within = within_readings(pair, photo, result.render);
    std::vector<std::string>& all_notes = result.comparison.notes;
    all_notes.insert(all_notes.end(), notes.begin(), notes.end());
    return result;
}

}  // namespace culet
