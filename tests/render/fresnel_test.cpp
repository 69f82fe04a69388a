// Expectations: closed forms (Born & Wolf, Principles of Optics, 1.5) and energy balance.

#include "render/optics/fresnel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace {

using culet::FaceAmplitudes;
using culet::fresnel;

double reflectance(const std::complex<double>& r) {
    return std::norm(r);
}

TEST(Fresnel, NormalIncidenceIsTheSquareOfTheIndexContrast) {
    // ((n-1)/(n+1))^2 for diamond, 2.417: 0.17197...
    const double n = 2.417, expected = std::pow((n - 1) / (n + 1), 2);
    for (const auto& [n1, n2] : {std::pair(1.0, n), std::pair(n, 1.0)}) {
        const FaceAmplitudes face = fresnel(n1, n2, n1);
        EXPECT_NEAR(reflectance(face.r_s), expected, 1e-15);
        EXPECT_NEAR(reflectance(face.r_p), expected, 1e-15);
        EXPECT_NEAR(std::abs(face.r_s + face.r_p), 0, 1e-15) << "r_p = -r_s in this frame";
    }
}

TEST(Fresnel, FortyFiveDegreesOnGlass) {
    // r_s = -sin(a-b)/sin(a+b), r_p = tan(a-b)/tan(a+b) (Born & Wolf 1.5.2 (21a)); our p has the
    // same sign.
    const double n = 1.5, a = std::acos(-1.0) / 4, b = std::asin(std::sin(a) / n);
    const FaceAmplitudes face = fresnel(1, n, std::cos(a));
    EXPECT_NEAR(reflectance(face.r_s), std::pow(std::sin(a - b) / std::sin(a + b), 2), 1e-15);
    EXPECT_NEAR(reflectance(face.r_p), std::pow(std::tan(a - b) / std::tan(a + b), 2), 1e-15);
    EXPECT_NEAR(reflectance(face.r_s), 0.0920134, 1e-7);  // published: 9.201 %
}

TEST(Fresnel, BrewstersAngleReflectsNoP) {
    for (const double n : {1.0 + 1e-9, 1.33, 1.5, 2.417, 4.0}) {
        const double cosine = 1 / std::sqrt(1 + n * n);
        EXPECT_LT(std::abs(fresnel(1, n, cosine).r_p), 1e-15) << n;
    }
}

TEST(Fresnel, NothingIsReflectedBetweenEqualMedia) {
    for (const double cosine : {1.0, 0.5, 1e-3, 1e-9}) {
        const FaceAmplitudes face = fresnel(1.7, 1.7, 1.7 * cosine);
        EXPECT_EQ(reflectance(face.r_s), 0);
        EXPECT_NEAR(face.t_s, 1, 1e-15);
        EXPECT_NEAR(face.t_p, 1, 1e-15);
    }
}

TEST(Fresnel, ReflectedAndTransmittedPowerSumToOne) {
    const unsigned seed = 20040807;
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (int i = 0; i < 20000; ++i) {
        const double n1 = 1 + 3 * uniform(random), n2 = 1 + 3 * uniform(random);
        // Half of the draws are close to grazing.
        const double c = i % 2 == 0 ? uniform(random) : std::pow(10, -15 * uniform(random));
        const FaceAmplitudes face = fresnel(n1, n2, n1 * c);
        EXPECT_NEAR(reflectance(face.r_s) + face.t_s * face.t_s, 1, 5e-15)
            << "seed " << seed << " draw " << i;
        EXPECT_NEAR(reflectance(face.r_p) + face.t_p * face.t_p, 1, 5e-15)
            << "seed " << seed << " draw " << i;
    }
}

TEST(Fresnel, TotalReflectionRetardsSAgainstPByTheClosedForm) {
    // tan(delta/2) = cos sqrt(sin^2 - n^2)/sin^2 (Born & Wolf 1.5.4 (60)).
    const double index = 2.417, n = 1 / index;
    for (const double degrees : {25.0, 30.0, 45.0, 60.0, 80.0}) {
        const double a = degrees * std::acos(-1.0) / 180, s = std::sin(a), c = std::cos(a);
        const FaceAmplitudes face = fresnel(index, 1, index * c);
        ASSERT_TRUE(face.total);
        EXPECT_NEAR(std::abs(face.r_s), 1, 1e-15);
        EXPECT_NEAR(std::abs(face.r_p), 1, 1e-15);
        const double delta = 2 * std::atan(c * std::sqrt(s * s - n * n) / (s * s));
        // arg r_s - arg r_p = delta, modulo a whole turn.
        const std::complex<double> ratio = face.r_s / face.r_p;
        EXPECT_NEAR(std::abs(ratio - std::polar(1.0, delta)), 0, 1e-14) << degrees;
    }
}

TEST(Fresnel, CriticalAngleFromBothSidesAndGrazing) {
    const double index = 1.5;
    const double critical = std::sqrt(index * index - 1);  // q1 where q2 = 0
    for (const double step : {1e-3, 1e-6, 1e-9, 1e-12, 1e-15}) {
        const FaceAmplitudes below = fresnel(index, 1, critical * (1 + step));
        const FaceAmplitudes above = fresnel(index, 1, critical * (1 - step));
        EXPECT_NEAR(std::norm(below.r_s) + below.t_s * below.t_s, 1, 1e-14);
        EXPECT_NEAR(std::abs(above.r_s), 1, 1e-14);
    }
    const FaceAmplitudes grazing = fresnel(1, index, 0);
    EXPECT_NEAR(std::norm(grazing.r_s), 1, 1e-15);
    EXPECT_EQ(grazing.t_s, 0);
    EXPECT_NEAR(std::norm(fresnel(index, 1, 0).r_p), 1, 1e-15);
}

}  // namespace
