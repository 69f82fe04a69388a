#include "compare/light_probe/light_probe.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>
#include <utility>

#include "compare/light_probe/probe_certainty.h"
#include "compare/light_probe/view_places.h"
#include "stone/progress/check_stop.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

constexpr double k_smallest_radius = 20;  // pixels
constexpr double k_usual_distance = 30;   // radii, the default
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

void check_views(const std::vector<ProbeView>& views, bool moved) {
    if (views.empty()) throw InputError("no photograph of a ball was given");
    if (moved && views.size() < 2)
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
}

std::vector<FoundBall> balls_in(const std::vector<ProbeView>& views, const Progress& progress) {
    std::vector<FoundBall> balls;
    for (const ProbeView& view : views) {
        balls.push_back(ball_in(view));
        if (balls.back().circle.radius < k_smallest_radius) {
            refuse(view, fmt::format("the ball has a radius of {:.0f} pixels; at least {:.0f} are "
                                     "needed: go nearer",
                                     balls.back().circle.radius, k_smallest_radius));
        }
        if (progress &&
            !progress(0.2 * static_cast<double>(balls.size()) / static_cast<double>(views.size())))
            throw Interrupted();
    }
    return balls;
}

struct MapWidth {
    int computed = 0, coarser = 1;  // averaged over `coarser` texels
};

// 20 % more texels round the horizon than the largest ball has pixels, so that none is lost, in
// multiples of 128. Coarser maps are averaged from this one; finer ones are made directly.
MapWidth width_of_map(const std::vector<FoundBall>& balls, int asked) {
    double largest = 0;
    for (const FoundBall& ball : balls) largest = std::max(largest, ball.circle.radius);
    const int natural =
        std::clamp(128 * static_cast<int>(std::ceil(1.2 * std::numbers::pi * largest / 128)),
                   k_narrowest, k_widest);
    if (asked <= 0) return {natural, 1};
    const int coarser = asked < natural ? (natural + asked - 1) / asked : 1;
    return {coarser * asked, coarser};
}

// Where the views are, as far as is known before they are aligned; adds them to the result.
PlacedViews views_to_place(const std::vector<ProbeView>& views, const std::vector<FoundBall>& balls,
                           const ProbeOptions& options, int width, LightProbe& probe) {
    PlacedViews placed;
    placed.gains.assign(views.size(), 1.0);
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
    placed.seen[0].world_from_camera =
        world_from_camera(options.towards_azimuth, options.towards_elevation);
    return placed;
}

FoundNearLights near_lights_in(PlacedViews& placed, const std::vector<NearLightRequest>& requests) {
    for (std::size_t v = 0; v < placed.seen.size(); ++v) {
        placed.places[v].view = placed.seen[v];
        placed.places[v].view.left_out = nullptr;
        placed.places[v].gain = placed.gains[v];
    }
    return find_near_lights(placed.places, requests);
}

// Places the views and finds the near lights, which are left out of the views.
FoundNearLights place_views(PlacedViews& placed, const ProbeOptions& options,
                            const Progress& progress) {
    const std::vector<NearLightRequest> requests = requests_of(options, placed.cuts);
    std::vector<ViewPrior> priors;
    for (const CutToBall& cut : placed.cuts) priors.push_back(cut.prior);
    if (options.moved) {
        place_moved_balls(placed);
    } else {
        align_all(placed, options,
                  [&](double done) { return !progress || progress(0.2 + 0.3 * done); });
    }
    FoundNearLights near;
    if (!requests.empty()) near = near_lights_in(placed, requests);
    if (!requests.empty() && !options.moved && placed.seen.size() > 1) {
        // The first alignment fitted the near lights too, which hides their parallax: align again
        // without them.
        leave_out(near, placed);
        align_without_near_lights(placed, priors);
        near = near_lights_in(placed, requests);
    }
    leave_out(near, placed);
    return near;
}

void describe_places(const PlacedViews& placed, LightProbe& probe) {
    probe.alignments = placed.alignments;
    for (std::size_t v = 0; v < probe.views.size(); ++v) {
        const BallView& seen = placed.seen[v];
        ProbeViewResult& result = probe.views[v];
        result.circle = placed.cuts[v].in_photograph(seen.ball.circle());
        result.distance = seen.ball.distance();
        result.focal_px = seen.ball.focal_px() * placed.cuts[v].factor;
        result.gain = placed.gains[v];
        result.world_from_camera = seen.world_from_camera;
        result.centre = placed.places[v].centre;
        const Vec3 a = placed.seen[0].world_from_camera * placed.seen[0].ball.towards_camera();
        const Vec3 b = seen.world_from_camera * seen.ball.towards_camera();
        result.turned = probe.moved ? 0 : angle_between(a, b);
    }
}

}  // namespace

LightProbe light_probe(const std::vector<ProbeView>& views, const ProbeOptions& options,
                       const Progress& asked) {
    StopScope stops(asked);
    const Progress progress = stops.progress();
    check_views(views, options.moved);
    const std::vector<FoundBall> balls = balls_in(views, progress);
    const auto [width, coarser] = width_of_map(balls, options.width);
    LightProbe probe;
    probe.moved = options.moved;
    PlacedViews placed = views_to_place(views, balls, options, width, probe);
    FoundNearLights near = place_views(placed, options, progress);
    describe_places(placed, probe);
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
