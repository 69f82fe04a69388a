#include "compare/pose/find_pose.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <memory>
#include <opencv2/core.hpp>

#include "compare/pixels.h"
#include "compare/pose/coarse_search.h"
#include "compare/pose/edge_support.h"
#include "compare/pose/refine_view.h"
#include "compare/pose/same_look.h"
#include "compare/silhouette.h"
#include "stone/checks.h"
#include "stone/errors.h"
#include "stone/units.h"

namespace culet {

namespace {

constexpr int k_views_each = 12;  // of the coarse search, of either chirality
constexpr int k_turned_from = 3;  // of these, turned all round
constexpr int k_turned_each = 8;
constexpr std::size_t k_refined = 24;  // refined, and of these ...
constexpr std::size_t k_settled = 8;   // ... to the end
constexpr double k_same_view_deg = 0.4;
// Lengths of vectors of normal errors are below 2.6 times the root of the sum of their variances in
// 99 of 100 cases, whatever the share of each axis (2.58 for one axis, 2.15 for two, 1.94 for
// three). Edges that were mistaken for the stone's are no normal errors: over 23 trials of
// bench_pose (17 of 400 pixels with facets off by 0.2 degrees, 6 of 800 with exact ones) the worst
// error was 4.3 times.
constexpr double k_surely = 4.4;
constexpr double k_edge_reach = 0.012;  // of the edge map, of the diameter
// Poses that look alike by the stone's symmetry and are no likelier than this one than another
// cannot be told apart: the one nearest to the start is taken.
constexpr double k_tie = 8;

/// One photograph as it is, or turned left to right.
struct Side {
    Side(const cv::Mat& colour, const cv::Mat& mask, double saturation, const Camera& start_camera,
         const Vec3& middle, bool mirrored_)
        : mirrored(mirrored_),
          shape(outline_shape(mask)),
          map(colour, mask, shape.diameter, k_edge_reach),
          picture(colour, saturation) {
        Camera camera = start_camera;
        if (mirrored && camera.principal_point)
            (*camera.principal_point)[0] = camera.width - (*camera.principal_point)[0];
        start = stone_view(camera, middle);
    }
    bool mirrored;
    OutlineShape shape;
    EdgeMap map;
    EdgePicture picture;
    StoneView start;
};

struct Candidate {
    const Side* side = nullptr;
    StoneView view;
    RefinedView refined;
    EdgeSupport support;
};

void require_suitable(const Photo& photo, const Solid& solid, const Camera& start,
                      const PoseOptions& options) {
    if (start.cone)
        throw InputError("a conoscope shows directions, not the stone: no pose to find");
    if (start.optics.two_windows)
        throw InputError("a dichroscope's two windows show the stone twice: give one of them");
    if (!is_closed(solid) || !is_convex(solid)) {
        throw InputError(
            "a pose is found for closed, convex stones only: see what culet info says of this one");
    }
    const auto pixels =
        static_cast<std::size_t>(photo.width) * static_cast<std::size_t>(photo.height);
    if (!options.mask.empty() && options.mask.size() != pixels)
        throw InputError("the mask has another size than the photograph");
}

/// The start with the photograph's size: the same picture with more or fewer pixels.
Camera resized_to(const Camera& start, int width, int height) {
    Camera camera = start;
    if (camera.principal_point) {
        (*camera.principal_point)[0] *= static_cast<double>(width) / start.width;
        (*camera.principal_point)[1] *= static_cast<double>(height) / start.height;
    }
    camera.width = width;
    camera.height = height;
    return camera;
}

Silhouette silhouette_of(const Photo& photo, const PoseOptions& options, const cv::Mat& colour) {
    const auto as_plane = [&](const std::vector<float>& values) {
        return cv::Mat(photo.height, photo.width, CV_32F, const_cast<float*>(values.data()));
    };
    if (!options.mask.empty()) return silhouette_from_coverage(as_plane(options.mask), "mask");
    if (!photo.coverage.empty()) {
        const cv::Mat coverage = as_plane(photo.coverage);
        double least = 0, most = 0;
        cv::minMaxLoc(coverage, &least, &most);
        if (least < 0.5 && most > 0.5) return silhouette_from_coverage(coverage, "coverage");
    }
    return silhouette_from_background(colour);
}

/// Brought to a common exposure: its bright parts near 1.
cv::Mat exposed(const Photo& photo, double& saturation) {
    const cv::Mat colour = colour_of(photo);
    const cv::Mat everywhere(colour.size(), CV_8U, cv::Scalar(255));
    const double bright = quantile(luminance(colour), everywhere, 0.995);
    saturation = photo.saturation;
    if (!(bright > 0)) return colour.clone();
    saturation /= bright;
    return colour * (1 / bright);
}

class PoseSearch {
public:
    PoseSearch(const Solid& solid, const Camera& start, const PoseOptions& options,
               const Progress& progress)
        : wire_(solid),
          symmetries_(symmetries_of(wire_)),
          start_(start),
          options_(options),
          progress_(progress) {}

    FoundPose run(const Photo& photo) {
        FoundPose pose;
        double saturation = 0;
        const cv::Mat colour = exposed(photo, saturation);
        const Silhouette silhouette = silhouette_of(photo, options_, colour);
        pose.outline_source = silhouette.source;
        pose.diameter_px = silhouette.diameter;
        pose.camera = start_;
        if (!silhouette.found()) {
            pose.trouble = silhouette.trouble;
            return pose;
        }
        if (!silhouette.warning.empty()) pose.warnings.push_back(silhouette.warning);
        make_sides(colour, silhouette.mask, saturation);
        prior_focal_ = sides_[0]->start.focal_px();
        std::vector<Candidate> candidates = coarse_candidates();
        choose(candidates, pose);
        return pose;
    }

private:
    void make_sides(const cv::Mat& colour, const cv::Mat& mask, double saturation) {
        sides_.push_back(
            std::make_unique<Side>(colour, mask, saturation, start_, wire_.middle, false));
        if (!options_.both_chiralities) return;
        cv::Mat flipped, flipped_mask;
        cv::flip(colour, flipped, 1);
        cv::flip(mask, flipped_mask, 1);
        sides_.push_back(
            std::make_unique<Side>(flipped, flipped_mask, saturation, start_, wire_.middle, true));
    }

    void report(double fraction) const {
        if (progress_ && !progress_(fraction)) throw Interrupted();
    }

    Target target_of(const Side& side) const {
        return {wire_, side.shape, side.map, side.start.focal_px(), options_.facet_error};
    }

    RefineSettings settings_of(const Side& side) const {
        RefineSettings settings;
        settings.prior_focal_px = prior_focal_;
        settings.sight = side.start.sight;
        settings.facet_error = options_.facet_error;
        settings.focal_error = options_.focal_error;
        settings.principal_point_error = options_.principal_point_error * start_.width;
        settings.diameter_px = side.shape.diameter;
        return settings;
    }

    struct Found {
        const Side* side = nullptr;
        CoarseView coarse;
    };

    static void sort_by_score(std::vector<Found>& found) {
        std::stable_sort(found.begin(), found.end(), [](const Found& a, const Found& b) {
            return a.coarse.score > b.coarse.score;
        });
    }

    std::vector<Candidate> coarse_candidates() const {
        std::vector<Found> found;
        for (const auto& side : sides_) {
            for (const CoarseView& view : search_views(target_of(*side), side->start,
                                                       options_.search, k_views_each, progress_))
                found.push_back({side.get(), view});
        }
        sort_by_score(found);
        report(0.3);
        if (options_.all_turns) {
            std::vector<Found> turned;
            const std::size_t from = std::min<std::size_t>(k_turned_from, found.size());
            for (std::size_t i = 0; i < from; ++i) {
                for (const auto& side : sides_) {
                    // A stone that looks alike mirrored looks so from the mirrored direction.
                    StoneView view = found[i].coarse.view;
                    if (side.get() != found[i].side) view.turn = mirrored_turn(view.turn);
                    for (const CoarseView& one :
                         turned_views(target_of(*side), view, k_turned_each))
                        turned.push_back({side.get(), one});
                }
            }
            found.insert(found.end(), turned.begin(), turned.end());
            sort_by_score(found);
        }
        report(0.4);
        return worth_refining(found);
    }

    std::vector<Candidate> worth_refining(const std::vector<Found>& found) const {
        std::vector<Candidate> candidates;
        for (const Found& one : found) {
            const Found image = images_of(one.side, one.coarse.view).front();
            const bool known =
                std::any_of(candidates.begin(), candidates.end(), [&](const Candidate& other) {
                    return other.side == image.side &&
                           angle_between(other.view, image.coarse.view) < radians(k_same_view_deg);
                });
            if (!known) candidates.push_back({image.side, image.coarse.view, {}, {}});
            if (candidates.size() >= k_refined) break;
        }
        return candidates;
    }

    /// What the model's own symmetry makes of a view: first the one that is not mirrored and
    /// nearest to the start.
    std::vector<Found> images_of(const Side* side, const StoneView& view) const {
        const glm::dmat3 flip(-1, 0, 0, 0, 1, 0, 0, 0, 1);
        std::vector<Found> images;
        for (const glm::dmat3& symmetry : symmetries_) {
            const bool mirrors = glm::determinant(symmetry) < 0;
            Found image{side, {view, 0, 0}};
            StoneView& there = image.coarse.view;
            there.turn = view.turn * glm::transpose(symmetry);
            if (mirrors) {
                if (sides_.size() < 2) continue;
                image.side = sides_[side == sides_[0].get() ? 1 : 0].get();
                there.turn = flip * there.turn;
                there.at.x = start_.width - view.at.x;
                there.sight.x = start_.width - view.sight.x;
            }
            images.push_back(image);
        }
        std::stable_sort(images.begin(), images.end(), [](const Found& a, const Found& b) {
            return nearer_to_start(a.side, a.coarse.view, b.side, b.coarse.view);
        });
        return images;
    }

    static bool nearer_to_start(const Side* a_side, const StoneView& a, const Side* b_side,
                                const StoneView& b) {
        if (a_side->mirrored != b_side->mirrored) return !a_side->mirrored;
        return angle_between(a, a_side->start) < angle_between(b, b_side->start);
    }

    static double angle_between(const StoneView& a, const StoneView& b) {
        return angle_of(a.turn * glm::transpose(b.turn));
    }

    EdgeSupport support_of(const Side& side, const StoneView& view) const {
        WireSpacing spacing;
        spacing.facet_error = options_.facet_error;
        spacing.facet_offset = expected_offset(wire_, options_.facet_error);
        spacing.most_facet_sigma = 0.01 * side.shape.diameter;
        return edge_support(side.picture, points_along(wire_, view, spacing), side.shape.diameter);
    }

    static void sort_by_likelihood(std::vector<Candidate>& candidates) {
        std::stable_sort(candidates.begin(), candidates.end(),
                         [](const Candidate& a, const Candidate& b) {
                             return a.support.log_likelihood > b.support.log_likelihood;
                         });
    }

    /// Without those that were lost and those that ended where a better one did.
    static std::vector<Candidate> distinct(std::vector<Candidate> candidates) {
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

    void choose(std::vector<Candidate>& candidates, FoundPose& pose) const {
        tbb::parallel_for(std::size_t{0}, candidates.size(), [&](std::size_t i) {
            Candidate& c = candidates[i];
            c.refined = draw_in(wire_, c.side->picture, c.view, settings_of(*c.side));
            if (!c.refined.lost) c.support = support_of(*c.side, c.refined.solved.view);
        });
        report(0.7);
        std::vector<Candidate> best = distinct(std::move(candidates));
        if (best.size() > k_settled) best.resize(k_settled);
        tbb::parallel_for(std::size_t{0}, best.size(), [&](std::size_t i) {
            Candidate& c = best[i];
            c.refined = settle(wire_, c.side->picture, c.refined, settings_of(*c.side));
            if (!c.refined.lost) c.support = support_of(*c.side, c.refined.solved.view);
        });
        report(0.95);
        best = distinct(std::move(best));
        if (best.empty()) {
            pose.trouble =
                "no view of this stone has its edges where the photograph has any: is it this "
                "stone, and is the start within 30 degrees?";
            return;
        }
        take_nearest_of_equals(best);
        describe(best, pose);
    }

    /// Of poses that differ by the stone's symmetry and are about as likely, the one that is not
    /// mirrored and nearest to the start comes first.
    void take_nearest_of_equals(std::vector<Candidate>& best) const {
        std::size_t chosen = 0;
        const auto better = [&](const Candidate& a, const Candidate& b) {
            return nearer_to_start(a.side, a.refined.solved.view, b.side, b.refined.solved.view);
        };
        for (std::size_t i = 1; i < best.size(); ++i) {
            if (best[0].support.log_likelihood - best[i].support.log_likelihood > k_tie) break;
            if (looks_alike(best[0], best[i]) && better(best[i], best[chosen])) chosen = i;
        }
        std::rotate(best.begin(), best.begin() + static_cast<std::ptrdiff_t>(chosen),
                    best.begin() + static_cast<std::ptrdiff_t>(chosen) + 1);
    }

    bool looks_alike(const Candidate& a, const Candidate& b) const {
        return look_alike(wire_, a.refined.solved.view, b.refined.solved.view,
                          a.side->mirrored != b.side->mirrored);
    }

    void describe(const std::vector<Candidate>& best, FoundPose& pose) const {
        const Candidate& won = best.front();
        const SolvedView& solved = won.refined.solved;
        pose.camera = camera_of(solved.view, start_);
        pose.mirrored = won.side->mirrored;
        pose.start_angle = angle_between(solved.view, won.side->start);
        pose.start_scale = solved.view.scale / won.side->start.scale;
        pose.crown_support = won.support.met;
        pose.chance_support = won.support.chance;
        pose.support_z = won.support.z;
        describe_sigmas(won, pose);
        describe_marks(won, pose);
        double rival = 1e300;
        for (std::size_t i = 1; i < best.size(); ++i) {
            TriedPose other;
            other.camera = camera_of(best[i].refined.solved.view, start_);
            other.mirrored = best[i].side->mirrored;
            other.turn = angle_between(best[i].refined.solved.view, solved.view);
            other.lead = won.support.log_likelihood - best[i].support.log_likelihood;
            other.symmetric = looks_alike(won, best[i]);
            if (!other.symmetric) rival = std::min(rival, other.lead);
            if (other.symmetric && other.mirrored != pose.mirrored && other.lead < k_tie)
                pose.chirality_known = false;
            pose.others.push_back(other);
        }
        const std::vector<Found> images = images_of(won.side, solved.view);
        for (std::size_t i = 1; i < images.size(); ++i) {
            const StoneView& view = images[i].coarse.view;
            pose.others.push_back({camera_of(view, start_), images[i].side->mirrored,
                                   angle_between(view, solved.view), 0, true});
            if (images[i].side != won.side) pose.chirality_known = false;
        }
        judge(won, rival, pose);
    }

    void describe_sigmas(const Candidate& won, FoundPose& pose) const {
        const SolvedView& solved = won.refined.solved;
        const auto variance = [&](int i, int j) {
            return solved.covariance[static_cast<std::size_t>(i * k_view_unknowns + j)];
        };
        // Residuals larger than their sigmas mean larger sigmas; smaller ones prove nothing.
        std::vector<double> sizes;
        for (double r : solved.residuals) sizes.push_back(std::abs(r));
        const double spread = 1.4826 * middle_of(std::move(sizes));
        const double grown = std::max(1.0, spread);
        const auto sigma = [&](double v) { return grown * std::sqrt(std::max(0.0, v)); };
        PoseSigmas& sigmas = pose.sigmas;
        // Whichever is larger: what the edges' sigmas say, or what groups of edges say.
        const std::array<double, 6> by_groups =
            variances_by_groups(wire_, won.refined, settings_of(*won.side));
        const auto larger = [&](int k) {
            return std::max(sigma(variance(k, k)),
                            std::sqrt(by_groups[static_cast<std::size_t>(k)]));
        };
        for (int k = 0; k < 3; ++k) sigmas.turn[static_cast<std::size_t>(k)] = larger(k);
        sigmas.angle = std::hypot(sigmas.turn[0], sigmas.turn[1], sigmas.turn[2]);
        sigmas.shift_px = {larger(3), larger(4)};
        sigmas.scale = larger(5);
        if (solved.view.nearness > 0) {
            sigmas.focal = sigma(variance(5, 5) + variance(6, 6) - 2 * variance(5, 6));
            if (options_.principal_point_error > 0)
                sigmas.principal_point = sigma(std::max(variance(7, 7), variance(8, 8)));
        }
        sigmas.angle_99 = k_surely * sigmas.angle;
        sigmas.shift_99_px = k_surely * std::hypot(sigmas.shift_px[0], sigmas.shift_px[1]);
        pose.facet_error = won.refined.facet_error;
        pose.facet_offset = won.refined.facet_offset;
    }

    void describe_marks(const Candidate& won, FoundPose& pose) const {
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

    /// The median; of nothing 0.
    static double middle_of(std::vector<double> values) {
        if (values.empty()) return 0;
        const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
        std::nth_element(values.begin(), middle, values.end());
        return *middle;
    }

    void judge(const Candidate& won, double rival, FoundPose& pose) const {
        const PoseLimits& limits = options_.limits;
        const double diameter = won.side->shape.diameter;
        const auto refuse = [&](std::string why) {
            if (pose.trouble.empty()) pose.trouble = std::move(why);
        };
        if (pose.outline_px > std::max(1.0, limits.outline_residual * diameter)) {
            refuse(
                fmt::format("the outline is {:.1f} pixels from the photograph's (at most {:.1f}): "
                            "another stone, or another size of it",
                            pose.outline_px, std::max(1.0, limits.outline_residual * diameter)));
        }
        if (pose.support_z < limits.least_support_z) {
            refuse(
                fmt::format("{:.0f} % of the crown's edges are met, where chance meets {:.0f} %: "
                            "{:.1f} standard deviations above it (at least {:.0f})",
                            100 * pose.crown_support, 100 * pose.chance_support, pose.support_z,
                            limits.least_support_z));
        }
        if (rival < limits.least_lead) {
            refuse(
                fmt::format("another view explains the photograph nearly as well (lead {:.1f}, at "
                            "least {:.0f})",
                            rival, limits.least_lead));
        }
        if (!(pose.sigmas.angle_99 <= limits.angle)) {
            refuse(fmt::format("the view may be off by {:.2f} degrees (at most {:.2f} are allowed)",
                               degrees(pose.sigmas.angle_99), degrees(limits.angle)));
        }
        if (!(pose.sigmas.shift_99_px <= limits.shift_px)) {
            refuse(fmt::format("the place may be off by {:.2f} pixels (at most {:.2f} are allowed)",
                               pose.sigmas.shift_99_px, limits.shift_px));
        }
    }

    WireSolid wire_;
    std::vector<glm::dmat3> symmetries_;
    Camera start_;
    const PoseOptions& options_;
    const Progress& progress_;
    std::vector<std::unique_ptr<Side>> sides_;
    double prior_focal_ = 0;
};

}  // namespace

FoundPose find_pose(const Photo& photo, const Solid& solid, const Camera& start,
                    const PoseOptions& options, const Progress& progress) {
    require_suitable(photo, solid, start, options);
    PoseSearch search(solid, resized_to(start, photo.width, photo.height), options, progress);
    FoundPose pose;
    tbb::task_arena arena(options.threads > 0 ? options.threads : tbb::task_arena::automatic);
    arena.execute([&] { pose = search.run(photo); });
    return pose;
}

}  // namespace culet
