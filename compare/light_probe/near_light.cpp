#include "compare/light_probe/near_light.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>

#include "compare/light_probe/place_reflexes.h"
#include "stone/numbers/units.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

// Smallest brightness of a light in the second picture, relative to the first: paper before a lamp
// is darker to the side.
constexpr double k_least_brightness = 0.25;
// Share of a measured window's extents that certainly is window.
constexpr double k_surely_inside = 0.8;

void add(std::vector<std::uint8_t>& to, const std::vector<std::uint8_t>& flags) {
    if (to.empty()) to.assign(flags.size(), 0);
    for (std::size_t i = 0; i < flags.size(); ++i) to[i] |= flags[i];
}

using Shown = std::vector<std::vector<std::uint8_t>>;

// Unit, towards the ball.
Vec3 normal_of(const Window& window) {
    const Vec3 normal = glm::normalize(glm::cross(window.u, window.v));
    return glm::dot(normal, window.middle) > 0 ? -normal : normal;
}

std::optional<double> nearness_of(const NearLightRequest& request) {
    return request.distance ? std::optional(1 / *request.distance) : std::nullopt;
}

/// What the places see of a light; `touched` is empty where none is seen.
struct SeenLightAt {
    std::vector<SeenOutline> outlines;
    Shown touched;
};

// Together with the first place's outline; null: none fits.
const Reflex* best_fitting(const std::vector<Reflex>& candidates, const BallPlace& place,
                           const SeenOutline& first, const std::optional<double>& nearness) {
    const Reflex* best = nullptr;
    double least = std::numeric_limits<double>::infinity();
    for (const Reflex& candidate : candidates) {
        const auto fit = fit_window({first, outline_of(place, candidate)}, nearness);
        if (!fit || fit->residual >= least) continue;
        least = fit->residual;
        best = &candidate;
    }
    return best;
}

SeenLightAt seen_by_all(const std::vector<BallPlace>& places, const NearLightRequest& request,
                        const Reflex& first) {
    SeenLightAt seen{{outline_of(places[0], first)}, Shown(places.size())};
    seen.touched[0] = first.touched;
    const auto middle = places[0].view.ball.reflection_at(*request.at);
    if (!middle)
        throw InputError(fmt::format("--near: the pixel {} is not on the ball", request.name));
    const EdgeSight line = sight_in_world(places[0], *middle);
    for (std::size_t v = 1; v < places.size(); ++v) {
        std::vector<Reflex> candidates;
        if (v == 1 && request.at_other) {
            candidates.push_back(reflex_or_refuse(places[v], *request.at_other,
                                                  request.name + " (in the second picture)"));
        } else {
            candidates =
                reflexes_along(places[v], line, k_least_brightness * first.within / places[v].gain);
        }
        const Reflex* best =
            best_fitting(candidates, places[v], seen.outlines[0], nearness_of(request));
        if (!best) continue;
        seen.outlines.push_back(outline_of(places[v], *best));
        seen.touched[v] = best->touched;
    }
    return seen;
}

WindowFit window_or_refuse(const std::vector<SeenOutline>& outlines,
                           const NearLightRequest& request, bool one_picture) {
    if (outlines.size() == 1 && !request.distance) {
        throw InputError(fmt::format(
            "--near {}: {}", request.name,
            one_picture
                ? "one picture does not show how far away a light is: say it with "
                  "--near-distance, or photograph the ball a second time, moved aside (--moved)"
                : "no other picture shows this light: give its pixel there with --near "
                  "X,Y,X2,Y2, or its distance with --near-distance"));
    }
    const auto fit = fit_window(outlines, nearness_of(request));
    if (fit) return *fit;
    throw InputError(fmt::format(
        "--near {}: the light's outline is too short to find its shape: go nearer, or measure it "
        "with a ruler and give it with --near-window",
        request.name));
}

NearLight from_reflex(const std::vector<BallPlace>& places, const NearLightRequest& request,
                      Shown& shown) {
    const Reflex first = reflex_or_refuse(places[0], *request.at, request.name);
    const SeenLightAt seen = seen_by_all(places, request, first);
    const WindowFit fit = window_or_refuse(seen.outlines, request, places.size() == 1);
    NearLight light;
    light.window = fit.window;
    light.radiance = first.radiance;
    light.over = first.over;
    light.from = request.distance ? "distance" : "parallax";
    light.distance = fit.nearness > 0 ? 1 / fit.nearness : std::numeric_limits<double>::infinity();
    light.distance_sigma = fit.nearness_sigma * light.distance * light.distance;
    light.tilt = fit.tilt;
    light.tilt_sigma = fit.tilt_sigma;
    light.facing = fit.facing;
    light.residual = fit.residual;
    if (!(fit.nearness > 3 * fit.nearness_sigma)) {
        light.doubt = fmt::format(
            "the light at {} is too far away, or the pictures are taken too near one another, to "
            "tell its distance: it stays in the environment; say --near-distance, or move the ball "
            "farther (--moved)",
            request.name);
        return light;
    }
    for (std::size_t p = 0; p < places.size(); ++p)
        if (!seen.touched[p].empty()) add(shown[p], seen.touched[p]);
    if (light.facing && light.from == "parallax") {
        light.notes.push_back(fmt::format(
            "the light at {}: which way it is tilted cannot be told; it is taken to face the ball",
            request.name));
    }
    const double pixel = std::sqrt(places[0].view.ball.solid_angle_per_pixel());
    if (fit.residual > 2 * pixel) {
        light.notes.push_back(fmt::format(
            "the light at {}: its outline is {:.1f} degrees off a rectangle's on average",
            request.name, degrees(fit.residual)));
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

// The pixels of a place that show the window. `inside`, if given: indices of those that certainly
// do.
std::vector<std::uint8_t> pixels_showing(const Window& window, const Vec3& normal,
                                         const BallPlace& place, std::vector<std::size_t>* inside) {
    const Photo& picture = *place.view.picture;
    std::vector<std::uint8_t> hit(picture.rgb.size() / 3, 0);
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            const auto reflection =
                place.view.ball.reflection_at({static_cast<double>(x), static_cast<double>(y)});
            if (!reflection) continue;
            const double share =
                share_of_extents(window, normal, sight_in_world(place, *reflection));
            const std::size_t i = static_cast<std::size_t>(y) * picture.width + x;
            hit[i] = share <= 1;
            if (inside && share <= k_surely_inside) inside->push_back(i);
        }
    }
    return hit;
}

void set_radiance(const Photo& picture, const std::vector<std::size_t>& pixels, int window_number,
                  NearLight& light) {
    if (pixels.empty()) {
        throw InputError(fmt::format(
            "--near-window: no pixel of the ball shows window {}: check its frame (x to "
            "azimuth 0, z up, the ball's middle at the origin) and --towards",
            window_number));
    }
    const double count = static_cast<double>(pixels.size());
    for (const std::size_t i : pixels) {
        for (std::size_t c = 0; c < 3; ++c) light.radiance[c] += picture.rgb[3 * i + c];
        if (!picture.saturated.empty()) light.over += picture.saturated[i];
    }
    for (double& v : light.radiance) v /= count;
    light.over /= count;
}

NearLight from_ruler(const std::vector<BallPlace>& places, const Window& window, int window_number,
                     Shown& shown) {
    NearLight light;
    light.window = window;
    light.from = "measured";
    light.distance = glm::length(window.middle);
    const Vec3 normal = normal_of(window);
    light.tilt =
        std::acos(std::min(std::abs(glm::dot(normal, window.middle)) / light.distance, 1.0));
    std::vector<SeenOutline> outlines;
    for (std::size_t p = 0; p < places.size(); ++p) {
        const BallPlace& place = places[p];
        std::vector<std::size_t> inside;
        add(shown[p], pixels_showing(window, normal, place, p == 0 ? &inside : nullptr));
        if (p == 0) set_radiance(*place.view.picture, inside, window_number, light);
        // The light may be slightly off the measured place.
        const auto pixel = place.view.ball.place_of_point(
            glm::transpose(place.view.world_from_camera) * (window.middle - place.centre), 1.0);
        if (!pixel) continue;
        const ReflexSearch seen = reflex_at(*place.view.picture, place.view.ball.circle(), *pixel);
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
        if (light.usable()) light.normal = normal_of(light.window);
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
