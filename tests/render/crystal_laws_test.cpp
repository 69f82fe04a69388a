// Laws that culet's crystal faces must obey: Maxwell's equations, unitarity, reciprocity, the
// limits of higher symmetry; and absorption against complex wave vectors in 100 digits.

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "render/optics/complex_vector.h"
#include "render/optics/fresnel.h"
#include "tests/random_attitudes.h"
#include "tests/render/face_judge.h"

namespace culet {
namespace {

using oracle::Answer;
using oracle::Face;

// Uniaxial of both signs and biaxial, in any orientation, with any K that some wave or air has.
Face random_face(RandomAttitudes& chance) {
    const double n = chance.between(1.2, 2.6), d = std::pow(10.0, chance.between(-6, -0.6));
    const std::array<double, 3> middle{n + d, n, n + chance.between(0, 1) * d};
    const Vec3 normal = chance.direction();
    const double K = chance.between(0, chance.one_of(2) == 0 ? 1 : n);
    return {
        chance.frame(), {n, middle[chance.one_of(3)], n + d}, 1, chance.across(normal, K), normal};
}

TEST(CrystalModes, ObeyMaxwellsEquations) {
    // Tolerance: some ten roundings of terms of size n^2 |E|.
    RandomAttitudes chance(101);
    double worst = 0;
    for (int i = 0; i < 3000; ++i) {
        const Face face = random_face(chance);
        const Crystal crystal(face.axes, face.n);
        for (const double side : {1.0, -1.0})
            for (const CrystalMode& mode : modes_towards(crystal, face.K, side * face.normal)) {
                if (!mode.propagates) continue;
                const Vec3 N = mode.wave;
                const double n2 = face.n[2] * face.n[2];
                ComplexVec3 D{};
                for (int k = 0; k < 3; ++k) {
                    D = D + face.n[k] * face.n[k] * dot(face.axes[k], mode.E) *
                                complex_of(face.axes[k]);
                }
                const ComplexVec3 H = cross(complex_of(N), mode.E);
                const auto off = [&](const ComplexVec3& v, double size) {
                    const double error = std::sqrt(squared_length(v)) / size;
                    worst = std::max(worst, error);
                    return error;
                };
                const double tolerance = 1e-14;
                // N x H = -D (Fresnel's equation for its field); D.N = 0; H = N x E.
                EXPECT_LE(off(cross(complex_of(N), mode.H) + D, n2), tolerance) << described(face);
                EXPECT_LE(std::abs(dot(N, D)) / (n2 * face.n[2]), tolerance);
                EXPECT_LE(off(mode.H + Complex(-1) * H, face.n[2]), tolerance);
                EXPECT_NEAR(squared_length(mode.E), 1, tolerance);
                const Vec3 K = N - glm::dot(N, face.normal) * face.normal;
                EXPECT_LE(glm::length(K - face.K), tolerance * face.n[2]);
                const ComplexVec3 flow =
                    cross(mode.E, {std::conj(mode.H.x), std::conj(mode.H.y), std::conj(mode.H.z)});
                const Vec3 S{flow.x.real(), flow.y.real(), flow.z.real()};
                EXPECT_LE(glm::length(S - mode.flux * mode.ray), tolerance * face.n[2]);
                EXPECT_GT(side * glm::dot(mode.ray, face.normal), 0);
            }
    }
    RecordProperty("worst", std::to_string(worst * 1e16) + "e-16");
}

TEST(CrystalFaces, ScatteringMatrixIsUnitary) {
    // Columns: the two waves from inside, s and p from outside, with their phases. s and p change
    // sign with the face's normal.
    RandomAttitudes chance(102);
    double worst = 0;
    int square = 0;
    for (int i = 0; i < 3000; ++i) {
        const Face face = random_face(chance);
        const Crystal crystal(face.axes, face.n);
        std::vector<std::array<Complex, 4>> columns;
        double imbalance = 0;
        for (const CrystalMode& mode : modes_towards(crystal, face.K, face.normal)) {
            if (!mode.propagates) continue;
            const CrystalHit hit = hit_face(crystal, 1, mode, face.K, face.normal);
            columns.push_back({hit.amplitude[0], hit.amplitude[1], hit.out[0], hit.out[1]});
            imbalance = std::max(imbalance, hit.imbalance);
        }
        if (glm::length(face.K) < 1) {
            const CrystalEntry entry = enter_crystal(crystal, 1, face.K, -face.normal);
            for (int j = 0; j < 2; ++j)
                columns.push_back(
                    {entry.into[j][0], entry.into[j][1], -entry.back[j][0], -entry.back[j][1]});
        }
        square += columns.size() == 4;
        for (std::size_t a = 0; a < columns.size(); ++a)
            for (std::size_t b = 0; b <= a; ++b) {
                Complex product = 0;
                for (int k = 0; k < 4; ++k) product += std::conj(columns[a][k]) * columns[b][k];
                const double error = std::abs(product - (a == b ? 1.0 : 0.0));
                worst = std::max(worst, error);
                EXPECT_LE(error, 1e-13) << a << ' ' << b << '\n' << described(face);
            }
    }
    EXPECT_GT(square, 1000);
    RecordProperty("worst", std::to_string(worst * 1e13) + "e-13");
}

TEST(CrystalFaces, PowerIsTheSameWithAllWavesReversed) {
    RandomAttitudes chance(103);
    double worst = 0;
    const auto same = [&](double a, double b, const Face& face) {
        worst = std::max(worst, std::abs(a - b));
        EXPECT_NEAR(a, b, 1e-13) << described(face);
    };
    for (int i = 0; i < 3000; ++i) {
        const Face face = random_face(chance);
        const Crystal crystal(face.axes, face.n);
        const Vec3 n = face.normal, K = face.K;
        const auto forward = modes_towards(crystal, K, n), reversed = modes_towards(crystal, -K, n);
        std::array<CrystalHit, 2> there, back;
        for (int m = 0; m < 2; ++m) {
            if (forward[m].propagates) there[m] = hit_face(crystal, 1, forward[m], K, n);
            if (reversed[m].propagates) back[m] = hit_face(crystal, 1, reversed[m], -K, n);
        }
        for (int a = 0; a < 2; ++a)
            for (int b = 0; b < 2; ++b)
                if (forward[a].propagates && reversed[b].propagates) {
                    same(there[a].power[b], back[b].power[a], face);
                }
        if (glm::length(K) >= 1) continue;
        const CrystalEntry entry = enter_crystal(crystal, 1, -K, -n);
        for (int m = 0; m < 2; ++m)
            for (int j = 0; j < 2; ++j)
                if (forward[m].propagates) {
                    same(std::norm(there[m].out[j]), entry.power[j][m], face);
                }
    }
    RecordProperty("worst", std::to_string(worst * 1e13) + "e-13");
}

TEST(CrystalFaces, TwoEqualIndicesAreUniaxialInAnyOrder) {
    RandomAttitudes chance(104);
    for (int i = 0; i < 100; ++i) {
        const Face face = random_face(chance);
        const Vec3 axis = face.axes[0];
        const double n_e = 1.55, n_o = 1.65;
        const Crystal u = uniaxial_crystal(axis, n_o, n_e);
        const CrystalEntry expected = enter_crystal(u, 1.7, face.K, face.normal);
        for (int odd = 0; odd < 3; ++odd) {
            std::array<Vec3, 3> axes;
            std::array<double, 3> n{n_o, n_o, n_o};
            for (int k = 0; k < 3; ++k) axes[(odd + k) % 3] = face.axes[k];
            n[odd] = n_e;
            const Crystal crystal(axes, n);
            ASSERT_FALSE(crystal.biaxial());
            const CrystalEntry entry = enter_crystal(crystal, 1.7, face.K, face.normal);
            for (int j = 0; j < 2; ++j)
                for (int m = 0; m < 2; ++m) {
                    EXPECT_NEAR(entry.power[j][m], expected.power[j][m], 1e-15);
                    EXPECT_NEAR(std::abs(entry.back[j][m] - expected.back[j][m]), 0, 1e-15);
                }
        }
    }
}

TEST(CrystalFaces, ThreeEqualIndicesAreFresnelsFace) {
    RandomAttitudes chance(105);
    for (int i = 0; i < 300; ++i) {
        const Face face = random_face(chance);
        const double n = face.n[0], k = glm::length(face.K);
        if (k >= n) continue;
        const Crystal crystal(face.axes, {n, n, n});
        ASSERT_TRUE(crystal.isotropic());
        double transmitted = 0, reflected = 0;
        for (const CrystalMode& mode : modes_towards(crystal, face.K, face.normal)) {
            const CrystalHit hit = hit_face(crystal, 1, mode, face.K, face.normal);
            transmitted += hit.transmitted;
            reflected += hit.power[0] + hit.power[1];
        }
        const FaceAmplitudes out = fresnel(n, 1, std::sqrt((n - k) * (n + k)));
        EXPECT_NEAR(transmitted, out.t_s * out.t_s + out.t_p * out.t_p, 1e-12);
        EXPECT_NEAR(reflected, std::norm(out.r_s) + std::norm(out.r_p), 1e-12);
        if (k >= 1) continue;
        const CrystalEntry entry = enter_crystal(crystal, 1, face.K, face.normal);
        const FaceAmplitudes in = fresnel(1, n, std::sqrt((1 - k) * (1 + k)));
        EXPECT_NEAR(std::abs(entry.back[0][0] - in.r_s), 0, 1e-13);
        EXPECT_NEAR(std::abs(entry.back[1][1] - in.r_p), 0, 1e-13);
        EXPECT_NEAR(std::abs(entry.back[0][1]) + std::abs(entry.back[1][0]), 0, 1e-13);
        EXPECT_NEAR(entry.power[0][0] + entry.power[0][1], in.t_s * in.t_s, 1e-13);
        EXPECT_NEAR(entry.power[1][0] + entry.power[1][1], in.t_p * in.t_p, 1e-13);
    }
}

TEST(CrystalModes, AbsorbAsTheImaginaryWaveVectorSays) {
    // n_i + i kappa_i: K_i = 2 kappa_i per unit of 1/k0. Per length of ray the intensity falls by 2
    // Im N . ray, both for a homogeneous wave (Im N along N) and for one driven by a face (Im N
    // along n). The oracle's error is of second order, 1e-35.
    RandomAttitudes chance(106);
    double worst = 0;
    for (int i = 0; i < 150; ++i) {
        const Face face = random_face(chance);
        // Absorption has the symmetry of the indices.
        const double first = chance.between(0, 1), last = chance.between(0, 1);
        const double middle = face.n[1] == face.n[0]   ? first
                              : face.n[1] == face.n[2] ? last
                                                       : chance.between(0, 1);
        const std::array<double, 3> kappa{first, middle, last};
        const Crystal crystal(face.axes, face.n);
        const Answer answer = oracle::solve(face);
        const oracle::Attenuation truth = oracle::attenuation(face, kappa);
        const auto modes = modes_towards(crystal, face.K, face.normal);
        for (int m = 0; m < 2; ++m) {
            if (!modes[m].propagates || !answer.towards[m].propagates) continue;
            if (glm::dot(modes[m].ray, face.normal) < 1e-2 || answer.gap_towards < 1e-4) continue;
            const std::array<double, 3> shares = absorption_shares(crystal, modes[m]);
            const double alpha =
                2 * (shares[0] * kappa[0] + shares[1] * kappa[1] + shares[2] * kappa[2]);
            const double a = 2 * truth.across_face[m] * glm::dot(face.normal, modes[m].ray);
            const double b =
                2 * truth.along_normal[m] * glm::dot(glm::normalize(modes[m].wave), modes[m].ray);
            worst = std::max({worst, std::abs(alpha - a), std::abs(alpha - b)});
            EXPECT_NEAR(alpha, a, 1e-12) << described(face);
            EXPECT_NEAR(alpha, b, 1e-12) << described(face);
        }
    }
    EXPECT_GT(worst, 0);
    RecordProperty("worst", std::to_string(worst * 1e13) + "e-13");
}

}  // namespace
}  // namespace culet
