#include "compare/light_probe/place_reflexes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <opencv2/core.hpp>

#include "compare/photo/pixels.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

// Error of an edge between two pixels, a tenth of their distance (reflex.h).
constexpr double k_edge_sigma_px = 0.1;

}  // namespace

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

}  // namespace culet
