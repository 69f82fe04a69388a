#include "compare/light_probe/view_places.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <opencv2/core.hpp>
#include <opencv2/photo.hpp>
#include <optional>

#include "stone/text/errors.h"

namespace culet {

namespace {

// Gains nearer to 1 than this are flicker, shutter scatter or measurement errors; deliberate
// changes of exposure are at least a third of a stop.
constexpr double k_rounding = 0.01;
// Farther away than this, the radius in pixels does not give the distance: 0.1 of 100 pixels is one
// of 1000 radii.
constexpr double k_farthest_moved = 1000;

// The outline's error as a rotation of all that the ball shows: a reflection doubles it.
double turned_by_outline(const ViewPrior& prior) {
    return 2 * prior.circle_sigma_px / prior.circle.radius;
}

glm::dmat3 about_vertical(double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    return {Vec3(c, 0, -s), Vec3(0, 1, 0), Vec3(s, 0, c)};  // columns
}

// Replaces left-out pixels by their surroundings, so that blur does not spread them.
BallView painted_over(const BallView& view) {
    BallView result = view;
    if (!view.left_out) return result;
    auto picture = std::make_shared<Photo>(*view.picture);
    const cv::Size size(picture->width, picture->height);
    const cv::Mat flags(size, CV_8U, const_cast<std::uint8_t*>(view.left_out->data()));
    const cv::Mat rgb(size, CV_32FC3, picture->rgb.data());
    std::vector<cv::Mat> channels(3);
    cv::split(rgb, channels);
    for (cv::Mat& channel : channels) {
        cv::Mat filled;
        cv::inpaint(channel, flags, filled, 3, cv::INPAINT_TELEA);
        channel = filled;
    }
    cv::merge(channels, rgb);
    result.picture = std::move(picture);
    return result;
}

double usual_gain(double found) {
    return std::abs(found - 1) < k_rounding ? 1.0 : found;
}

void keep_refined(ViewPrior& prior, const MirrorBall& ball) {
    prior.circle = ball.circle();
    prior.circle_sigma_px = 0.02;
    if (prior.focal_px <= 0) prior.distance = ball.distance();
}

struct SurePair {
    std::size_t placed, to_place;
    RoughTurn turn;
};

bool less_sure(const SurePair& a, const SurePair& b) {
    const auto sureness = [](const SurePair& pair) {
        return std::pair(!pair.turn.ambiguous(), pair.turn.correlation);
    };
    return sureness(a) < sureness(b);
}

bool is_in(const std::vector<std::size_t>& list, std::size_t index) {
    return std::ranges::find(list, index) != list.end();
}

ViewAlignment place(PlacedViews& views, const SurePair& pair) {
    const std::size_t at = pair.placed, v = pair.to_place;
    const ViewAlignment found = align_views(views.seen[at], views.cuts[at].prior, views.seen[v],
                                            views.cuts[v].prior, pair.turn);
    views.seen[at].ball = found.first;
    views.seen[v].ball = found.second;
    views.seen[v].world_from_camera = views.seen[at].world_from_camera * found.first_from_second;
    views.gains[v] = views.gains[at] * usual_gain(found.gain);
    views.places[v].turned_sigma = found.sigma;
    keep_refined(views.cuts[at].prior, found.first);
    keep_refined(views.cuts[v].prior, found.second);
    return found;
}

}  // namespace

glm::dmat3 world_from_camera(double azimuth, double elevation) {
    const double ca = std::cos(azimuth), sa = std::sin(azimuth);
    const double ce = std::cos(elevation), se = std::sin(elevation);
    const Vec3 forward(ce * ca, ce * sa, se), up(-se * ca, -se * sa, ce);
    return {glm::cross(forward, up), up, -forward};
}

void align_all(PlacedViews& views, const ProbeOptions& options, const Progress& progress) {
    const std::size_t count = views.seen.size();
    std::vector<std::optional<ViewAlignment>> found(count);
    // Neighbouring views share the most: the surest pair with a placed view places the next one.
    std::vector<SurePair> pairs;
    std::vector<std::size_t> placed{0};
    double done = 0;
    const double all = static_cast<double>(count * (count - 1)) / 2;
    while (placed.size() < count) {
        for (std::size_t v = 1; v < count; ++v) {
            if (is_in(placed, v)) continue;
            const std::size_t at = placed.back();
            pairs.push_back({at, v,
                             options.turned && at == 0 && v == 1
                                 ? RoughTurn{about_vertical(*options.turned)}
                                 : rough_turn(views.seen[at], views.seen[v])});
            if (!progress(++done / all)) throw Interrupted();
        }
        std::erase_if(pairs, [&](const SurePair& pair) { return is_in(placed, pair.to_place); });
        const SurePair best = *std::max_element(pairs.begin(), pairs.end(), less_sure);
        found[best.to_place] = place(views, best);
        placed.push_back(best.to_place);
    }
    for (std::size_t v = 1; v < count; ++v) views.alignments.push_back(*found[v]);
}

void align_without_near_lights(PlacedViews& views, std::vector<ViewPrior> priors) {
    const glm::dmat3 camera_from_world = glm::transpose(views.seen[0].world_from_camera);
    const double first_outline = turned_by_outline(priors[0]);
    for (std::size_t v = 1; v < views.seen.size(); ++v) {
        const double outline = turned_by_outline(priors[v]);
        const ViewAlignment again =
            align_views(painted_over(views.seen[0]), priors[0], painted_over(views.seen[v]),
                        priors[v], RoughTurn{camera_from_world * views.seen[v].world_from_camera});
        views.seen[0].ball = again.first;
        views.seen[v].ball = again.second;
        keep_refined(priors[0], again.first);
        views.seen[v].world_from_camera = views.seen[0].world_from_camera * again.first_from_second;
        // Without remaining light that fixes the rotation, it is uncertain to a radian.
        const bool known = std::isfinite(again.sigma) && again.sigma > 0;
        // Light beside and behind a ball shifts its outline, which least squares ignore: its error
        // counts in full.
        const double sigma = known ? std::min(again.sigma, 1.0) : 1.0;
        views.places[v].turned_sigma = std::hypot(sigma, first_outline, outline);
        views.alignments[v - 1].residual = again.residual;
        views.alignments[v - 1].sigma = sigma;
    }
}

void place_moved_balls(PlacedViews& views) {
    if (views.seen[0].ball.distance() > k_farthest_moved) {
        throw InputError(
            "--moved: finding where the ball was moved to needs the camera's distance or focal "
            "length: give --camera LENS or --distance RADII");
    }
    for (std::size_t v = 1; v < views.seen.size(); ++v) {
        const double focal_px =
            views.seen[0].ball.focal_px() * views.cuts[0].factor / views.cuts[v].factor;
        views.seen[v].ball = MirrorBall::with_focal_length(views.cuts[v].prior.circle,
                                                           views.cuts[v].prior.principal, focal_px);
        views.seen[v].world_from_camera = views.seen[0].world_from_camera;
        views.places[v].centre = views.seen[0].world_from_camera *
                                 (views.seen[v].ball.centre() - views.seen[0].ball.centre());
        if (glm::length(views.places[v].centre) < 1) {
            throw InputError(
                std::filesystem::path(views.cuts[v].name),
                fmt::format("--moved: the ball was moved by {:.2f} of its radii; it needs 1 at "
                            "least, and a third of the light's distance is best",
                            glm::length(views.places[v].centre)));
        }
        views.places[v].turned_sigma = std::hypot(turned_by_outline(views.cuts[0].prior),
                                                  turned_by_outline(views.cuts[v].prior));
    }
}

void leave_out(const FoundNearLights& near, PlacedViews& views) {
    for (std::size_t v = 0; v < near.shown.size(); ++v) views.seen[v].left_out = near.shown[v];
}

}  // namespace culet
