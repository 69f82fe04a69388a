#include "compare/light_probe/light_probe.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>
#include <utility>

#include "compare/light_probe/view_places.h"
#include "render/scene/environment_layout.h"
#include "stone/numbers/quantile.h"
#include "stone/numbers/units.h"
#include "stone/progress/check_stop.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

constexpr double k_smallest_radius = 20;  // pixels
constexpr double k_usual_distance = 30;   // radii, the default
constexpr double k_much = 0.7;            // stops between two views: too much disagreement
constexpr int k_narrowest = 128, k_widest = 4096;

[[noreturn]] void refuse(const ProbeView& view, const std::string& message) {
    throw InputError(std::filesystem::path(view.name), message);
}

FoundBall ball_in(const ProbeView& view) {
    const Photo& photo = view.photo;
    if (view.ball) {
        const BallCircle& c = *view.ball;
        if (!(c.radius > 0) || c.x - c.radius < -1 || c.y - c.radius < -1 ||
            c.x + c.radius > photo.width || c.y + c.radius > photo.height) {
            refuse(view, fmt::format("the ball at {:g},{:g} with radius {:g} reaches outside the "
                                     "picture of {} x {} pixels: --ball is X,Y,RADIUS in pixels "
                                     "from the top left",
                                     c.x, c.y, c.radius, photo.width, photo.height));
        }
        return {c, 1, 0, 0.25};
    }
    const std::vector<FoundBall> balls = find_balls(photo);
    for (const FoundBall& ball : balls) {
        const BallCircle& c = ball.circle;
        if (c.x - c.radius >= -1 && c.y - c.radius >= -1 && c.x + c.radius <= photo.width &&
            c.y + c.radius <= photo.height)
            return ball;
    }
    if (!balls.empty()) {
        const BallCircle& c = balls.front().circle;
        refuse(view, fmt::format("the ball (at {:.0f},{:.0f}, radius {:.0f}) reaches outside the "
                                 "picture: photograph all of it, or give it with --ball "
                                 "X,Y,RADIUS",
                                 c.x, c.y, c.radius));
    }
    refuse(view,
           "no ball found: give its middle and radius in pixels with --ball X,Y,RADIUS, or "
           "photograph it larger and against a plain ground");
}

// Share of the ball that is over-exposed. Throws for a ball in the dark.
double over_exposed(const ProbeView& view, const Photo& picture, const BallCircle& c) {
    double over = 0, pixels = 0, light = 0;
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            if (std::hypot(x - c.x, y - c.y) > c.radius) continue;
            const std::size_t i = static_cast<std::size_t>(y) * picture.width + x;
            ++pixels;
            if (!picture.saturated.empty()) over += picture.saturated[i];
            for (std::size_t k = 0; k < 3; ++k) light += picture.rgb[3 * i + k];
        }
    }
    if (!(light > 0)) refuse(view, "the ball is black: nothing was exposed");
    return over / std::max(pixels, 1.0);
}

void doubt_views(LightProbe& probe) {
    for (std::size_t v = 0; v < probe.alignments.size(); ++v) {
        const ViewAlignment& a = probe.alignments[v];
        if (!a.ambiguous) continue;
        probe.doubt = fmt::format(
            "{}: the views do not fit together in one way only (correlation {:.2f}, the next best "
            "turn {:.2f}): {}, or check that they show one room",
            probe.views[v + 1].name, a.correlation, a.rival,
            probe.views.size() == 2 ? "say how far the camera went with --turned DEGREES"
                                    : "leave it out");
    }
    if (!probe.doubt.empty() || probe.alignments.empty()) return;
    if (probe.middle_disagreement <= k_much) {
        if (probe.mean_disagreement > k_much) {
            probe.notes.push_back(
                "what is near the ball, and the photographer, is elsewhere in each view: light "
                "from there is a mean (see the disagreement picture)");
        }
        return;
    }
    const auto worst = std::max_element(
        probe.alignments.begin(), probe.alignments.end(),
        [](const ViewAlignment& a, const ViewAlignment& b) { return a.residual < b.residual; });
    const std::string what_to_do =
        probe.views.size() == 2
            ? "look"
            : fmt::format("leave out {}, which differs the most, or look",
                          probe.views[std::size_t(worst - probe.alignments.begin()) + 1].name);
    probe.doubt = fmt::format(
        "the views differ by {:.1f} stops over half of the room: {} at the disagreement picture "
        "(did lights change or the ball move?)",
        probe.middle_disagreement, what_to_do);
}

// Sets notes for people, and `doubt`.
void assess(LightProbe& probe) {
    double omega_sum = 0, covered = 0;
    std::vector<float> stops;
    double sum = 0;
    const MergedLight& light = probe.light;
    for (int y = 0; y < light.map.height; ++y) {
        const double omega = lat_long_solid_angle(y, light.map.width, light.map.height);
        for (int x = 0; x < light.map.width; ++x) {
            const std::size_t i = static_cast<std::size_t>(y) * light.map.width + x;
            omega_sum += omega;
            if (light.coverage[i] > 1e-4f) covered += omega;
            if (std::isfinite(light.disagreement[i])) {
                stops.push_back(light.disagreement[i]);
                sum += light.disagreement[i];
            }
        }
    }
    probe.covered = covered / omega_sum;
    if (!stops.empty()) {
        probe.mean_disagreement = sum / static_cast<double>(stops.size());
        probe.middle_disagreement = quantile(stops, 0.5);
        probe.worst_disagreement = quantile(std::move(stops), 0.99);
    }
    const double missing = 100 * (1 - probe.covered);
    if (probe.views.size() == 1 || probe.moved) {
        probe.notes.push_back(
            fmt::format("one view: the {:.0f} degrees behind the ball are filled from around "
                        "them, and camera and photographer are still in the light; a second view "
                        "from the side mends both",
                        2 * degrees(std::asin(1 / probe.views[0].distance))));
    } else if (missing > 0.05) {
        probe.notes.push_back(
            fmt::format("{:.1f} % of all directions are seen by no view well", missing));
    }
    for (const ProbeViewResult& view : probe.views) {
        if (view.over_exposed > 1e-5) {
            probe.notes.push_back(
                fmt::format("{}: {:.2f} % of the ball is over-exposed: lights there are brighter "
                            "than found; add a shorter exposure",
                            view.name, 100 * view.over_exposed));
        }
        if (view.distance_from == "assumed") {
            probe.notes.push_back(fmt::format(
                "{}: the camera is taken to be {:g} ball radii away: say better with --distance",
                view.name, view.distance));
        }
    }
    for (const ProbeViewResult& view : probe.views) {
        if (!view.rival || !probe.doubt.empty()) continue;
        probe.doubt = fmt::format(
            "{}: the ball may be at {:.0f},{:.0f} with radius {:.0f} or at {:.0f},{:.0f} with "
            "radius {:.0f}: look, and say which with --ball X,Y,RADIUS",
            view.name, view.circle.x, view.circle.y, view.circle.radius, view.rival->x,
            view.rival->y, view.rival->radius);
    }
    doubt_views(probe);
    for (const NearLight& near : probe.near_lights) {
        probe.notes.insert(probe.notes.end(), near.notes.begin(), near.notes.end());
        if (!near.usable() && probe.doubt.empty()) probe.doubt = near.doubt;
    }
}

// Requests in ball radii and in pixels of the cut pictures.
std::vector<NearLightRequest> requests_of(const ProbeOptions& options,
                                          const std::vector<CutToBall>& ready) {
    std::vector<NearLightRequest> requests = options.near_lights;
    if (requests.empty()) return requests;
    if (!(options.ball_radius > 0))
        throw InputError(
            "a near light needs the ball's radius, in the stone's unit: --ball-radius");
    for (NearLightRequest& request : requests) {
        if (request.at) {
            request.name = fmt::format("{:g},{:g}", request.at->x, request.at->y);
            request.at = ready[0].in_cut(*request.at);
        }
        if (request.at_other) {
            if (ready.size() < 2) {
                throw InputError(
                    "--near X,Y,X2,Y2 says where a second picture shows the light: "
                    "there is one picture only");
            }
            request.at_other = ready[1].in_cut(*request.at_other);
        }
        if (request.distance) *request.distance /= options.ball_radius;
        if (request.measured) {
            for (Vec3* v : {&request.measured->middle, &request.measured->u, &request.measured->v})
                *v /= options.ball_radius;
        }
    }
    return requests;
}

void in_stone_units(NearLight& light, const ProbeOptions& options) {
    for (Vec3* v : {&light.window.middle, &light.window.u, &light.window.v})
        *v *= options.ball_radius;
    light.distance *= options.ball_radius;
    light.distance_sigma *= options.ball_radius;
    for (std::size_t c = 0; c < 3; ++c) light.radiance[c] /= options.reflectance[c];
}

}  // namespace

LightProbe light_probe(const std::vector<ProbeView>& views, const ProbeOptions& options,
                       const Progress& asked) {
    StopScope stops(asked);
    const Progress progress = stops.progress();
    if (views.empty()) throw InputError("no photograph of a ball was given");
    if (options.moved && views.size() < 2)
        throw InputError("--moved needs the ball at two places: one photograph was given");
    for (const ProbeView& view : views) {
        if (view.photo.width != views[0].photo.width ||
            view.photo.height != views[0].photo.height) {
            refuse(view, fmt::format("is {} x {} pixels, {} is {} x {}: views are whole pictures "
                                     "of one camera, not cut",
                                     view.photo.width, view.photo.height, views[0].name,
                                     views[0].photo.width, views[0].photo.height));
        }
    }
    LightProbe probe;
    std::vector<FoundBall> balls;
    double largest = 0;
    for (const ProbeView& view : views) {
        balls.push_back(ball_in(view));
        if (balls.back().circle.radius < k_smallest_radius) {
            refuse(view, fmt::format("the ball has a radius of {:.0f} pixels; at least {:.0f} are "
                                     "needed: go nearer",
                                     balls.back().circle.radius, k_smallest_radius));
        }
        largest = std::max(largest, balls.back().circle.radius);
        if (progress &&
            !progress(0.2 * static_cast<double>(balls.size()) / static_cast<double>(views.size())))
            throw Interrupted();
    }
    // 20 % more texels round the horizon than the ball has pixels, so that none is lost, in
    // multiples of 128. Coarser maps are averaged from this one; finer ones are made directly.
    const int natural =
        std::clamp(128 * static_cast<int>(std::ceil(1.2 * std::numbers::pi * largest / 128)),
                   k_narrowest, k_widest);
    const int coarser = options.width > 0 && options.width < natural
                            ? (natural + options.width - 1) / options.width
                            : 1;
    const int width = options.width > 0 ? coarser * options.width : natural;

    PlacedViews placed;
    placed.gains.assign(views.size(), 1.0);
    probe.moved = options.moved;
    for (std::size_t v = 0; v < views.size(); ++v) {
        placed.cuts.push_back(
            cut_to_ball(views[v], balls[v].circle, balls[v].sigma_px, options, width));
        ProbeViewResult result;
        result.name = views[v].name;
        result.support = balls[v].support;
        result.found = !views[v].ball;
        result.rival = balls[v].rival;
        result.over_exposed =
            over_exposed(views[v], *placed.cuts[v].picture, placed.cuts[v].prior.circle);
        result.distance_from = options.moved && v > 0               ? "the first ball"
                               : options.distance > 0               ? "given"
                               : views[v].focal_px > 0              ? "focal length"
                               : views.size() > 1 && !options.moved ? "both views"
                                                                    : "assumed";
        probe.views.push_back(result);
        placed.seen.push_back({placed.cuts[v].picture,
                               ball_of(placed.cuts[v].prior, k_usual_distance),
                               options.photographer, glm::dmat3(1.0)});
        placed.places.push_back({placed.seen.back()});
    }
    const std::vector<NearLightRequest> requests = requests_of(options, placed.cuts);
    std::vector<ViewPrior> priors;
    for (const CutToBall& cut : placed.cuts) priors.push_back(cut.prior);
    placed.seen[0].world_from_camera =
        world_from_camera(options.towards_azimuth, options.towards_elevation);
    const auto find_near = [&] {
        for (std::size_t v = 0; v < placed.seen.size(); ++v) {
            placed.places[v].view = placed.seen[v];
            placed.places[v].view.left_out = nullptr;
            placed.places[v].gain = placed.gains[v];
        }
        return find_near_lights(placed.places, requests);
    };
    FoundNearLights near;
    if (options.moved) {
        place_moved_balls(placed);
    } else {
        align_all(placed, options,
                  [&](double done) { return !progress || progress(0.2 + 0.3 * done); });
    }
    if (!requests.empty()) near = find_near();
    if (!requests.empty() && !options.moved && placed.seen.size() > 1) {
        // The first alignment fitted the near lights too, which hides their parallax: align again
        // without them.
        leave_out(near, placed);
        align_without_near_lights(placed, priors);
        near = find_near();
    }
    leave_out(near, placed);
    probe.alignments = placed.alignments;
    for (std::size_t v = 0; v < views.size(); ++v) {
        ProbeViewResult& result = probe.views[v];
        result.circle = placed.cuts[v].in_photograph(placed.seen[v].ball.circle());
        result.distance = placed.seen[v].ball.distance();
        result.focal_px = placed.seen[v].ball.focal_px() * placed.cuts[v].factor;
        result.gain = placed.gains[v];
        result.world_from_camera = placed.seen[v].world_from_camera;
        result.centre = placed.places[v].centre;
        const Vec3 a = placed.seen[0].world_from_camera * placed.seen[0].ball.towards_camera();
        const Vec3 b = placed.seen[v].world_from_camera * placed.seen[v].ball.towards_camera();
        result.turned = options.moved ? 0 : angle_between(a, b);
    }
    // Moved balls see near lights elsewhere, so only the first ball's view is merged.
    const std::vector<BallView> merged =
        options.moved ? std::vector<BallView>{placed.seen[0]} : std::move(placed.seen);
    placed.gains.resize(merged.size());
    probe.light = merge_views(merged, placed.gains, width, options.passes,
                              [&](double done) { return !progress || progress(0.5 + 0.5 * done); });
    for (NearLight& light : near.lights) in_stone_units(light, options);
    probe.near_lights = std::move(near.lights);
    if (coarser > 1) probe.light = coarsened(probe.light, coarser);
    for (std::size_t i = 0; i < probe.light.map.rgb.size(); ++i)
        probe.light.map.rgb[i] /= static_cast<float>(options.reflectance[i % 3]);
    assess(probe);
    return probe;
}

}  // namespace culet
