// Windows near a mirror ball, traced ray by ray, against their true places.
//
// Bounds: an outline found to 0.15 pixels on a ball of r pixels turns everything that it shows by
// twice 0.15 / r radians; two places b apart, perpendicular to the line of sight, give the distance
// d to that angle times d squared / b.

#include "compare/light_probe/near_light.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "compare/light_probe/light_probe.h"
#include "compare/light_probe/reflex.h"
#include "stone/numbers/units.h"
#include "stone/text/errors.h"
#include "tests/compare/light_probe/simulated_ball.h"

namespace culet {
namespace {

using simulated::BallShot;
using ::testing::HasSubstr;

constexpr double k_ball = 10;  // radius in the stone's unit

// A window of brightness 6 in front of the panorama.
std::function<std::optional<Rgb>(const Vec3&, const Vec3&)> window_light(
    const std::vector<Window>& windows, const Rgb& radiance = {6, 5, 4}) {
    return [windows, radiance](const Vec3& from, const Vec3& direction) -> std::optional<Rgb> {
        for (const Window& w : windows) {
            const Vec3 normal = glm::normalize(glm::cross(w.u, w.v));
            const double t = glm::dot(w.middle - from, normal) / glm::dot(direction, normal);
            if (!(t > 0)) continue;
            const Vec3 at = from + t * direction - w.middle;
            if (std::abs(glm::dot(at, w.u)) <= glm::dot(w.u, w.u) &&
                std::abs(glm::dot(at, w.v)) <= glm::dot(w.v, w.v))
                return radiance;
        }
        return std::nullopt;
    };
}

// Upright, `distance` away at an azimuth and elevation, turned about the vertical by `tilt`.
Window window_at(double azimuth, double elevation, double distance, double half_width,
                 double half_height, double tilt = 0) {
    const Vec3 middle =
        distance * Vec3(std::cos(elevation) * std::cos(azimuth),
                        std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
    return {middle,
            half_width * Vec3(-std::sin(azimuth + tilt), std::cos(azimuth + tilt), 0),
            {0, 0, half_height}};
}

Rgb dim(const Vec3& d) {
    return {0.2 + 0.1 * d.z, 0.2 + 0.1 * d.z, 0.2 + 0.12 * d.x};
}

BallShot first_shot(double radius) {
    BallShot shot;
    shot.radius = radius;
    shot.width = static_cast<int>(6.8 * radius);
    shot.height = static_cast<int>(2.6 * radius);
    shot.centre_x = 1.4 * radius;
    shot.centre_y = 1.27 * radius;
    shot.distance = 25;
    shot.samples = 4;
    shot.world_from_camera = simulated::camera_at(0, 0);
    return shot;
}

double focal_of(const BallShot& shot) {
    return shot.radius * std::sqrt(shot.distance * shot.distance - 1);
}

Vec3 centre_in_camera(const BallShot& shot) {
    const double f = focal_of(shot);
    return shot.distance * glm::normalize(Vec3((shot.centre_x - (shot.width - 1) / 2.0) / f,
                                               -(shot.centre_y - (shot.height - 1) / 2.0) / f, -1));
}

// The same camera, with the ball elsewhere (in radii, world frame).
BallShot moved_by(const BallShot& first, const Vec3& offset) {
    BallShot shot = first;
    const double f = focal_of(first);
    const Vec3 centre = centre_in_camera(first) + glm::transpose(first.world_from_camera) * offset;
    shot.distance = glm::length(centre);
    shot.centre_x = (shot.width - 1) / 2.0 - f * centre.x / centre.z;
    shot.centre_y = (shot.height - 1) / 2.0 + f * centre.y / centre.z;
    shot.radius = f / std::sqrt(shot.distance * shot.distance - 1);
    shot.place = offset;
    return shot;
}

ProbeView view_of(const BallShot& shot, const std::string& name,
                  const simulated::Panorama& panorama = dim) {
    const simulated::Taken taken = simulated::take(shot, panorama);
    ProbeView view;
    view.name = name;
    view.photo = taken.photo;
    view.ball = BallCircle{taken.x, taken.y, taken.radius};
    view.focal_px = focal_of(shot);
    return view;
}

PixelPlace seen_at(const ProbeView& view, const BallShot& shot, const Vec3& point) {
    const MirrorBall ball = MirrorBall::with_focal_length(
        *view.ball, {(shot.width - 1) / 2.0, (shot.height - 1) / 2.0}, view.focal_px);
    return *ball.place_of_point(glm::transpose(shot.world_from_camera) * (point - shot.place), 1);
}

ProbeOptions options_with(const std::vector<NearLightRequest>& requests) {
    ProbeOptions options;
    options.reflectance = {0.6, 0.6, 0.6};
    options.ball_radius = k_ball;
    options.near_lights = requests;
    options.width = 128;
    options.passes = 4;
    return options;
}

NearLightRequest at(const PixelPlace& place) {
    NearLightRequest request;
    request.at = place;
    return request;
}

TEST(MirrorBallOfNearThings, APointsPixelReflectsALineThroughThePoint) {
    const MirrorBall ball = MirrorBall::at_distance({300, 200, 150}, {320, 240}, 20);
    for (const Vec3& point : {Vec3(3, 1, 2), Vec3(-1.5, 0.4, 0.2), Vec3(0.1, 12, -4)}) {
        const auto place = ball.place_of_point(point, 1);
        ASSERT_TRUE(place);
        const auto seen = ball.reflection_at(*place);
        ASSERT_TRUE(seen);
        EXPECT_NEAR(glm::length(seen->at), 1, 1e-12);
        EXPECT_LT(glm::length(glm::cross(glm::normalize(point - seen->at), seen->direction)), 1e-9);
    }
    // A nearness of zero is a direction.
    const Vec3 far = glm::normalize(Vec3(0.4, -0.3, 0.2));
    const auto place = ball.place_of_point(far, 0), same = ball.place_of(far);
    EXPECT_NEAR(place->x, same->x, 1e-9);
    EXPECT_NEAR(place->y, same->y, 1e-9);
}

// Lines through a known window's edge from the surfaces of two balls: formulas only.
std::vector<SeenOutline> exact_outlines(const Window& window, const std::vector<Vec3>& centres) {
    std::vector<SeenOutline> outlines;
    for (const Vec3& centre : centres) {
        SeenOutline outline;
        outline.place = centre;
        outline.sigma = 1e-4;
        for (int side = 0; side < 4; ++side) {
            const Vec3& out = side < 2 ? window.u : window.v;
            const Vec3& edge = side < 2 ? window.v : window.u;
            for (int k = -5; k <= 5; ++k) {
                const Vec3 on_edge =
                    window.middle + (side % 2 == 0 ? 1.0 : -1.0) * out + (k / 5.0) * edge;
                const Vec3 from =
                    centre + 0.9 * glm::normalize(glm::normalize(on_edge - centre) + Vec3(1, 0, 0));
                outline.sights.push_back({from, glm::normalize(on_edge - from)});
            }
        }
        outlines.push_back(outline);
    }
    return outlines;
}

TEST(WindowFit, ExactLinesGiveTheWindowBack) {
    for (const double tilt : {0.0, 0.5, -0.9}) {
        const Window truth = window_at(2.2, 0.3, 9, 2.5, 1.2, tilt);
        const auto fit = fit_window(exact_outlines(truth, {{0, 0, 0}, {0, 4, 0}}), std::nullopt);
        ASSERT_TRUE(fit);
        EXPECT_LT(glm::length(fit->window.middle - truth.middle), 1e-5) << tilt;
        EXPECT_NEAR(std::max(glm::length(fit->window.u), glm::length(fit->window.v)), 2.5, 1e-5);
        EXPECT_NEAR(std::min(glm::length(fit->window.u), glm::length(fit->window.v)), 1.2, 1e-5);
        EXPECT_NEAR(fit->nearness, 1.0 / 9, 1e-6);
        EXPECT_FALSE(fit->facing);
        EXPECT_LT(missed_angle(truth, exact_outlines(truth, {{0, 0, 0}})), 1e-12);
    }
}

TEST(WindowFit, ASquareHasATurnToo) {
    const Window truth = window_at(-1.0, 0.1, 7, 1.5, 1.5, 0.3);
    const auto fit = fit_window(exact_outlines(truth, {{0, 0, 0}, {3, 0, 1}}), std::nullopt);
    ASSERT_TRUE(fit);
    EXPECT_LT(glm::length(fit->window.middle - truth.middle), 1e-5);
    EXPECT_NEAR(glm::length(fit->window.u), 1.5, 1e-5);
}

TEST(WindowFit, InfinitelyFarIsANearnessOfNothing) {
    const Window truth = window_at(2.2, 0.3, 1e7, 2.5e6, 1.2e6);
    const auto fit = fit_window(exact_outlines(truth, {{0, 0, 0}, {0, 4, 0}}), std::nullopt);
    ASSERT_TRUE(fit);
    EXPECT_NEAR(fit->nearness, 0, 1e-5);
    EXPECT_LT(fit->residual, 1e-5);
}

TEST(WindowFit, OnePlaceAndADistanceGiveAWindowThatFacesIt) {
    const Window truth = window_at(2.2, 0, 9, 2.5, 1.2);
    const auto fit = fit_window(exact_outlines(truth, {{0, 0, 0}}), 1.0 / 9);
    ASSERT_TRUE(fit);
    EXPECT_TRUE(fit->facing);
    EXPECT_LT(glm::length(fit->window.middle - truth.middle), 0.02);
    EXPECT_FALSE(fit_window({}, 1.0));
    SeenOutline few = exact_outlines(truth, {{0, 0, 0}})[0];
    few.sights.resize(5);
    EXPECT_FALSE(fit_window({few}, 1.0));
}

TEST(Reflex, WhatIsNoLightIsToldApart) {
    Photo photo;
    photo.width = photo.height = 100;
    photo.rgb.assign(3 * 100 * 100, 0.1f);
    const auto paint = [&](int x0, int y0, int x1, int y1, float value) {
        for (int y = y0; y < y1; ++y)
            for (int x = x0; x < x1; ++x)
                for (std::size_t c = 0; c < 3; ++c)
                    photo.rgb[3 * static_cast<std::size_t>(100 * y + x) + c] = value;
    };
    paint(40, 40, 60, 50, 2.0f);
    paint(45, 42, 48, 46, 0.1f);  // a bar across it
    paint(30, 70, 32, 72, 2.0f);
    paint(85, 45, 100, 55, 2.0f);
    const BallCircle ball{49.5, 49.5, 45};
    const ReflexSearch good = reflex_at(photo, ball, {50, 48});
    ASSERT_TRUE(good.found);
    EXPECT_EQ(good.found->pixels, 200);
    // Outlines of painted pixels lie half way between two pixels.
    double left = 100, top = 100;
    for (const PixelPlace& p : good.found->outline) {
        left = std::min(left, p.x);
        top = std::min(top, p.y);
    }
    EXPECT_NEAR(left, 39.5, 1e-6);
    EXPECT_NEAR(top, 39.5, 1e-6);
    EXPECT_EQ(reflex_at(photo, ball, {20, 50}).why, NoReflex::not_brighter);
    EXPECT_EQ(reflex_at(photo, ball, {31, 71}).why, NoReflex::too_small);
    EXPECT_EQ(reflex_at(photo, ball, {90, 50}).why, NoReflex::at_the_rim);
    EXPECT_EQ(reflex_at(photo, ball, {2, 2}).why, NoReflex::beside_the_ball);
}

// One camera; the ball where the stone stood, and four radii to the side.
TEST(NearLight, AMovedBallTellsWhereAWindowIs) {
    const double radius = 120;
    const Window truth = window_at(2.3, 0.25, 12, 2.5, 1.6, 0.3);
    BallShot here = first_shot(radius);
    here.near = window_light({truth});
    const BallShot there = moved_by(here, {0.6, -4, 0});
    const ProbeView first = view_of(here, "here"), second = view_of(there, "there");
    ProbeOptions options = options_with({at(seen_at(first, here, truth.middle))});
    options.moved = true;
    const LightProbe probe = light_probe({first, second}, options);
    EXPECT_TRUE(probe.usable()) << probe.doubt;
    ASSERT_EQ(probe.near_lights.size(), 1u);
    const NearLight& light = probe.near_lights[0];
    EXPECT_EQ(light.from, "parallax");
    RecordProperty("distance", std::to_string(light.distance / k_ball));
    RecordProperty("sigma", std::to_string(light.distance_sigma / k_ball));
    RecordProperty("tilt_deg", std::to_string(degrees(light.tilt)));
    RecordProperty("extents", std::to_string(glm::length(light.window.u) / k_ball) + " " +
                                  std::to_string(glm::length(light.window.v) / k_ball));
    // Perpendicular to the line of sight the ball moved by 4 sin(angle between the two); both
    // outlines have errors.
    const double across = 4 * std::abs(glm::dot(glm::normalize(truth.u), Vec3(0, 1, 0)));
    const double bound = 12.0 * 12.0 / across * std::sqrt(2.0) * 2 * 0.15 / radius;
    EXPECT_NEAR(light.distance / k_ball, 12, 3 * bound);
    EXPECT_LT(light.distance_sigma / k_ball, 2 * bound);
    EXPECT_LT(std::abs(light.distance / k_ball - 12), 3 * light.distance_sigma / k_ball);
    const double off =
        std::acos(glm::dot(glm::normalize(light.window.middle), glm::normalize(truth.middle)));
    EXPECT_LT(off, 2 * 0.15 / radius + 0.1 * 2 / radius);
    EXPECT_NEAR(2 * std::max(glm::length(light.window.u), glm::length(light.window.v)) / k_ball, 5,
                5 * 3 * bound / 12 + 0.1);
    // Pixels entirely within the window show it exactly.
    EXPECT_NEAR(light.radiance[0], 6, 1e-4);
    EXPECT_NEAR(light.radiance[1], 5, 1e-4);
    EXPECT_NEAR(light.radiance[2], 4, 1e-4);
    EXPECT_LT(glm::dot(light.normal, light.window.middle), 0);
    // Not counted twice: the map holds the room behind it, both around the window and in its
    // middle.
    const MergedLight& map = probe.light;
    for (std::size_t i = 0; i < map.map.rgb.size(); i += 3) EXPECT_LT(map.map.rgb[i], 0.32);
    EXPECT_NEAR(glm::length(probe.views[1].centre - Vec3(0.6, -4, 0)), 0, 25 * 0.15 / radius);
    EXPECT_THAT(light_toml(probe, "room.exr"), HasSubstr("[[light.plane]]"));
    EXPECT_THAT(light_json(probe, options), HasSubstr("\"near_lights\""));
}

TEST(NearLight, WindowsThatLookAlikeAreNotConfused) {
    const double radius = 100;
    const std::vector<Window> truth{window_at(2.3, 0.3, 11, 1.2, 1.2),
                                    window_at(1.4, 0.2, 14, 1.5, 1.5)};
    BallShot here = first_shot(radius);
    here.near = window_light(truth);
    const BallShot there = moved_by(here, {0, -4, 0});
    const ProbeView first = view_of(here, "here"), second = view_of(there, "there");
    ProbeOptions options = options_with(
        {at(seen_at(first, here, truth[0].middle)), at(seen_at(first, here, truth[1].middle))});
    options.moved = true;
    const LightProbe probe = light_probe({first, second}, options);
    EXPECT_TRUE(probe.usable()) << probe.doubt;
    ASSERT_EQ(probe.near_lights.size(), 2u);
    EXPECT_NEAR(probe.near_lights[0].distance / k_ball, 11,
                3 * probe.near_lights[0].distance_sigma);
    EXPECT_NEAR(probe.near_lights[0].distance / k_ball, 11, 1);
    EXPECT_NEAR(probe.near_lights[1].distance / k_ball, 14, 2);
}

// Guy & Soler's two views: the camera moves a quarter turn, in a room that determines the turn.
TEST(NearLight, TwoCamerasTellWhereAWindowIs) {
    const double radius = 80;
    const Window truth = window_at(-2.4, 0.25, 5, 1.4, 0.9);
    const auto panorama = simulated::room(5);
    BallShot front = first_shot(radius), side = first_shot(radius);
    front.near = side.near = window_light({truth}, {40, 40, 40});
    side.world_from_camera = simulated::camera_at(1.6, 0);
    const ProbeView first = view_of(front, "front", panorama);
    const ProbeView second = view_of(side, "side", panorama);
    const LightProbe probe =
        light_probe({first, second}, options_with({at(seen_at(first, front, truth.middle))}));
    ASSERT_EQ(probe.near_lights.size(), 1u);
    const NearLight& light = probe.near_lights[0];
    EXPECT_TRUE(light.usable()) << light.doubt;
    RecordProperty("distance", std::to_string(light.distance / k_ball));
    RecordProperty("sigma", std::to_string(light.distance_sigma / k_ball));
    // Both outlines to 0.15 pixels, doubled; the reflections are at least 0.6 radii apart.
    const double bound = 5.0 * 5.0 / 0.6 * std::sqrt(2.0) * 2 * 0.15 / radius;
    EXPECT_NEAR(light.distance / k_ball, 5, 3 * bound);
    EXPECT_LT(std::abs(light.distance - 5 * k_ball), 3 * light.distance_sigma);
    EXPECT_LT(light.distance_sigma / k_ball, 2 * bound);
    EXPECT_NEAR(light.radiance[1], 40, 0.01);
}

TEST(NearLight, ALightTooFarToTellStaysInTheEnvironment) {
    const Window truth = window_at(2.3, 0.25, 3000, 600, 400);
    BallShot here = first_shot(80);
    here.near = window_light({truth});
    const BallShot there = moved_by(here, {0, -3, 0});
    const ProbeView first = view_of(here, "here"), second = view_of(there, "there");
    ProbeOptions options = options_with({at(seen_at(first, here, truth.middle))});
    options.moved = true;
    const LightProbe probe = light_probe({first, second}, options);
    EXPECT_THAT(probe.doubt, HasSubstr("too far away"));
    EXPECT_THAT(light_toml(probe, "room.exr"), Not(HasSubstr("light.plane")));
    EXPECT_GT(probe.light.map.at(glm::normalize(truth.middle))[0], 5);
}

TEST(NearLight, OnePictureNeedsADistance) {
    const Window truth = window_at(2.3, 0, 10, 2, 1.5);
    BallShot here = first_shot(80);
    here.near = window_light({truth});
    const ProbeView view = view_of(here, "here");
    NearLightRequest request = at(seen_at(view, here, truth.middle));
    const auto refusal = [&](const ProbeOptions& options) -> std::string {
        try {
            light_probe({view}, options);
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_THAT(refusal(options_with({request})), HasSubstr("--near-distance"));
    ProbeOptions no_radius = options_with({request});
    no_radius.ball_radius = 0;
    EXPECT_THAT(refusal(no_radius), HasSubstr("--ball-radius"));
    EXPECT_THAT(refusal(options_with({at({5, 5})})), HasSubstr("not on the ball"));
    EXPECT_THAT(refusal(options_with({at({view.ball->x, view.ball->y})})), HasSubstr("twice"));
    ProbeOptions moved = options_with({request});
    moved.moved = true;
    EXPECT_THAT(refusal(moved), HasSubstr("two places"));

    request.distance = 10 * k_ball;
    const LightProbe probe = light_probe({view}, options_with({request}));
    EXPECT_TRUE(probe.usable()) << probe.doubt;
    const NearLight& light = probe.near_lights.at(0);
    EXPECT_NEAR(light.distance, 100, 1e-3);  // to second order in its offset
    // The window's middle, seen from a ball of 80 pixels with an exact outline: to a tenth of a
    // pixel, doubled by the reflection.
    EXPECT_LT(glm::length(light.window.middle / k_ball - truth.middle), 10 * 2 * 0.1 / 80 * 2);
    EXPECT_NEAR(light.radiance[0], 6, 1e-4);
}

// A window measured with a ruler is taken as given; its radiance and place in the map come from the
// ball.
TEST(NearLight, AMeasuredWindowIsTakenAtItsWord) {
    const Window truth = window_at(2.3, 0.25, 10, 2, 1.5);
    BallShot here = first_shot(80);
    here.near = window_light({truth});
    const ProbeView view = view_of(here, "here");
    NearLightRequest request;
    request.measured = Window{k_ball * truth.middle, k_ball * truth.u, k_ball * truth.v};
    const LightProbe probe = light_probe({view}, options_with({request}));
    EXPECT_TRUE(probe.usable()) << probe.doubt;
    const NearLight& light = probe.near_lights.at(0);
    EXPECT_EQ(light.window.middle, request.measured->middle);
    EXPECT_NEAR(light.radiance[2], 4, 1e-4);
    EXPECT_LT(light.residual, 2 * 0.2 / 80);
    for (std::size_t i = 0; i < probe.light.map.rgb.size(); i += 3)
        EXPECT_LT(probe.light.map.rgb[i], 0.32);

    request.measured->middle = Vec3(1, 0, 0) * (10 * k_ball);
    request.measured->u = {0, 1, 0};
    request.measured->v = {0, 0, 1};
    EXPECT_THROW(light_probe({view}, options_with({request})), InputError);
}

}  // namespace
}  // namespace culet
