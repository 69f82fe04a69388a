#include "compare/light_probe/near_light.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <opencv2/core.hpp>

#include "compare/light_probe/reflex.h"
#include "compare/photo/pixels.h"
#include "stone/numbers/units.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

// Error of an edge between two pixels, a tenth of their distance (reflex.h).
constexpr double k_edge_sigma_px = 0.1;
// Smallest brightness of a light in the second picture, relative to the first: paper before a lamp
// is darker to the side.
constexpr double k_least_brightness = 0.25;
// Share of a measured window's extents that certainly is window.
constexpr double k_surely_inside = 0.8;

Reflex reflex_or_refuse(const BallPlace& place, const PixelPlace& seed, const std::string& where) {
    ReflexSearch search = reflex_at(*place.view.picture, place.view.ball.circle(), seed);
    if (search.found) return std::move(*search.found);
    const char* why = "";
    switch (search.why) {
        case NoReflex::beside_the_ball:
            why = "is not on the ball";
            break;
        case NoReflex::not_brighter:
            why = "shows no light that is twice as bright as what lies around it";
            break;
        case NoReflex::at_the_rim:
            why = "shows a light that reaches the ball's rim: take the picture from another side";
            break;
        case NoReflex::too_small:
            why =
                "shows a light of fewer than nine pixels: go nearer, or measure it with a ruler "
                "and give it with --near-window";
            break;
    }
    throw InputError(fmt::format("--near: the pixel {} {}", where, why));
}

EdgeSight sight_in_world(const BallPlace& place, const MirrorBall::Reflection& reflection) {
    return {place.centre + place.view.world_from_camera * reflection.at,
            place.view.world_from_camera * reflection.direction};
}

SeenOutline outline_of(const BallPlace& place, const Reflex& reflex) {
    SeenOutline outline;
    outline.place = place.centre;
    outline.sigma = k_edge_sigma_px * std::sqrt(place.view.ball.solid_angle_per_pixel());
    outline.turned_sigma = place.turned_sigma;
    for (const PixelPlace& pixel : reflex.outline) {
        const auto reflection = place.view.ball.reflection_at(pixel);
        if (reflection) outline.sights.push_back(sight_in_world(place, *reflection));
    }
    return outline;
}

// Where a picture may show what another place sees along a line: its brightest pixels on and beside
// the line, over all distances.
std::vector<Reflex> reflexes_along(const BallPlace& place, const EdgeSight& line, double bright) {
    constexpr int k_steps = 160;
    constexpr double k_nearest = 0.8;  // 1 / distance: the light is outside the ball
    const MirrorBall& ball = place.view.ball;
    const Photo& picture = *place.view.picture;
    const cv::Mat light = luminance(colour_of(picture));
    const int beside = 2 + static_cast<int>(0.02 * ball.circle().radius);
    const glm::dmat3 camera_from_world = glm::transpose(place.view.world_from_camera);
    const double forward = glm::dot(line.from, line.direction);
    const double aside = std::max(glm::dot(line.from, line.from) - forward * forward, 0.0);
    std::vector<Reflex> found;
    for (int step = 0; step <= k_steps; ++step) {
        const double w = k_nearest * step / k_steps;
        const double along = std::sqrt(std::max(1 - w * w * aside, 0.0)) - w * forward;
        const Vec3 at = w * (line.from - place.centre) + along * line.direction;
        const auto pixel = ball.place_of_point(camera_from_world * at, w);
        if (!pixel) continue;
        const cv::Rect around = cv::Rect(static_cast<int>(std::lround(pixel->x)) - beside,
                                         static_cast<int>(std::lround(pixel->y)) - beside,
                                         2 * beside + 1, 2 * beside + 1) &
                                cv::Rect(0, 0, light.cols, light.rows);
        if (around.empty()) continue;
        double most = 0;
        cv::Point brightest;
        cv::minMaxLoc(light(around), nullptr, &most, nullptr, &brightest);
        brightest += around.tl();
        if (most < bright) continue;
        const auto index = static_cast<std::size_t>(brightest.y * picture.width + brightest.x);
        const bool known = std::any_of(found.begin(), found.end(),
                                       [&](const Reflex& r) { return r.inside[index] != 0; });
        if (known) continue;
        ReflexSearch search =
            reflex_at(picture, ball.circle(),
                      {static_cast<double>(brightest.x), static_cast<double>(brightest.y)});
        if (search.found) found.push_back(std::move(*search.found));
    }
    return found;
}

void add(std::vector<std::uint8_t>& to, const std::vector<std::uint8_t>& flags) {
    if (to.empty()) to.assign(flags.size(), 0);
    for (std::size_t i = 0; i < flags.size(); ++i) to[i] |= flags[i];
}

using Shown = std::vector<std::vector<std::uint8_t>>;

NearLight from_reflex(const std::vector<BallPlace>& places, const NearLightRequest& request,
                      Shown& shown) {
    const std::string& where = request.name;
    const Reflex first = reflex_or_refuse(places[0], *request.at, where);
    Shown touched(places.size());
    touched[0] = first.touched;
    std::vector<SeenOutline> outlines{outline_of(places[0], first)};
    const auto middle = places[0].view.ball.reflection_at(*request.at);
    if (!middle) throw InputError(fmt::format("--near: the pixel {} is not on the ball", where));
    const EdgeSight line = sight_in_world(places[0], *middle);
    for (std::size_t v = 1; v < places.size(); ++v) {
        std::vector<Reflex> candidates;
        if (v == 1 && request.at_other) {
            candidates.push_back(
                reflex_or_refuse(places[v], *request.at_other, where + " (in the second picture)"));
        } else {
            candidates =
                reflexes_along(places[v], line, k_least_brightness * first.within / places[v].gain);
        }
        const Reflex* best = nullptr;
        double least = std::numeric_limits<double>::infinity();
        SeenOutline seen;
        for (const Reflex& candidate : candidates) {
            const SeenOutline outline = outline_of(places[v], candidate);
            const auto fit =
                fit_window({outlines[0], outline},
                           request.distance ? std::optional(1 / *request.distance) : std::nullopt);
            if (!fit || fit->residual >= least) continue;
            least = fit->residual;
            best = &candidate;
            seen = outline;
        }
        if (!best) continue;
        outlines.push_back(seen);
        touched[v] = best->touched;
    }
    if (outlines.size() == 1 && !request.distance) {
        const std::string remedy =
            places.size() == 1
                ? "one picture does not show how far away a light is: say it with "
                  "--near-distance, or photograph the ball a second time, moved aside (--moved)"
                : "no other picture shows this light: give its pixel there with --near "
                  "X,Y,X2,Y2, or its distance with --near-distance";
        throw InputError(fmt::format("--near {}: {}", where, remedy));
    }
    const auto fit = fit_window(
        outlines, request.distance ? std::optional(1 / *request.distance) : std::nullopt);
    if (!fit) {
        throw InputError(fmt::format(
            "--near {}: the light's outline is too short to find its shape: go nearer, or measure "
            "it with a ruler and give it with --near-window",
            where));
    }
    NearLight light;
    light.window = fit->window;
    light.radiance = first.radiance;
    light.over = first.over;
    light.from = request.distance ? "distance" : "parallax";
    light.distance =
        fit->nearness > 0 ? 1 / fit->nearness : std::numeric_limits<double>::infinity();
    light.distance_sigma = fit->nearness_sigma * light.distance * light.distance;
    light.tilt = fit->tilt;
    light.tilt_sigma = fit->tilt_sigma;
    light.facing = fit->facing;
    light.residual = fit->residual;
    if (!(fit->nearness > 3 * fit->nearness_sigma)) {
        light.doubt = fmt::format(
            "the light at {} is too far away, or the pictures are taken too near one another, to "
            "tell its distance: it stays in the environment; say --near-distance, or move the ball "
            "farther (--moved)",
            where);
        return light;
    }
    for (std::size_t p = 0; p < places.size(); ++p)
        if (!touched[p].empty()) add(shown[p], touched[p]);
    if (light.facing && light.from == "parallax") {
        light.notes.push_back(fmt::format(
            "the light at {}: which way it is tilted cannot be told; it is taken to face the ball",
            where));
    }
    const double pixel = std::sqrt(places[0].view.ball.solid_angle_per_pixel());
    if (fit->residual > 2 * pixel) {
        light.notes.push_back(fmt::format(
            "the light at {}: its outline is {:.1f} degrees off a rectangle's on average", where,
            degrees(fit->residual)));
    }
    return light;
}

// Position of a line of sight in the window, 1 at its edge; infinite if it misses the plane or
// comes from behind.
double share_of_extents(const Window& window, const Vec3& normal, const EdgeSight& sight) {
    constexpr double k_missed = std::numeric_limits<double>::infinity();
    const double towards = glm::dot(sight.direction, normal);
    const double height = glm::dot(sight.from - window.middle, normal);
    if (!(towards < 0) || !(height > 0)) return k_missed;
    const Vec3 at = sight.from - height / towards * sight.direction - window.middle;
    return std::max(std::abs(glm::dot(at, window.u)) / glm::dot(window.u, window.u),
                    std::abs(glm::dot(at, window.v)) / glm::dot(window.v, window.v));
}

NearLight from_ruler(const std::vector<BallPlace>& places, const Window& window, int window_number,
                     Shown& shown) {
    NearLight light;
    light.window = window;
    light.from = "measured";
    light.distance = glm::length(window.middle);
    Vec3 normal = glm::normalize(glm::cross(window.u, window.v));
    if (glm::dot(normal, window.middle) > 0) normal = -normal;
    light.tilt =
        std::acos(std::min(std::abs(glm::dot(normal, window.middle)) / light.distance, 1.0));
    std::vector<SeenOutline> outlines;
    for (std::size_t p = 0; p < places.size(); ++p) {
        const BallPlace& place = places[p];
        const Photo& picture = *place.view.picture;
        std::vector<std::uint8_t> hit(picture.rgb.size() / 3, 0);
        double count = 0;
        Rgb sum{};
        for (int y = 0; y < picture.height; ++y) {
            for (int x = 0; x < picture.width; ++x) {
                const auto reflection =
                    place.view.ball.reflection_at({static_cast<double>(x), static_cast<double>(y)});
                if (!reflection) continue;
                const double share =
                    share_of_extents(window, normal, sight_in_world(place, *reflection));
                const std::size_t i =
                    static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                    static_cast<std::size_t>(x);
                hit[i] = share <= 1;
                if (p > 0 || share > k_surely_inside) continue;
                ++count;
                for (std::size_t c = 0; c < 3; ++c) sum[c] += picture.rgb[3 * i + c];
                if (!picture.saturated.empty()) light.over += picture.saturated[i];
            }
        }
        add(shown[p], hit);
        if (p == 0) {
            if (count == 0) {
                throw InputError(fmt::format(
                    "--near-window: no pixel of the ball shows window {}: check its frame (x to "
                    "azimuth 0, z up, the ball's middle at the origin) and --towards",
                    window_number));
            }
            for (std::size_t c = 0; c < 3; ++c) light.radiance[c] = sum[c] / count;
            light.over /= count;
        }
        // The light may be slightly off the measured place.
        const auto pixel = place.view.ball.place_of_point(
            glm::transpose(place.view.world_from_camera) * (window.middle - place.centre), 1.0);
        if (!pixel) continue;
        const ReflexSearch seen = reflex_at(picture, place.view.ball.circle(), *pixel);
        if (!seen.found) continue;
        add(shown[p], seen.found->touched);
        outlines.push_back(outline_of(place, *seen.found));
    }
    if (outlines.empty()) {
        light.notes.push_back(fmt::format(
            "window {} does not stand out in the ball: its radiance is what the ball shows there",
            window_number));
    } else {
        light.residual = missed_angle(window, outlines);
        light.notes.push_back(fmt::format(
            "window {}: the ball shows its edges {:.1f} degrees beside the measured ones",
            window_number, degrees(light.residual)));
    }
    return light;
}

}  // namespace

FoundNearLights find_near_lights(const std::vector<BallPlace>& places,
                                 const std::vector<NearLightRequest>& requests) {
    FoundNearLights found;
    Shown shown(places.size());
    int window_number = 0;
    for (const NearLightRequest& request : requests) {
        NearLight light = request.measured
                              ? from_ruler(places, *request.measured, ++window_number, shown)
                              : from_reflex(places, request, shown);
        if (light.usable()) {
            light.normal = glm::normalize(glm::cross(light.window.u, light.window.v));
            if (glm::dot(light.normal, light.window.middle) > 0) light.normal = -light.normal;
        }
        if (light.over > 1e-3) {
            light.notes.push_back(
                fmt::format("a near light is over-exposed over {:.1f} % of its reflex: it is "
                            "brighter than found; add a shorter exposure",
                            100 * light.over));
        }
        found.lights.push_back(std::move(light));
    }
    for (auto& flags : shown) {
        found.shown.push_back(
            flags.empty() ? nullptr
                          : std::make_shared<const std::vector<std::uint8_t>>(std::move(flags)));
    }
    return found;
}

}  // namespace culet
