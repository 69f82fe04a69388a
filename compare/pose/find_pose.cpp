#include "compare/pose/find_pose.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "compare/pose/edge_evidence.h"
#include "compare/pose/pose_certainty.h"
#include "compare/pose/same_look.h"
#include "stone/numbers/units.h"

namespace culet {

namespace {

constexpr std::size_t k_settled = 8;  // refined to the end
constexpr std::size_t k_meant = 3;    // and symmetric views that the start means
// Symmetric poses whose log-likelihoods differ by less cannot be told apart; the one nearest to the
// start is taken.
constexpr double k_tie = 8;
// A view that the start means is preferred unless another symmetric one is likelier by more than
// this. Because of facet errors, small pictures of right stones prefer others by up to 23
// (bench_pose --as-taken --stone-px 200 400).
constexpr double k_not_meant = 25;
constexpr double k_near = radians(10);  // nearer views are the same view with other facet errors

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

/// Drops lost views, and those that converged to the same place as a better one.
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

/// Negative log prior of a view's angle to the start: sigma is half the search angle, and one start
/// in a thousand means another symmetric view.
double negative_log_prior(double start_angle, const PoseTask& task, bool symmetric = true) {
    const double far = 0.5 * std::pow(start_angle / (0.5 * task.options.search), 2);
    return symmetric ? std::min(far, std::log(1000.0)) : far;
}

/// Log-likelihood ratio of two symmetric views, from the edges met and the size of the facet errors
/// needed. (For normal errors of unknown size the likelihood is the size to the power of minus
/// their number.)
double lead_of(const Candidate& a, const Candidate& b) {
    const SolvedView &one = a.refined.solved, &other = b.refined.solved;
    const int tilts = std::min(one.tilts_found, other.tilts_found);
    return a.support.log_likelihood - b.support.log_likelihood +
           tilts * std::log(other.facet_error / one.facet_error);
}

/// Takes the likeliest symmetric pose by edges and start prior; among nearly equal ones one that is
/// not mirrored and nearest to the start.
void take_nearest_of_equals(const PoseTask& task, std::vector<Candidate>& best) {
    const auto start_angle = [](const Candidate& c) {
        return angle_between(c.refined.solved.view, c.side->start);
    };
    const auto lead = [&](const Candidate& a, const Candidate& b) {
        return lead_of(a, b) + negative_log_prior(start_angle(b), task) -
               negative_log_prior(start_angle(a), task);
    };
    std::vector<std::size_t> alike{0};
    std::size_t likeliest = 0;
    for (std::size_t i = 1; i < best.size(); ++i) {
        if (!looks_alike(task, best[0], best[i])) continue;
        alike.push_back(i);
        if (lead(best[i], best[likeliest]) > 0) likeliest = i;
    }
    std::size_t chosen = likeliest;
    const bool meant = start_angle(best[likeliest]) <= task.options.search;
    for (const std::size_t i : alike) {
        const bool preferred = !meant && start_angle(best[i]) <= task.options.search;
        if (lead(best[likeliest], best[i]) > (preferred ? k_not_meant : k_tie)) continue;
        if (nearer_to_start(best[i].side, best[i].refined.solved.view, best[chosen].side,
                            best[chosen].refined.solved.view))
            chosen = i;
    }
    std::rotate(best.begin(), best.begin() + static_cast<std::ptrdiff_t>(chosen),
                best.begin() + static_cast<std::ptrdiff_t>(chosen) + 1);
}

/// Adds nearby views that are not much less likely to the pose's uncertainty.
void widen(const Candidate& won, const Candidate& other, const TriedPose& tried, FoundPose& pose) {
    if (tried.mirrored != pose.mirrored || tried.turn > k_near || tried.lead > k_tie) return;
    const PicturePoint a = won.refined.solved.view.at, b = other.refined.solved.view.at;
    pose.sigmas.angle_99 = std::max(pose.sigmas.angle_99, tried.turn);
    pose.sigmas.shift_99_px = std::max(pose.sigmas.shift_99_px, std::hypot(a.x - b.x, a.y - b.y));
}

/// Log-likelihood ratio of the pose to another view, with the start prior; infinite for a view
/// within the pose's uncertainty, and for a symmetric one that the start cannot have meant.
double rivalry(const PoseTask& task, const FoundPose& pose, const TriedPose& other) {
    const bool within = other.mirrored == pose.mirrored && other.turn <= pose.sigmas.angle_99;
    if (within) return 1e300;
    if (other.symmetric &&
        (other.mirrored != pose.mirrored || other.start_angle > task.options.search))
        return 1e300;
    return other.lead + negative_log_prior(other.start_angle, task, other.symmetric) -
           negative_log_prior(pose.start_angle, task);
}

/// Warns if the edges alone prefer a symmetric view that the start does not mean.
void warn_of_look_alikes(const PoseTask& task, FoundPose& pose) {
    for (const TriedPose& other : pose.others) {
        if (!other.symmetric || other.mirrored != pose.mirrored || other.lead > -k_tie ||
            other.start_angle <= task.options.search)
            continue;
        pose.warnings.push_back(
            fmt::format("turned by {:.0f} degrees the stone looks nearly the same and fits the "
                        "photograph somewhat better: the view nearer to the scene's camera was "
                        "taken. If the stone was held the other way round, turn the scene's camera",
                        degrees(other.turn)));
        return;
    }
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
    pose.evidence = won.evidence;
    describe_sigmas(task, won, pose);
    describe_marks(won, pose);
    for (std::size_t i = 1; i < best.size(); ++i) {
        TriedPose other;
        other.camera = camera_of(best[i].refined.solved.view, task.start);
        other.mirrored = best[i].side->mirrored;
        other.turn = angle_between(best[i].refined.solved.view, solved.view);
        other.symmetric = looks_alike(task, won, best[i]);
        other.lead = other.symmetric ? lead_of(won, best[i])
                                     : won.support.log_likelihood - best[i].support.log_likelihood;
        other.log_odds = best[i].evidence.log_odds;
        other.start_angle = angle_between(best[i].refined.solved.view, best[i].side->start);
        widen(won, best[i], other, pose);
        if (other.symmetric && other.lead < k_tie) {
            if (other.mirrored != pose.mirrored)
                pose.chirality_known = false;
            else if (other.turn > k_near)
                ++pose.look_alikes;
        }
        pose.others.push_back(other);
    }
    double rival = 1e300, rival_turn = 0;
    for (const TriedPose& other : pose.others) {
        const double here = rivalry(task, pose, other);
        if (here >= rival) continue;
        rival = here;
        rival_turn = other.turn;
    }
    warn_of_look_alikes(task, pose);
    const std::vector<SeenView> images = images_of(task, won.side, solved.view);
    for (std::size_t i = 1; i < images.size(); ++i) {
        const StoneView& view = images[i].coarse.view;
        pose.others.push_back({camera_of(view, task.start), images[i].side->mirrored,
                               angle_between(view, solved.view), 0, true, won.evidence.log_odds,
                               angle_between(view, images[i].side->start)});
        if (images[i].side != won.side)
            pose.chirality_known = false;
        else
            ++pose.look_alikes;
    }
    assess(task, won, rival, rival_turn, pose);
}

void refine(const PoseTask& task, std::vector<Candidate>& candidates) {
    tbb::parallel_for(std::size_t{0}, candidates.size(), [&](std::size_t i) {
        Candidate& c = candidates[i];
        c.refined = refine_roughly(task.wire, c.side->picture, c.view, settings_of(task, *c.side));
        if (!c.refined.lost) c.support = support_of(task, *c.side, c.refined.solved.view);
    });
}

/// A small picture may fit slightly better from a symmetric view that the start does not mean: then
/// also refines the view that it means.
void add_meant_look_alikes(const PoseTask& task, std::vector<Candidate>& best) {
    std::vector<Candidate> meant;
    for (const Candidate& candidate : best) {
        const StoneView& view = candidate.refined.solved.view;
        if (angle_between(view, candidate.side->start) <= task.options.search) continue;
        if (const auto near = meant_look_alike(task, *candidate.side, view))
            meant.push_back({candidate.side, *near, {}, {}, {}});
        if (meant.size() >= k_meant) break;
    }
    refine(task, meant);
    best.insert(best.end(), meant.begin(), meant.end());
    best = distinct(std::move(best));
}

void choose(const PoseTask& task, std::vector<Candidate>& candidates, FoundPose& pose) {
    refine(task, candidates);
    report(task, 0.7);
    std::vector<Candidate> best = distinct(std::move(candidates));
    if (best.size() > k_settled) best.resize(k_settled);
    add_meant_look_alikes(task, best);
    tbb::parallel_for(std::size_t{0}, best.size(), [&](std::size_t i) {
        Candidate& c = best[i];
        c.refined = refine_fully(task.wire, c.side->picture, c.refined, settings_of(task, *c.side));
        if (c.refined.lost) return;
        c.support = support_of(task, *c.side, c.refined.solved.view);
        c.evidence = crown_evidence(c.side->picture, c.side->stone, c.refined.points,
                                    c.side->shape.diameter);
    });
    report(task, 0.95);
    best = distinct(std::move(best));
    if (best.empty()) {
        pose.trouble = "no view of this stone has its edges where the photograph has any";
        pose.remedy = fmt::format(
            "Check that this is the stone, from this side, and turn the scene's camera to within "
            "30 degrees of how the stone was held; --search-deg {:.0f} searches farther",
            std::min(180.0, 2 * degrees(task.options.search)));
        return;
    }
    take_nearest_of_equals(task, best);
    describe(task, best, pose);
}

FoundPose searched(PoseTask& task, const Photo& photo) {
    FoundPose pose;
    double saturation = 0;
    StoneSource source = stone_source(photo);
    source.colour = exposed(photo, saturation);
    const Silhouette silhouette = silhouette_of(source);
    pose.outline_source = silhouette.source;
    pose.diameter_px = silhouette.diameter;
    pose.camera = task.start;
    if (!silhouette.found()) {
        pose.trouble = silhouette.trouble;
        pose.remedy =
            "Give a photograph that shows the stone before a plain background, or paint "
            "the stone white in a mask and give it with --mask";
        return pose;
    }
    if (!silhouette.warning.empty()) pose.warnings.push_back(silhouette.warning);
    make_sides(task, source.colour, silhouette.mask, saturation);
    task.prior_focal_px = task.sides[0]->start.focal_px();
    std::vector<Candidate> candidates = coarse_candidates(task);
    choose(task, candidates, pose);
    return pose;
}

}  // namespace

FoundPose find_pose(const Photo& photo, const Solid& solid, const Camera& start,
                    const PoseOptions& given, const Progress& progress) {
    require_suitable(photo, solid, start);
    PoseOptions options = given;
    const Camera camera = start_for(start, photo.width, photo.height, options);
    PoseTask task{WireSolid(solid), {}, camera, options, progress, {}};
    task.symmetries = symmetries_of(task.wire);
    FoundPose pose;
    tbb::task_arena arena(options.threads > 0 ? options.threads : tbb::task_arena::automatic);
    arena.execute([&] { pose = searched(task, photo); });
    return pose;
}

}  // namespace culet
