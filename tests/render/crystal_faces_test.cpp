// Faces of crystals against the independent derivation in 100 digits of face_oracle.h, family by
// family. Tolerance: 1e-12 on amplitudes, powers, wave normals and rays, or the effect of the
// input's last digits (face_judge.h). Random cases have fixed seeds.
//
// Next to singular directions, where exact input matters, the face normal is (0, 0, 1) and K lies
// along x: both are then exact, and |K| is the double given.

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "tests/random_attitudes.h"
#include "tests/render/face_judge.h"

namespace culet {
namespace {

using oracle::Face;

constexpr std::array<Vec3, 3> k_plain{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};

double largest(const std::array<double, 3>& n) {
    return std::max({n[0], n[1], n[2]});
}

struct Gem {
    const char* name;
    std::array<double, 3> n;
};
// n_D, rounded: Deer, Howie & Zussman, Rock-forming Minerals; uniaxial as {n_e, n_o, n_o}.
const std::vector<Gem> k_gems{
    {"sapphire", {1.760, 1.768, 1.768}},   {"zircon", {1.984, 1.925, 1.925}},
    {"calcite", {1.4864, 1.6584, 1.6584}}, {"topaz", {1.619, 1.622, 1.627}},
    {"peridot", {1.654, 1.671, 1.689}},    {"andalusite", {1.634, 1.639, 1.645}}};

// The lengths |K| along x at which the number of waves towards n falls to 1 and to 0, found with
// the oracle: the last doubles with the larger number.
std::array<double, 2> critical_lengths(Face face) {
    std::array<double, 2> found{};
    for (int left = 1; left >= 0; --left) {
        double low = 0, high = 1.01 * largest(face.n);
        for (;;) {
            const double middle = 0.5 * (low + high);
            if (middle == low || middle == high) break;
            face.K = {middle, 0, 0};
            const oracle::Answer a = oracle::solve(face);
            const int count = a.towards[0].propagates + a.towards[1].propagates;
            (count > left ? low : high) = middle;
        }
        found[1 - left] = low;
    }
    return found;
}

std::vector<double> around(double length, double first = 1e-3, double last = 1e-14) {
    std::vector<double> lengths{length};
    for (double t = first; t > 0.5 * last; t *= 0.1) {
        lengths.push_back(length * (1 - t));
        lengths.push_back(length * (1 + t));
    }
    return lengths;
}

TEST(CrystalFaces, UniaxialOfEitherSignAtRandom) {
    RandomAttitudes chance(1);
    FaceJudge judge;
    for (int i = 0; i < 120; ++i) {
        const double n_o = chance.between(1.01, 4), n_e = n_o + chance.between(-0.3, 0.3);
        const double n_outside = i % 3 == 0 ? chance.between(1, 3) : 1;
        if (n_e < 1) continue;
        const Vec3 n = chance.direction();
        const std::array<double, 3> indices{n_e, n_o, n_o};
        const double K = chance.between(0, i % 2 ? largest(indices) : n_outside);
        judge.compare({chance.frame(), indices, n_outside, chance.across(n, K), n});
    }
    EXPECT_LT(judge.excused(), 0.02 * judge.faces());
}

TEST(CrystalFaces, BiaxialAtRandom) {
    RandomAttitudes chance(2);
    FaceJudge judge;
    for (int i = 0; i < 120; ++i) {
        const double n1 = chance.between(1.01, 4);
        const std::array<double, 3> indices{n1, n1 + chance.between(0, 0.3),
                                            n1 + chance.between(0, 0.3)};
        const double n_outside = i % 3 == 0 ? chance.between(1, 3) : 1;
        const Vec3 n = chance.direction();
        const double K = chance.between(0, i % 2 ? largest(indices) : n_outside);
        judge.compare({chance.frame(), indices, n_outside, chance.across(n, K), n});
    }
    EXPECT_LT(judge.excused(), 0.02 * judge.faces());
}

TEST(CrystalFaces, GemsAtRandom) {
    RandomAttitudes chance(3);
    FaceJudge judge;
    for (const Gem& gem : k_gems)
        for (int i = 0; i < 16; ++i) {
            const Vec3 n = chance.direction();
            const double K = chance.between(0, i % 2 ? largest(gem.n) : 1);
            judge.compare({chance.frame(), gem.n, 1, chance.across(n, K), n});
        }
    EXPECT_LT(judge.excused(), 0.02 * judge.faces());
}

TEST(CrystalFaces, GrazingFromOutside) {
    RandomAttitudes chance(4);
    FaceJudge judge;
    for (const Gem& gem : k_gems) {
        const std::array<Vec3, 3> axes = chance.frame();
        for (double angle = 1e-3; angle > 5e-13; angle *= 0.1)
            judge.compare({axes, gem.n, 1, {std::cos(angle), 0, 0}});
        judge.compare({axes, gem.n, 1, {1, 0, 0}});
    }
}

TEST(CrystalFaces, CloseToNormalIncidence) {
    // K is the difference of two long vectors: not quite in the face.
    RandomAttitudes chance(19);
    FaceJudge judge;
    for (const Gem& gem : k_gems)
        for (double angle = 1e-2; angle > 5e-14; angle *= 0.1) {
            const Vec3 n = chance.direction();
            const Vec3 N = 1.7 * glm::normalize(n + angle * chance.direction());
            judge.compare({chance.frame(), gem.n, 1, N - glm::dot(N, n) * n, n});
        }
}

TEST(CrystalFaces, AtTheCriticalAngleOfTheOutside) {
    RandomAttitudes chance(5);
    FaceJudge judge;
    for (const Gem& gem : k_gems) {
        const std::array<Vec3, 3> axes = chance.frame();
        for (const double K : around(1.0)) judge.compare({axes, gem.n, 1, {K, 0, 0}});
    }
}

// Each wave grazes from inside on one side of its critical length and is evanescent on the other.
TEST(CrystalFaces, GrazingFromInsideUniaxial) {
    RandomAttitudes chance(6);
    FaceJudge judge;
    for (int g = 0; g < 3; ++g) {
        const Face face{chance.frame(), k_gems[g].n, 1};
        for (const double critical : critical_lengths(face))
            for (const double K : around(critical))
                for (const double n_outside : {1.0, 2.4})
                    judge.compare({face.axes, face.n, n_outside, {K, 0, 0}});
    }
}

TEST(CrystalFaces, GrazingFromInsideBiaxial) {
    RandomAttitudes chance(7);
    FaceJudge judge;
    for (int g = 3; g < 6; ++g) {
        const Face face{chance.frame(), k_gems[g].n, 1};
        for (const double critical : critical_lengths(face))
            for (const double K : around(critical))
                for (const double n_outside : {1.0, 2.4})
                    judge.compare({face.axes, face.n, n_outside, {K, 0, 0}});
    }
}

TEST(CrystalFaces, InhibitedReflection) {
    RandomAttitudes chance(8);
    FaceJudge judge;
    for (const Gem& gem : k_gems) {
        const Face face{chance.frame(), gem.n, 1};
        const auto [first, second] = critical_lengths(face);
        for (const double share : {0.1, 0.5, 0.9})
            judge.compare({face.axes, gem.n, 1, {first + share * (second - first), 0, 0}});
    }
}

TEST(CrystalFaces, BrewsterFromBothSides) {
    RandomAttitudes chance(9);
    FaceJudge judge;
    for (const Gem& gem : k_gems)
        for (const double n_outside : {1.0, 1.33}) {
            const double e1 = n_outside * n_outside, e2 = gem.n[1] * gem.n[1];
            const double K = std::sqrt(e1 * e2 / (e1 + e2));
            judge.compare({chance.frame(), gem.n, n_outside, {K, 0, 0}});
            judge.compare({k_plain, gem.n, n_outside, {K, 0, 0}});
        }
}

TEST(CrystalFaces, PrincipalAxisAlongTheNormalInTheFaceAndAlongTheWave) {
    FaceJudge judge;
    const std::array<std::array<Vec3, 3>, 3> turns{
        {k_plain, {k_plain[1], k_plain[2], k_plain[0]}, {k_plain[2], k_plain[0], k_plain[1]}}};
    for (const Gem& gem : k_gems)
        for (const auto& axes : turns)
            for (const double K : {0.0, 1e-300, 1e-15, 1e-12, 1e-8, 0.3, 0.999, 1.2})
                for (const double azimuth : {0.0, 1.1})
                    if (K > 1e-13 || azimuth == 0) {
                        judge.compare(
                            {axes, gem.n, 1, {K * std::cos(azimuth), K * std::sin(azimuth), 0}});
                    }
}

TEST(CrystalFaces, WaveAlongTheAxisOfAUniaxialCrystalAndBesideIt) {
    // N = n_o (axis turned by `off`), the face oblique to it.
    RandomAttitudes chance(10);
    FaceJudge judge;
    for (int g = 0; g < 3; ++g)
        for (double off = 1e-1; off > 5e-14; off *= 0.1) {
            const std::array<Vec3, 3> axes = chance.frame();
            const Vec3 N = k_gems[g].n[1] * glm::normalize(axes[0] + off * axes[1]);
            const Vec3 n = glm::normalize(N + 0.8 * chance.direction());
            judge.compare({axes, k_gems[g].n, 1, N - glm::dot(N, n) * n, n});
        }
    for (int g = 0; g < 3; ++g)
        for (int i = 0; i < 4; ++i) {
            const std::array<Vec3, 3> axes = chance.frame();
            const Vec3 N = k_gems[g].n[1] * axes[0];
            const Vec3 n = i == 0 ? axes[0] : glm::normalize(N + 0.8 * chance.direction());
            judge.compare({axes, k_gems[g].n, 1, N - glm::dot(N, n) * n, n});
        }
}

TEST(CrystalFaces, UniaxialOfVanishingBirefringence) {
    RandomAttitudes chance(11);
    FaceJudge judge;
    for (double d = 1e-2; d > 5e-15; d *= 0.1)
        for (const double sign : {1.0, -1.0})
            for (int i = 0; i < 3; ++i) {
                const Vec3 n = chance.direction();
                judge.compare({chance.frame(),
                               {1.77 + sign * d, 1.77, 1.77},
                               1,
                               chance.across(n, chance.between(0, i == 2 ? 1.7 : 1)),
                               n});
            }
}

TEST(CrystalFaces, BiaxialOfVanishingBirefringence) {
    RandomAttitudes chance(12);
    FaceJudge judge;
    for (double d = 1e-2; d > 5e-15; d *= 0.1)
        for (const double middle : {0.1, 0.5, 0.7}) {
            const Vec3 n = chance.direction();
            judge.compare({chance.frame(),
                           {1.62, 1.62 + middle * d, 1.62 + d},
                           1,
                           chance.across(n, chance.between(0, middle > 0.6 ? 1.6 : 1)),
                           n});
        }
}

TEST(CrystalFaces, BiaxialWithTwoIndicesNearlyEqual) {
    RandomAttitudes chance(13);
    FaceJudge judge;
    for (double d = 1e-4; d > 5e-15; d *= 0.1)
        for (const double other : {1.60, 1.80})
            for (int i = 0; i < 2; ++i) {
                const Vec3 n = chance.direction();
                judge.compare({chance.frame(),
                               {other, 1.70, 1.70 + d},
                               1,
                               chance.across(n, chance.between(0, i == 1 ? 1.65 : 1)),
                               n});
            }
}

// An optic axis of a biaxial crystal (Born & Wolf 15.3.3), as N in the frame of rising indices.
Vec3 optic_axis(const std::array<Vec3, 3>& axes, const std::array<double, 3>& n) {
    const double e1 = n[0] * n[0], e2 = n[1] * n[1], e3 = n[2] * n[2];
    return glm::normalize(std::sqrt(e3 * (e2 - e1)) * axes[0] +
                          std::sqrt(e1 * (e3 - e2)) * axes[2]);
}

TEST(CrystalFaces, WaveBesideABiaxialOpticAxis) {
    RandomAttitudes chance(14);
    FaceJudge judge;
    for (int g = 3; g < 6; ++g)
        for (double off = 1e-2; off > 5e-13; off *= 0.1)
            for (int i = 0; i < 2; ++i) {
                const std::array<Vec3, 3> axes = chance.frame();
                const Vec3 axis = optic_axis(axes, k_gems[g].n);
                const Vec3 N = k_gems[g].n[1] * glm::normalize(axis + off * chance.across(axis, 1));
                const Vec3 n = i == 0 ? axis : glm::normalize(axis + 0.8 * chance.direction());
                judge.compare({axes, k_gems[g].n, 1, N - glm::dot(N, n) * n, n});
            }
}

TEST(CrystalFaces, WaveOnABiaxialOpticAxisToTheLastDigit) {
    RandomAttitudes chance(15);
    FaceJudge judge;
    for (int g = 3; g < 6; ++g)
        for (int i = 0; i < 6; ++i) {
            const std::array<Vec3, 3> axes = chance.frame();
            const Vec3 axis = optic_axis(axes, k_gems[g].n);
            const Vec3 n = i == 0 ? axis : glm::normalize(axis + 0.8 * chance.direction());
            const Vec3 N = k_gems[g].n[1] * axis;
            judge.compare({axes, k_gems[g].n, 1, N - glm::dot(N, n) * n, n});
        }
}

TEST(CrystalFaces, WaveExactlyOnABiaxialOpticAxis) {
    // 1/49^2 + 1/31^2 = 2/41^2: with indices in this ratio the optic axes of N are exactly at 45
    // degrees, as is a normal with two equal numbers.
    FaceJudge judge;
    const std::array<double, 3> n{1271.0 / 1024, 1519.0 / 1024, 2009.0 / 1024};
    const double half = std::sqrt(0.5);
    for (const double n_outside : {1.0, 1.33, 2.4})
        for (const double sign : {1.0, -1.0})
            judge.compare({k_plain, n, n_outside, {0, 0, 0}, {half, 0, sign * half}});
    // A plane face at 45 degrees to the axis: normal (0, 0, 1), K = n2 / sqrt(2) to rounding.
    judge.compare({k_plain, n, 1, {n[1] * half, 0, 0}});
}

TEST(CrystalFaces, OtherIndicesOutside) {
    RandomAttitudes chance(16);
    FaceJudge judge;
    for (const Gem& gem : k_gems)
        for (const double n_outside : {1.33, 1.63, 2.4, 4.0})
            for (const double share : {0.2, 0.6, 0.97}) {
                const Vec3 n = chance.direction();
                judge.compare(
                    {chance.frame(), gem.n, n_outside, chance.across(n, share * n_outside), n});
            }
}

TEST(CrystalFaces, TotalReflectionFromOutside) {
    // The outside is denser: no wave enters, all light is reflected, and the crystal mixes s and p.
    RandomAttitudes chance(17);
    FaceJudge judge;
    for (const Gem& gem : k_gems)
        for (const double K : {2.01, 2.2, 2.4 * (1 - 1e-9)}) {
            const Vec3 n = chance.direction();
            const Face face{chance.frame(), gem.n, 2.4, chance.across(n, K), n};
            judge.compare(face);
            const CrystalEntry entry =
                enter_crystal(Crystal(face.axes, face.n), face.n_outside, face.K, face.normal);
            for (int i = 0; i < 2; ++i) EXPECT_NEAR(entry.reflected[i], 1, 1e-15);
        }
}

TEST(CrystalFaces, IsotropicCrystalHasTwoWavesOfOneNormal) {
    RandomAttitudes chance(18);
    FaceJudge judge;
    for (int i = 0; i < 6; ++i) {
        const Vec3 n = chance.direction();
        judge.compare({chance.frame(), {1.7, 1.7, 1.7}, 1, chance.across(n, 0.28 * i), n});
    }
}

}  // namespace
}  // namespace culet
