#include "compare/pose/find_pose.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <opencv2/core.hpp>

#include "compare/pose/pose_certainty.h"
#include "compare/pose/same_look.h"
#include "stone/units.h"

namespace culet {

namespace {

constexpr std::size_t k_settled = 8;  // of the refined, to the end
// Poses that look alike by the stone's symmetry and are no likelier than this one than another
// cannot be told apart: the one nearest to the start is taken.
constexpr double k_tie = 8;

EdgeSupport support_of(const PoseTask& task, const PhotoSide& side, const StoneView& view) {
    WireSpacing spacing;
    spacing.facet_error = task.options.facet_error;
    spacing.facet_offset = expected_offset(task.wire, task.options.facet_error);
    spacing.most_facet_sigma = 0.01 * side.shape.diameter;
    return edge_support(side.picture, points_along(task.wire, view, spacing), side.shape.diameter);
}

void sort_by_likelihood(std::vector<Candidate>& candidates) {
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) {
                         return a.support.log_likelihood > b.support.log_likelihood;
                     });
}

/// Without those that were lost and those that ended where a better one did.
std::vector<Candidate> distinct(std::vector<Candidate> candidates) {
    sort_by_likelihood(candidates);
    std::vector<Candidate> kept;
    for (Candidate& candidate : candidates) {
        if (candidate.refined.lost) continue;
        const bool known = std::any_of(kept.begin(), kept.end(), [&](const Candidate& other) {
            return other.side == candidate.side &&
                   angle_between(other.refined.solved.view, candidate.refined.solved.view) <
                       radians(k_same_view_deg);
        });
        if (!known) kept.push_back(std::move(candidate));
    }
    return kept;
}

bool looks_alike(const PoseTask& task, const Candidate& a, const Candidate& b) {
    return look_alike(task.wire, a.refined.solved.view, b.refined.solved.view,
                      a.side->mirrored != b.side->mirrored);
}

/// Of poses that differ by the stone's symmetry and are about as likely, the one that is not
/// mirrored and nearest to the start comes first.
void take_nearest_of_equals(const PoseTask& task, std::vector<Candidate>& best) {
    std::size_t chosen = 0;
    const auto better = [&](const Candidate& a, const Candidate& b) {
        return nearer_to_start(a.side, a.refined.solved.view, b.side, b.refined.solved.view);
    };
    for (std::size_t i = 1; i < best.size(); ++i) {
        if (best[0].support.log_likelihood - best[i].support.log_likelihood > k_tie) break;
        if (looks_alike(task, best[0], best[i]) && better(best[i], best[chosen])) chosen = i;
    }
    std::rotate(best.begin(), best.begin() + static_cast<std::ptrdiff_t>(chosen),
                best.begin() + static_cast<std::ptrdiff_t>(chosen) + 1);
}

void describe(const PoseTask& task, const std::vector<Candidate>& best, FoundPose& pose) {
    const Candidate& won = best.front();
    const SolvedView& solved = won.refined.solved;
    pose.camera = camera_of(solved.view, task.start);
    pose.mirrored = won.side->mirrored;
    pose.start_angle = angle_between(solved.view, won.side->start);
    pose.start_scale = solved.view.scale / won.side->start.scale;
    pose.crown_support = won.support.met;
    pose.chance_support = won.support.chance;
    pose.support_z = won.support.z;
    describe_sigmas(task, won, pose);
    describe_marks(won, pose);
    double rival = 1e300;
    for (std::size_t i = 1; i < best.size(); ++i) {
        TriedPose other;
        other.camera = camera_of(best[i].refined.solved.view, task.start);
        other.mirrored = best[i].side->mirrored;
        other.turn = angle_between(best[i].refined.solved.view, solved.view);
        other.lead = won.support.log_likelihood - best[i].support.log_likelihood;
        other.symmetric = looks_alike(task, won, best[i]);
        if (!other.symmetric) rival = std::min(rival, other.lead);
        if (other.symmetric && other.mirrored != pose.mirrored && other.lead < k_tie)
            pose.chirality_known = false;
        pose.others.push_back(other);
    }
    const std::vector<SeenView> images = images_of(task, won.side, solved.view);
    for (std::size_t i = 1; i < images.size(); ++i) {
        const StoneView& view = images[i].coarse.view;
        pose.others.push_back({camera_of(view, task.start), images[i].side->mirrored,
                               angle_between(view, solved.view), 0, true});
        if (images[i].side != won.side) pose.chirality_known = false;
    }
    judge(task, won, rival, pose);
}

void choose(const PoseTask& task, std::vector<Candidate>& candidates, FoundPose& pose) {
    tbb::parallel_for(std::size_t{0}, candidates.size(), [&](std::size_t i) {
        Candidate& c = candidates[i];
        c.refined = draw_in(task.wire, c.side->picture, c.view, settings_of(task, *c.side));
        if (!c.refined.lost) c.support = support_of(task, *c.side, c.refined.solved.view);
    });
    report(task, 0.7);
    std::vector<Candidate> best = distinct(std::move(candidates));
    if (best.size() > k_settled) best.resize(k_settled);
    tbb::parallel_for(std::size_t{0}, best.size(), [&](std::size_t i) {
        Candidate& c = best[i];
        c.refined = settle(task.wire, c.side->picture, c.refined, settings_of(task, *c.side));
        if (!c.refined.lost) c.support = support_of(task, *c.side, c.refined.solved.view);
    });
    report(task, 0.95);
    best = distinct(std::move(best));
    if (best.empty()) {
        pose.trouble =
            "no view of this stone has its edges where the photograph has any: is it this "
            "stone, and is the start within 30 degrees?";
        return;
    }
    take_nearest_of_equals(task, best);
    describe(task, best, pose);
}

FoundPose searched(PoseTask& task, const Photo& photo) {
    FoundPose pose;
    double saturation = 0;
    const cv::Mat colour = exposed(photo, saturation);
    const Silhouette silhouette = silhouette_of(photo, task.options, colour);
    pose.outline_source = silhouette.source;
    pose.diameter_px = silhouette.diameter;
    pose.camera = task.start;
    if (!silhouette.found()) {
        pose.trouble = silhouette.trouble;
        return pose;
    }
    if (!silhouette.warning.empty()) pose.warnings.push_back(silhouette.warning);
    make_sides(task, colour, silhouette.mask, saturation);
    task.prior_focal_px = task.sides[0]->start.focal_px();
    std::vector<Candidate> candidates = coarse_candidates(task);
    choose(task, candidates, pose);
    return pose;
}

}  // namespace

FoundPose find_pose(const Photo& photo, const Solid& solid, const Camera& start,
                    const PoseOptions& options, const Progress& progress) {
    require_suitable(photo, solid, start, options);
    PoseTask task{WireSolid(solid), {},       resized_to(start, photo.width, photo.height),
                  options,          progress, {}};
    task.symmetries = symmetries_of(task.wire);
    FoundPose pose;
    tbb::task_arena arena(options.threads > 0 ? options.threads : tbb::task_arena::automatic);
    arena.execute([&] { pose = searched(task, photo); });
    return pose;
}

}  // namespace culet
