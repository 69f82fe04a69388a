#include "compare/pose/pose_certainty.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "stone/numbers/units.h"
#include "stone/numbers/upper_median.h"

namespace culet {

namespace {

// 99 % quantiles in sigmas. The length of a vector of normal errors is below 2.6 times the root sum
// of its variances in 99 % of cases (2.58 for one axis, 2.15 for two, 1.94 for three). Mistaken
// edges are not normal: the normal equations ignore them, hence 4.4; groups of edges show them. For
// the place, 2.6 was too small for groups too.
constexpr double k_surely = 4.4, k_surely_by_groups = 2.6, k_place_by_groups = 3.3;

// Share of the stone's diameter.
constexpr double k_place = 0.03;
// Above this uncertainty the advice does not suggest --within-deg.
constexpr double k_farthest_deg = 45;
// Correction for trying many views: wrong proportions and pictures of other things reached evidence
// of up to 11 (bench_pose --fault all).
constexpr double k_places_tried = 8;

/// Evidence that the edges are the stone's: from whole edges, and from the z of the share of their
/// points met.
double evidence_of(const FoundPose& pose) {
    return pose.evidence.log_odds + 0.5 * pose.support_z * std::abs(pose.support_z);
}

std::string percent(double share) {
    return share < 0.01 ? fmt::format("{:.1g} %", 100 * share)
                        : fmt::format("{:.0f} %", 100 * share);
}

/// The median; 0 if there are none.
double middle_of(std::vector<double> values) {
    return values.empty() ? 0 : upper_median(std::move(values));
}

/// Keeps the first reason why a pose may not be used.
void refuse(std::string why, std::string remedy, FoundPose& pose) {
    if (!pose.trouble.empty()) return;
    pose.trouble = std::move(why);
    pose.remedy = std::move(remedy);
}

// Views beyond the search range can only be symmetric ones. Small irregularities chose this one,
// but the user asked for another.
void check_start(const PoseTask& task, const char* or_mirrored, FoundPose& pose) {
    if (pose.start_angle <= task.options.search) return;
    const double off = degrees(pose.start_angle);
    refuse(fmt::format("the likeliest view is {:.0f} degrees from the scene's camera, which may "
                       "be off by {:.0f}",
                       off, degrees(task.options.search)),
           fmt::format("See the overlay: if that is how the stone was held, turn the scene's "
                       "camera there, or use --search-deg {:.0f}; else turn it to within 10 "
                       "degrees of how it was held. Check that this is the stone{}",
                       std::min(180.0, std::ceil(off) + 1), or_mirrored),
           pose);
}

void check_outline(const PoseLimits& limits, double diameter, FoundPose& pose) {
    const double most = std::max(1.0, limits.outline_residual * diameter);
    if (pose.outline_px <= most) return;
    refuse(fmt::format("the stone's outline lies {:.1f} pixels from the photograph's (at most "
                       "{:.1f})",
                       pose.outline_px, most),
           "See the overlay: where the photograph's outline takes in a shadow or a holder, "
           "paint the stone white in a mask and give it with --mask; else the model is of "
           "another stone, or its widths are wrong",
           pose);
}

void check_probability(const PoseLimits& limits, double rival, double rival_turn,
                       const char* or_mirrored, FoundPose& pose) {
    const double by_chance = std::min(1.0, std::exp(k_places_tried - evidence_of(pose)));
    const double by_rival = rival < 700 ? 1 / (1 + std::exp(rival)) : 0;
    pose.error_probability = std::min(1.0, by_chance + by_rival);
    if (pose.error_probability <= limits.error_probability) return;
    if (by_chance >= by_rival) {
        refuse(
            fmt::format("{} of {} edges of the crown are where this model has them, {:.0f} by "
                        "chance: as many as in {} of wrong views (at most {} is allowed)",
                        pose.evidence.met, pose.evidence.looked,
                        pose.evidence.chance_share * pose.evidence.looked, percent(by_chance),
                        percent(limits.error_probability)),
            fmt::format("Check that this is the stone, from this side{}; then take it larger and "
                        "sharper, in a light that shows the edges around the table, or tilted "
                        "by 10 to 20 degrees; --doubt accepts more",
                        or_mirrored),
            pose);
    } else {
        refuse(
            fmt::format("another view, {:.0f} degrees from this one, explains the photograph "
                        "nearly as well: the chance that it is the right one is {} (at most {})",
                        degrees(rival_turn), percent(by_rival), percent(limits.error_probability)),
            fmt::format("Turn the scene's camera to within {:.0f} degrees of how the stone was "
                        "held and search no farther (--search-deg {:.0f}), or photograph it "
                        "tilted by 10 to 20 degrees; --doubt accepts more",
                        std::max(2.0, degrees(rival_turn) / 3),
                        std::max(2.0, degrees(rival_turn) / 2)),
            pose);
    }
}

void check_sigmas(const PoseLimits& limits, double diameter, FoundPose& pose) {
    if (!(pose.sigmas.angle_99 <= limits.angle)) {
        const double off = degrees(pose.sigmas.angle_99);
        refuse(
            fmt::format("the view may be off by {:.2f} degrees (at most {:.2f} are allowed)", off,
                        degrees(limits.angle)),
            fmt::format("{}ilt the stone by 10 to 20 degrees and take it larger; a model "
                        "fitted to more readings helps too",
                        off < k_farthest_deg
                            ? fmt::format("Accept that with --within-deg {:.2g}, or t", 1.1 * off)
                            : "T"),
            pose);
    }
    const double shift_limit =
        limits.shift_px > 0 ? limits.shift_px : std::max(1.0, k_place * diameter);
    if (!(pose.sigmas.shift_99_px <= shift_limit)) {
        refuse(fmt::format("the place may be off by {:.2f} pixels (at most {:.2f} are allowed)",
                           pose.sigmas.shift_99_px, shift_limit),
               fmt::format("Accept that with --within-px {:.2g}, or take the photograph sharper, "
                           "before a plain background; a model fitted to more readings helps too",
                           1.1 * pose.sigmas.shift_99_px),
               pose);
    }
}

}  // namespace

void describe_sigmas(const PoseTask& task, const Candidate& won, FoundPose& pose) {
    const SolvedView& solved = won.refined.solved;
    const auto variance = [&](int i, int j) {
        return solved.covariance[static_cast<std::size_t>(i * k_view_unknowns + j)];
    };
    // Large residuals increase the sigmas; small ones do not reduce them.
    std::vector<double> sizes;
    for (double r : solved.residuals) sizes.push_back(std::abs(r));
    const double spread = 1.4826 * middle_of(std::move(sizes));
    const double grown = std::max(1.0, spread);
    const auto sigma = [&](double v) { return grown * std::sqrt(std::max(0.0, v)); };
    PoseSigmas& sigmas = pose.sigmas;
    // The larger of the edges' sigmas and those of the jackknife.
    const std::array<double, 6> by_groups =
        variances_by_groups(task.wire, won.refined, settings_of(task, *won.side));
    const auto larger = [&](int k) {
        return std::max(sigma(variance(k, k)), std::sqrt(by_groups[static_cast<std::size_t>(k)]));
    };
    for (int k = 0; k < 3; ++k) sigmas.turn[static_cast<std::size_t>(k)] = larger(k);
    sigmas.angle = std::hypot(sigmas.turn[0], sigmas.turn[1], sigmas.turn[2]);
    sigmas.shift_px = {larger(3), larger(4)};
    sigmas.scale = larger(5);
    if (solved.view.nearness > 0) {
        sigmas.focal = sigma(variance(5, 5) + variance(6, 6) - 2 * variance(5, 6));
        if (task.options.principal_point_error > 0)
            sigmas.principal_point = sigma(std::max(variance(7, 7), variance(8, 8)));
    }
    const auto by_edges = [&](int k) { return sigma(variance(k, k)); };
    pose.angle_by_edges = std::hypot(by_edges(0), by_edges(1), by_edges(2));
    pose.angle_by_groups = std::sqrt(by_groups[0] + by_groups[1] + by_groups[2]);
    sigmas.angle_99 =
        std::max(k_surely * pose.angle_by_edges, k_surely_by_groups * pose.angle_by_groups);
    sigmas.shift_99_px = std::max(k_surely * std::hypot(by_edges(3), by_edges(4)),
                                  k_place_by_groups * std::sqrt(by_groups[3] + by_groups[4]));
    pose.facet_error = won.refined.facet_error;
    pose.facet_offset = won.refined.facet_offset;
}

void describe_marks(const Candidate& won, FoundPose& pose) {
    const double limit = 0.02 * won.side->shape.diameter;
    std::vector<double> outline, crown;
    for (const WirePoint& point : won.refined.points) {
        EdgeMark mark;
        mark.at = {point.at.x, point.at.y};
        mark.normal = {point.normal_x, point.normal_y};
        mark.outline = point.outline;
        double nearest = limit;
        for (const FoundEdge& edge : edges_across(won.side->picture, point, limit)) {
            if (std::abs(edge.offset) >= nearest) continue;
            nearest = std::abs(edge.offset);
            mark.offset_px = edge.offset;
        }
        mark.counted =
            mark.offset_px.has_value() && nearest < std::hypot(1.0, 1.5 * point.facet_sigma);
        if (mark.offset_px && (mark.outline || mark.counted))
            (mark.outline ? outline : crown).push_back(nearest);
        pose.marks.push_back(mark);
    }
    pose.outline_px = middle_of(std::move(outline));
    pose.crown_px = middle_of(std::move(crown));
}

void assess(const PoseTask& task, const Candidate& won, double rival, double rival_turn,
            FoundPose& pose) {
    const PoseLimits& limits = task.options.limits;
    const double diameter = won.side->shape.diameter;
    const char* const or_mirrored =
        task.sides.size() > 1 ? ""
                              : ", and that the picture is not mirrored (--mirrored tries both)";
    if (shows_other_side(task, won.refined.solved.view)) {
        refuse("the photograph shows the other side of the stone than the scene's camera",
               "Put the scene's camera on the side that the photograph shows: turn the sign of its "
               "position along the stone's axis",
               pose);
    }
    check_start(task, or_mirrored, pose);
    check_outline(limits, diameter, pose);
    check_probability(limits, rival, rival_turn, or_mirrored, pose);
    check_sigmas(limits, diameter, pose);
}

}  // namespace culet
