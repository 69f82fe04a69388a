// The geometry of a mirror ball. Expectations: the closed form for a distant camera (the reflected
// direction is at twice the angle of the normal), rays traced onto a sphere with plain vectors, and
// that the mapping's two directions are inverse.

#include "compare/light_probe/mirror_ball.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "tests/compare/light_probe/simulated_ball.h"

namespace culet {
namespace {

constexpr double k_inf = std::numeric_limits<double>::infinity();

// Normal n = (x, y, sqrt(1 - x^2 - y^2)), direction 2 n_z n - z.
TEST(MirrorBall, ADistantCameraSeesTheTextbooksFormula) {
    const MirrorBall ball = MirrorBall::at_distance({200, 150, 100}, {199.5, 149.5}, k_inf);
    for (double x = -0.95; x < 1; x += 0.19) {
        for (double y = -0.95; y < 1; y += 0.19) {
            if (x * x + y * y > 0.95) continue;
            const double z = std::sqrt(1 - x * x - y * y);
            const auto d = ball.direction_of({200 + 100 * x, 150 - 100 * y});
            ASSERT_TRUE(d);
            EXPECT_NEAR(glm::length(*d - Vec3(2 * z * x, 2 * z * y, 2 * z * z - 1)), 0, 2e-5);
        }
    }
    EXPECT_FALSE(ball.direction_of({301, 150}));
}

TEST(MirrorBall, PixelsAndDirectionsAreInverseAtAnyDistance) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (const double distance : {1.5, 3.0, 10.0, 60.0, 1e4, k_inf}) {
        const MirrorBall ball = MirrorBall::at_distance({260, 130, 90}, {199.5, 149.5}, distance);
        for (int i = 0; i < 300; ++i) {
            const PixelPlace p{260 + 85 * uniform(random), 130 + 85 * uniform(random)};
            const auto d = ball.direction_of(p);
            if (!d) continue;
            EXPECT_NEAR(glm::length(*d), 1, 1e-12);
            const auto back = ball.place_of(*d);
            ASSERT_TRUE(back);
            EXPECT_NEAR(back->x, p.x, 1e-5) << distance;
            EXPECT_NEAR(back->y, p.y, 1e-5) << distance;
        }
        EXPECT_FALSE(ball.place_of(-ball.towards_camera()));
        EXPECT_NEAR(std::sin(ball.blind_half_angle()), distance < 1e5 ? 1 / distance : 0, 2e-6);
    }
}

// The outline of an off-centre ball is an ellipse: circle and distance must still recover the ball.
TEST(MirrorBall, ABallBesideTheMiddleIsTheTracedOne) {
    simulated::BallShot shot;
    shot.width = 400;
    shot.height = 300;
    shot.centre_x = 300;
    shot.centre_y = 110;
    shot.radius = 70;
    shot.distance = 12;
    shot.samples = 8;
    shot.reflectance = 1;
    shot.world_from_camera = glm::dmat3(1.0);
    // Light whose value is its direction.
    const auto taken = simulated::take(shot, [](const Vec3& d) {
        return Rgb{d.x + 1, d.y + 1, d.z + 1};
    });
    const MirrorBall ball =
        MirrorBall::at_distance({taken.x, taken.y, taken.radius}, {199.5, 149.5}, 12);
    double worst = 0;
    for (int y = 60; y < 165; y += 5) {
        for (int x = 245; x < 355; x += 5) {
            const auto d = ball.direction_of({static_cast<double>(x), static_cast<double>(y)});
            if (!d || std::hypot(x - 300, y - 110) > 60) continue;
            const float* rgb = &taken.photo.rgb[3 * (static_cast<std::size_t>(y) * 400 + x)];
            worst = std::max(worst, glm::length(*d - Vec3(rgb[0] - 1, rgb[1] - 1, rgb[2] - 1)));
        }
    }
    // The circle is known to an eighth of a pixel; a pixel in the middle is 2 / 70 radians.
    EXPECT_LT(worst, 0.02);
}

TEST(MirrorBall, FocalLengthAndDistanceSayTheSame) {
    const BallCircle circle{250, 160, 80};
    const PixelPlace principal{199.5, 149.5};
    const MirrorBall a = MirrorBall::at_distance(circle, principal, 15);
    const MirrorBall b = MirrorBall::with_focal_length(circle, principal, a.focal_px());
    EXPECT_NEAR(b.distance(), 15, 1e-6);
    EXPECT_NEAR(glm::length(a.towards_camera() - b.towards_camera()), 0, 1e-9);
}

TEST(MirrorBall, APixelInTheMiddleShowsTheStatedSolidAngle) {
    const MirrorBall ball = MirrorBall::at_distance({200, 150, 100}, {200, 150}, 10);
    const Vec3 a = *ball.direction_of({200, 150}), b = *ball.direction_of({200.1, 150});
    const double angle = glm::length(a - b) / 0.1;
    EXPECT_NEAR(angle * angle / ball.solid_angle_per_pixel(), 1, 1e-3);
}

}  // namespace
}  // namespace culet
