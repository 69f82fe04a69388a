#include "compare/calibration/scene_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "compare/calibration/calibrate.h"
#include "compare/calibration/calibration_cache.h"
#include "compare/calibration/calibration_plan.h"
#include "compare/calibration/cropped_camera.h"
#include "compare/calibration/draft_renderer.h"
#include "compare/calibration/photo_blur.h"
#include "compare/calibration/photo_noise.h"
#include "compare/calibration/pose_search.h"
#include "compare/calibration/within_readings.h"
#include "compare/photo/pixels.h"
#include "compare/scores/aligned_pair.h"
#include "compare/scores/scored_pair.h"
#include "render/uncertainty/picture_uncertainty.h"
#include "stone/numbers/units.h"
#include "stone/progress/part_of_progress.h"
#include "stone/solid/checks.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

constexpr double k_tolerance = 0.03;                             // of the compared pictures
constexpr double k_bar_for_pose = 0.2, k_bar_for_stones = 0.6;   // of the progress: their ends
constexpr double k_bar_for_tilts = 0.3, k_bar_for_scores = 0.4;  // of the calibration's
// The time budget in counted work (render/work/price.h). Finding the pose and scoring take a fixed
// time and a time per pixel, both measured.
constexpr double k_ns_per_second = 2e9, k_fixed_ns = 6e9, k_fixed_ns_per_pixel = 3;
// Shares of the budget for the photograph's own picture, and for the planning of the view search.
constexpr double k_for_picture = 0.15, k_for_search = 0.05;
// As k_sure_pose. In a calibration pose errors weigh as much as small facet errors.
constexpr double k_sure_to_calibrate = radians(0.3);
constexpr double k_farthest_search = radians(5.0);
// Of pictures that show only where it is bright and dark.
constexpr double k_search_tolerance = 0.1, k_search_cut = 0.02;

double fixed_ns(const Photo& photo) {
    return k_fixed_ns + k_fixed_ns_per_pixel * static_cast<double>(photo.width) * photo.height;
}

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

// Scores the photograph against a render as soft as itself, as the draws are scored, so that scores
// are comparable.
void compare_calibrated(SceneComparison& result, AlignedPair pair, const Photo& photo,
                        const DraftRenderer& fine, double allowed_ns, double view_sigma,
                        const SceneCompareOptions& options, const Progress& progress) {
    Scene model = with_coarse_environment(result.scene);
    const CalibrationPlan plan =
        plan_calibration(model, fine, options.draws, allowed_ns, photo.photometric);
    const DraftRenderer& renderer = plan.renderer;
    model.settings = renderer.settings();
    CalibrateOptions calibration;
    calibration.camera = camera_of(photo, pair);
    calibration.draws = plan.rounds;
    calibration.null_draws = 3 * plan.rounds;
    calibration.view_sigma = view_sigma;
    calibration.seed = options.compare.seed;
    calibration.threads = options.compare.threads;
    calibration.largest = options.largest;
    calibration.ignored = ignored_in_model(pair.frame, result.render);
    calibration.start = options.start;
    const CameraModel& camera = calibration.camera;

    const CalibrationCache cache(options.cache);
    auto kept = cache.find(calibration_hash(model, calibration));
    const FacetTilts tilts = kept         ? FacetTilts(model, renderer, camera, kept->tilts)
                             : plan.tilts ? FacetTilts(model, renderer, camera, calibration.threads,
                                                       part_of(progress, 0, k_bar_for_tilts))
                                          : FacetTilts(model, renderer, camera, TiltVariance());
    calibration.tilts = &tilts;

    pair = with_render(std::move(pair), softened(result.render, camera.psf_px));
    const CalibratedScoring scoring{camera.psf_px, tilts.facet_error_deg(pair, &result.render)};
    Comparison& comparison = result.comparison;
    comparison = scored(pair, photo, result.render, options.compare,
                        part_of(progress, k_bar_for_tilts, k_bar_for_scores), &scoring);

    Calibration made = kept ? std::move(kept->calibration)
                            : calibrate(model, renderer.picture(), renderer, calibration,
                                        part_of(progress, k_bar_for_scores, 1));
    if (!kept) {
        made.psf_px = camera.psf_px;
        made.electrons = camera.electrons;
        made.stone_px = pair.frame.render_diameter_px;
        if (!plan.tilts && photo.photometric)
            made.notes.push_back(
                "the budget left no time to try each facet's tilt: that score is missing (raise "
                "--budget)");
        cache.keep(made, tilts.variance());
    }
    result.calibrated =
        calibrated_verdict(comparison.scores, std::move(made), comparison.geometry_only);
    comparison.verdict = result.calibrated->verdict;
    comparison.reason = result.calibrated->headline;
}

/// The camera that took the photograph, and its uncertainty.
struct Standpoint {
    Camera camera;
    double sigma = 0;  // of the view, about either axis across the line of sight, radians
    double budget_ns = 0, worked_ns = 0;
    std::string note;
};

// Searches by the stone's picture, from the pose by its edges, or if that is not trusted from the
// scene's camera.
void search_further(const Photo& photo, const Scene& scene, const SceneCompareOptions& options,
                    SceneComparison& result, Standpoint& stand, const Progress& progress) {
    FoundPose& pose = *result.pose;
    Scene model = with_coarse_environment(scene);
    model.camera = camera_for(photo, pose.camera, model.stone.solid, options.largest);
    const DraftRenderer renderer =
        DraftRenderer(model, k_search_tolerance, k_for_search * stand.budget_ns)
            .coarser(model, k_search_cut);
    const auto searched = [&](const Camera& from, double reach, const Progress& part) {
        model.camera = from;
        return search_pose(photo, model, renderer,
                           {.reach = std::clamp(reach, k_sure_to_calibrate, k_farthest_search),
                            .threads = options.compare.threads},
                           part);
    };
    const bool doubted = !pose.usable();
    SearchedPose best = searched(pose.camera, doubted ? k_farthest_search : pose.sigmas.angle_99,
                                 part_of(progress, 0, doubted ? 0.5 : 1));
    bool scenes_own = false;
    if (doubted) {
        const SearchedPose other =
            searched(scene.camera, k_farthest_search, part_of(progress, 0.5, 1));
        scenes_own = other.agreement > best.agreement;
        if (scenes_own) best = other;
        stand.note = fmt::format(
            "{}. Views near that one and near the scene's camera were drawn; the one that "
            "agrees best lies {:.1f} degrees from {}. If that is not how the stone was held, turn "
            "the scene's camera to where it was and say --keep-pose",
            pose.trouble, degrees(best.moved),
            scenes_own ? "the scene's camera" : "the one that the edges show");
    } else {
        stand.note = fmt::format(
            "its edges show it to {:.2f} degrees (99 %); {} views within that were drawn, "
            "and the one that agrees best lies {:.2f} degrees from it",
            degrees(pose.sigmas.angle_99), best.drawn, degrees(best.moved));
    }
    result.pose_used = !scenes_own;
    pose.camera = stand.camera = best.camera;
    stand.sigma = k_searched_sigma;
    stand.worked_ns = renderer.worked_ns() + k_for_search * stand.budget_ns;
}

Standpoint find_standpoint(const Photo& photo, const Scene& scene,
                           const SceneCompareOptions& options, SceneComparison& result,
                           const Progress& progress) {
    Standpoint stand;
    stand.camera = scene.camera;
    stand.budget_ns = k_ns_per_second * options.budget_seconds;
    if (!options.find_pose) return stand;
    if (!is_convex(scene.stone.solid)) {
        stand.note =
            "only convex stones are found in a photograph, and this mesh is not convex (a "
            "fitted one is, unless the stone is not); the scene's own camera was taken instead";
        return stand;
    }
    PoseOptions pose_options;
    pose_options.threads = options.compare.threads;
    result.pose =
        find_pose(photo, scene.stone.solid, scene.camera, pose_options, part_of(progress, 0, 0.5));
    const FoundPose& pose = *result.pose;
    const double sure = options.calibrate ? k_sure_to_calibrate : k_sure_pose;
    if (pose.usable() && pose.sigmas.angle_99 <= sure) {
        result.pose_used = true;
        stand.camera = pose.camera;
        stand.sigma = std::hypot(pose.sigmas.turn[0], pose.sigmas.turn[1]) / std::sqrt(2.0);
    } else if (stone_diameter_px(photo) > 0) {
        search_further(photo, scene, options, result, stand, part_of(progress, 0.5, 1));
    } else {
        stand.note = pose.trouble + "; the scene's own camera was taken instead";
    }
    return stand;
}

}  // namespace

SceneComparison compare_with_scene(const Photo& photo, const Scene& scene,
                                   const SceneCompareOptions& options, const Progress& progress) {
    SceneComparison result;
    result.scene = scene;
    const Standpoint stand =
        find_standpoint(photo, scene, options, result, part_of(progress, 0, k_bar_for_pose));
    result.scene.camera = camera_for(photo, stand.camera, scene.stone.solid, options.largest);
    const DraftRenderer renderer(result.scene, k_tolerance, k_for_picture * stand.budget_ns);
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
    const AlignedPair pair = aligned(photo, result.render, options.largest);
    const Progress rest = part_of(progress, drawn, 1);
    if (options.calibrate && pair.comparable()) {
        const double left =
            (1 - k_for_picture) * stand.budget_ns - fixed_ns(photo) - stand.worked_ns;
        compare_calibrated(result, pair, photo, renderer,
                           stand.budget_ns > 0 ? std::max(left, 1.0) : 0, stand.sigma, options,
                           rest);
    } else {
        result.comparison = scored(pair, photo, result.render, options.compare, rest);
    }
    result.comparison.within = within_readings(pair, photo, result.render);
    result.comparison.pose_note = stand.note;
    return result;
}

}  // namespace culet
