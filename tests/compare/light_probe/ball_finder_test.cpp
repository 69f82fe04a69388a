// Balls in traced photographs, whose outline is known. Real photographs of balls are not available
// here; these have cluttered grounds, lamps, noise and 8 bits instead.

#include "compare/light_probe/ball_finder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <ostream>

#include "compare/light_probe/rim_compression.h"
#include "compare/photo/pixels.h"
#include "tests/compare/light_probe/simulated_ball.h"

namespace culet {
namespace {

// Boxes, discs and stripes, including circles that are not balls.
std::function<Rgb(double, double)> clutter(unsigned seed, int width, int height) {
    std::mt19937_64 random(seed);
    const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1.0p-53; };
    struct Thing {
        double x, y, w, h;
        bool disc;
        Rgb colour;
    };
    std::vector<Thing> things;
    for (int i = 0; i < 60; ++i) {
        things.push_back({width * uniform(),
                          height * uniform(),
                          4 + 0.12 * width * uniform(),
                          4 + 0.2 * height * uniform(),
                          i % 4 == 0,
                          {uniform(), uniform(), uniform()}});
    }
    return [things](double x, double y) {
        Rgb light{0.3, 0.3, 0.3};
        for (const Thing& t : things) {
            const double u = (x - t.x) / t.w, v = (y - t.y) / (t.disc ? t.w : t.h);
            if (t.disc ? u * u + v * v < 1 : std::abs(u) < 1 && std::abs(v) < 1) light = t.colour;
        }
        return light;
    };
}

struct Case {
    const char* name;
    double radius, x, y, reflectance;
    int ground;  // 0: the room itself behind the ball, 1: black, 2: clutter
    bool noisy;
    friend void PrintTo(const Case& one, std::ostream* out) { *out << one.name; }
};

class Balls : public testing::TestWithParam<Case> {};

TEST_P(Balls, AreFoundWithinHalfAPercentOfTheirRadius) {
    const Case& c = GetParam();
    simulated::BallShot shot;
    shot.width = 420;
    shot.height = 320;
    shot.radius = c.radius;
    shot.centre_x = c.x;
    shot.centre_y = c.y;
    shot.reflectance = c.reflectance;
    shot.samples = 3;
    shot.photographer = 0.15;
    if (c.ground == 1) shot.background = [](double, double) { return Rgb{}; };
    if (c.ground == 2) shot.background = clutter(9, shot.width, shot.height);
    auto taken = simulated::take(shot, simulated::room(static_cast<unsigned>(c.radius)));
    if (c.noisy) simulated::expose(taken.photo, 1.0, 800, 3);
    const auto found = find_balls(taken.photo);
    ASSERT_FALSE(found.empty());
    const BallCircle& ball = found.front().circle;
    RecordProperty("support", std::to_string(found.front().support));
    const double most = 0.005 * taken.radius;
    EXPECT_NEAR(ball.x, taken.x, most);
    EXPECT_NEAR(ball.y, taken.y, most);
    EXPECT_NEAR(ball.radius, taken.radius, most);
    EXPECT_GT(found.front().support, 0.4);
}

INSTANTIATE_TEST_SUITE_P(Traced, Balls,
                         testing::Values(Case{"large_on_black", 130, 210, 160, 0.6, 1, false},
                                         Case{"small_on_black", 45, 100.4, 210.7, 0.6, 1, false},
                                         Case{"room_behind", 120, 215.3, 158.8, 0.6, 0, false},
                                         Case{"room_behind_steel", 100, 180, 150, 0.55, 0, true},
                                         Case{"room_behind_noisy", 90, 250.6, 170.2, 0.6, 0, true},
                                         Case{"clutter", 110, 205.2, 161.9, 0.6, 2, false},
                                         Case{"clutter_noisy", 95, 260.8, 150.4, 0.6, 2, true},
                                         Case{"clutter_small", 60, 140.2, 120.1, 0.6, 2, false}),
                         [](const testing::TestParamInfo<Case>& ball) {
                             return std::string(ball.param.name);
                         });

// Where a mirror ball reflects at the angle theta to the view (the rim is at theta = 90 degrees), a
// small step along the radius turns the ray 1 / cos^2(theta) = 1 / (1 - rho^2) times as far as one
// across it. In a room of even detail the light changes faster by the same factor: over the ring
// from 0.93 to 0.99 by 7 to 50, of which pixels and lens remove most. A flat picture of the same
// room shows no such factor.
TEST(BallFinder, AMirrorPressesTheRoomTogetherAtItsRim) {
    simulated::BallShot shot;
    shot.width = 420;
    shot.height = 320;
    shot.radius = 120;
    shot.centre_x = 210;
    shot.centre_y = 160;
    shot.samples = 3;
    shot.background = clutter(9, shot.width, shot.height);
    const auto taken = simulated::take(shot, simulated::room(4));
    const cv::Mat light = luminance(colour_of(taken.photo));
    const RimLook ball = rim_look(light, {taken.x, taken.y, taken.radius});
    EXPECT_GT(ball.compression, 2);
    EXPECT_LT(ball.compression, 50);
    EXPECT_LT(rim_look(light, {40, 40, 38}).compression, ball.compression / 1.5);
    EXPECT_EQ(rim_look(light, {-500, -500, 50}).compression, 0);

    // A lid: concentric rings of constant brightness. Its change along the radius is the same all
    // round; a ball shows something else on each side.
    cv::Mat lid(300, 300, CV_32F, cv::Scalar(0.5));
    for (const auto& [radius, grey] : {std::pair(120, 0.1), {116, 0.4}, {113, 0.2}, {100, 0.15}})
        cv::circle(lid, {150, 150}, radius, cv::Scalar(grey), cv::FILLED, cv::LINE_8);
    const double all_round = rim_look(lid, {150, 150, 120}).alike;
    EXPECT_GT(all_round, 0.9);
    EXPECT_LT(ball.alike, 0.75 * all_round);
}

TEST(BallFinder, AnotherBallIsARival) {
    simulated::BallShot shot;
    shot.width = 300;
    shot.height = 280;
    shot.radius = 100;
    shot.centre_x = 150;
    shot.centre_y = 140;
    shot.samples = 3;
    shot.background = clutter(9, shot.width, shot.height);
    const auto one = simulated::take(shot, simulated::room(4));
    EXPECT_FALSE(find_balls(one.photo).at(0).rival);
    Photo two;
    two.width = 600;
    two.height = 280;
    for (int y = 0; y < 280; ++y) {
        const float* row = one.photo.rgb.data() + 900 * y;
        for (int copy = 0; copy < 2; ++copy) two.rgb.insert(two.rgb.end(), row, row + 900);
    }
    const std::vector<FoundBall> found = find_balls(two);
    ASSERT_FALSE(found.empty());
    ASSERT_TRUE(found[0].rival);
    EXPECT_NEAR(std::abs(found[0].rival->x - found[0].circle.x), 300, 3);
}

TEST(BallFinder, ThereIsNoBallInAnEmptyPictureOrASmallOne) {
    Photo photo;
    photo.width = 200;
    photo.height = 150;
    photo.rgb.assign(3 * 200 * 150, 0.4f);
    EXPECT_TRUE(find_balls(photo).empty());
    photo.width = photo.height = 3;
    photo.rgb.resize(27);
    EXPECT_TRUE(find_balls(photo).empty());
}

}  // namespace
}  // namespace culet
