// The oracle against closed forms of textbooks.

#include "tests/render/face_oracle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "render/optics/complex_vector.h"
#include "stone/solid/perpendicular.h"
#include "tests/random_attitudes.h"

namespace culet {
namespace {

using oracle::Answer;

constexpr std::array<Vec3, 3> k_plain{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};

TEST(FaceOracle, IsotropicFaceHasFresnelsAmplitudes) {
    // Born & Wolf 1.5.2 (21a), r_p with the sign of E along N x s: equal and opposite to r_s at
    // normal incidence.
    for (const double n : {1.5, 2.417})
        for (const double K : {0.0, 0.3, 0.9, 0.999999}) {
            const Answer a =
                oracle::solve({k_plain, {n, n, n}, 1, {K, 0, 0}, {0, 0, 1}, {0, -1, 0}});
            const double q1 = std::sqrt((1 - K) * (1 + K)), q2 = std::sqrt(n * n - K * K);
            EXPECT_NEAR(std::abs(a.back[0][0] - (q1 - q2) / (q1 + q2)), 0, 1e-14);
            EXPECT_NEAR(std::abs(a.back[1][1] - (n * n * q1 - q2) / (n * n * q1 + q2)), 0, 1e-14);
            EXPECT_LT(std::abs(a.back[0][1]) + std::abs(a.back[1][0]), 1e-30);
            EXPECT_LT(a.imbalance, 1e-40);
        }
}

TEST(FaceOracle, TotalReflectionHasFresnelsPhase) {
    // Born & Wolf 1.5.4 (61): tan(delta/2) = cos sqrt(sin^2 - n^2) / sin^2 for p against s.
    const double n = 1.5, K = 1.2, sine = K / n, cosine = std::sqrt(1 - sine * sine);
    const Answer a = oracle::solve({k_plain, {n, n, n}, 1, {K, 0, 0}});
    // det of the reflection in the pair of waves = r_s r_p; with r_s = (q1 - i k)/(q1 + i k).
    const double q1 = n * cosine, kappa = std::sqrt(K * K - 1);
    const Complex r_s = Complex(q1, -kappa) / Complex(q1, kappa);
    const double delta =
        2 * std::atan(cosine * std::sqrt(sine * sine - 1 / (n * n)) / (sine * sine));
    const Complex determinant =
        a.reflected[0][0] * a.reflected[1][1] - a.reflected[0][1] * a.reflected[1][0];
    const Complex expected = r_s * r_s * std::polar(1.0, -delta);
    // Up to the handedness of the arbitrary pairs.
    EXPECT_NEAR(std::min(std::abs(determinant - expected), std::abs(determinant + expected)), 0,
                1e-14);
}

TEST(FaceOracle, UniaxialFaceAcrossTheAxisHasLeknersAmplitudes) {
    // Lekner 1991, J. Phys.: Condens. Matter 3, 6121: optic axis along the normal.
    const double n_o = 1.6584, n_e = 1.4864;
    for (const double sine : {0.0, 0.4, 0.8, 0.99}) {
        const Answer a =
            oracle::solve({k_plain, {n_o, n_o, n_e}, 1, {sine, 0, 0}, {0, 0, 1}, {0, -1, 0}});
        const double cosine = std::sqrt(1 - sine * sine);
        const double root = std::sqrt(n_e * n_e - sine * sine),
                     q_o = std::sqrt(n_o * n_o - sine * sine);
        EXPECT_NEAR(
            std::abs(a.back[1][1] - (n_o * n_e * cosine - root) / (n_o * n_e * cosine + root)), 0,
            1e-14);
        EXPECT_NEAR(std::abs(a.back[0][0] - (cosine - q_o) / (cosine + q_o)), 0, 1e-14);
        if (sine > 0) {
            EXPECT_NEAR(a.towards[0].q.real(), q_o, 1e-14);
            EXPECT_NEAR(a.towards[1].q.real(), n_o / n_e * root, 1e-14);
            EXPECT_LT(std::abs(a.into[0][1]) + std::abs(a.into[1][0]), 1e-30);
        }
    }
}

TEST(FaceOracle, AxisAcrossThePlaneOfIncidenceMakesTwoIsotropicFaces) {
    // s meets n_e, p meets n_o.
    const double n_o = 1.6584, n_e = 1.4864, K = 0.7, q = std::sqrt(1 - K * K);
    const Answer a = oracle::solve({k_plain, {n_o, n_e, n_o}, 1, {K, 0, 0}});
    const double q_e = std::sqrt(n_e * n_e - K * K), q_o = std::sqrt(n_o * n_o - K * K);
    EXPECT_NEAR(std::abs(a.back[0][0] - (q - q_e) / (q + q_e)), 0, 1e-14);
    EXPECT_NEAR(std::abs(a.back[1][1] - (n_o * n_o * q - q_o) / (n_o * n_o * q + q_o)), 0, 1e-14);
    EXPECT_NEAR(std::norm(a.into[0][1]), 4 * q * q_e / ((q + q_e) * (q + q_e)), 1e-14);
    EXPECT_LT(std::abs(a.into[0][0]) + std::abs(a.into[1][1]), 1e-30);
}

TEST(FaceOracle, WavesOfATiltedAxisObeyTheIndexFormula) {
    // Born & Wolf 15.3.2 (12): 1/n^2 = cos^2/n_o^2 + sin^2/n_e^2, and the ray along eps N.
    const double n_o = 1.925, n_e = 1.984;
    const Vec3 axis = glm::normalize(Vec3{0.3, -0.5, 0.6}), beside = perpendicular_to(axis);
    const Answer a = oracle::solve(
        {{axis, beside, glm::cross(axis, beside)}, {n_e, n_o, n_o}, 1, {0.5, 0.6, 0}});
    for (const auto& pair : {a.towards, a.away}) {
        EXPECT_NEAR(std::sqrt(squared_length(pair[0].N)), n_o, 1e-14);
        const Vec3 N{pair[1].N.x.real(), pair[1].N.y.real(), pair[1].N.z.real()};
        const double cosine = glm::dot(glm::normalize(N), axis);
        EXPECT_NEAR(1 / glm::dot(N, N),
                    cosine * cosine / (n_o * n_o) + (1 - cosine * cosine) / (n_e * n_e), 1e-14);
        const Vec3 eps_N = n_o * n_o * N + (n_e * n_e - n_o * n_o) * glm::dot(axis, N) * axis;
        EXPECT_NEAR(glm::length(pair[1].ray - glm::normalize(eps_N)), 0, 1e-14);
    }
}

TEST(FaceOracle, WavesOfThreeEqualIndicesThatDoNotTravelAreThoseOfGlass) {
    // Fresnel with an imaginary q inside (Born & Wolf 1.5.4): all is reflected, with the phases of
    // s and p.
    const double n = 1.3, n_outside = 1.4, K = 1.39, q = std::sqrt(n_outside * n_outside - K * K);
    const Complex inside{0, std::sqrt(K * K - n * n)};
    const double outer = n_outside * n_outside, inner = n * n;
    for (unsigned seed = 1; seed <= 10; ++seed) {
        const Answer a =
            oracle::solve({RandomAttitudes(seed).frame(), {n, n, n}, n_outside, {K, 0, 0}});
        EXPECT_LT(a.imbalance, 1e-40);
        for (const oracle::Wave& wave : a.towards) EXPECT_FALSE(wave.propagates);
        EXPECT_NEAR(std::abs(a.back[0][0] - (q - inside) / (q + inside)), 0, 1e-14);
        EXPECT_NEAR(
            std::abs(a.back[1][1] - (inner * q - outer * inside) / (inner * q + outer * inside)), 0,
            1e-14);
        EXPECT_LT(std::abs(a.back[0][1]) + std::abs(a.back[1][0]), 1e-30);
    }
}

}  // namespace
}  // namespace culet
