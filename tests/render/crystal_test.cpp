// Expectations: closed forms of uniaxial crystals, Snell's law, conservation of power at a face.
// crystal_faces_test.cpp compares faces with 50-digit arithmetic.

#include "render/optics/crystal.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "render/optics/fresnel.h"

namespace {

using namespace culet;

TEST(Crystal, UniaxialOfEqualIndicesSendsThePowerOfAnIsotropicFace) {
    // n_o = n_e: at the first face the entering power is Fresnel's for any axis.
    const double n = 1.76;
    for (const double angle : {0.0, 0.3, 1.0, 1.5}) {
        const Vec3 n_into{0, 0, -1};
        const Vec3 K{std::sin(angle), 0, 0};
        const FaceAmplitudes face = fresnel(1, n, std::cos(angle));
        for (const Vec3& axis :
             {Vec3{0, 0, 1}, Vec3{1, 0, 0}, Vec3{0, 1, 0}, glm::normalize(Vec3{1, 2, 3})}) {
            const CrystalEntry entry = enter_crystal(uniaxial_crystal(axis, n, n), 1.0, K, n_into);
            EXPECT_NEAR(entry.reflected[0], std::norm(face.r_s), 1e-13) << angle;
            EXPECT_NEAR(entry.reflected[1], std::norm(face.r_p), 1e-13) << angle;
        }
    }
}

TEST(Crystal, UniaxialFaceConservesPowerAndSnellInEveryOrientation) {
    const unsigned seed = 1998;
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    double worst = 0;
    for (int i = 0; i < 4000; ++i) {
        const auto unit = [&] {
            return glm::normalize(Vec3{normal(random), normal(random), normal(random)});
        };
        const Vec3 n_out = unit();
        Vec3 axis = unit();
        if (i % 5 == 1) axis = n_out;  // axis along the normal
        if (i % 5 == 2) axis = glm::normalize(glm::cross(n_out, axis));
        const Crystal crystal = uniaxial_crystal(axis, 1.658, i % 3 == 0 ? 1.658 - 1e-9 : 1.486);
        // Any mode that runs towards the face, made by a face with the same orientation.
        const Vec3 tangent = glm::normalize(glm::cross(n_out, unit()));
        const Vec3 K = (i % 7 == 3 ? 0.0 : 1.4 * std::abs(normal(random)) / 2) * tangent;
        for (const CrystalMode& mode : modes_towards(crystal, K, n_out)) {
            if (!mode.propagates) continue;
            const CrystalHit hit = hit_face(crystal, 1.0, mode, n_out);
            worst = std::max(worst, hit.imbalance);
            for (const CrystalMode& reflected : hit.modes) {
                if (!reflected.propagates) continue;
                EXPECT_LE(glm::dot(reflected.ray, n_out), 1e-12);
                const Vec3 tangential = reflected.wave - glm::dot(reflected.wave, n_out) * n_out;
                EXPECT_NEAR(glm::length(tangential - K), 0, 1e-13);
            }
        }
    }
    // Rounding error over the incident normal flux, which reaches 1e-4 in these draws.
    EXPECT_LT(worst, 1e-10) << "seed " << seed;
}

TEST(Crystal, ExtraordinaryRayFollowsEpsTimesTheWaveNormal) {
    // t = eps N / |eps N| (Born & Wolf 15.3) and n(th) = no ne / sqrt(ne^2 + (no^2 - ne^2) sin^2
    // th).
    const Vec3 axis = glm::normalize(Vec3{0.2, 0.5, 0.8});
    const Crystal crystal = uniaxial_crystal(axis, 1.658, 1.486);
    const CrystalMode mode = modes_towards(crystal, {0.4, 0.2, 0}, {0, 0, 1})[1];
    ASSERT_TRUE(mode.propagates);
    const double eo = 1.658 * 1.658, ee = 1.486 * 1.486;
    const Vec3 eps_n = eo * mode.wave + (ee - eo) * glm::dot(axis, mode.wave) * axis;
    EXPECT_NEAR(glm::length(mode.ray - glm::normalize(eps_n)), 0, 1e-14);
    const double cosine = glm::dot(glm::normalize(mode.wave), axis), sin2 = 1 - cosine * cosine;
    EXPECT_NEAR(glm::length(mode.wave), 1.658 * 1.486 / std::sqrt(ee + (eo - ee) * sin2), 1e-14);
}

TEST(Crystal, PleochroicAbsorptionHasItsClosedForms) {
    // Ordinary: K_o in every direction. Extraordinary across the axis: K_e (notes of this house on
    // Guy & Soler 2004, eq. 7, which gives K_e (n_o/n_e)^2 there).
    const Crystal crystal = uniaxial_crystal({0, 0, 1}, 1.658, 1.486);
    const auto absorption_along = [&](const CrystalMode& mode) {
        const auto shares = absorption_shares(crystal, mode);
        return shares[0] * 1.1 + (shares[1] + shares[2]) * 0.3;
    };
    const auto across = modes_towards(crystal, {0, 0, 0}, {1, 0, 0});
    EXPECT_NEAR(absorption_along(across[0]), 0.3, 1e-15);
    EXPECT_NEAR(absorption_along(across[1]), 1.1, 1e-14);
    const auto along = modes_towards(crystal, {0, 0, 0}, {0, 0, 1});
    EXPECT_NEAR(absorption_along(along[0]), 0.3, 1e-15);
    EXPECT_NEAR(absorption_along(along[1]), 0.3, 1e-14);
}

}  // namespace
