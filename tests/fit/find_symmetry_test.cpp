// Symmetry detected from readings: which group, how sure, and how far the stone is from it.
#include "fit/fit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <glm/geometric.hpp>
#include <map>

#include "fit/uncertainty/variance_component.h"
#include "stone/cuts/cuts.h"
#include "stone/text/errors.h"
#include "tests/fit/test_stones.h"

namespace culet {
namespace {

using namespace test;

const GroupTest& group(const SymmetryReport& report, const std::string& name) {
    for (const GroupTest& g : report.groups) {
        if (g.group == name) return g;
    }
    throw std::runtime_error("no group " + name);
}

/// A cut of n-fold symmetry: table, n bezels, 2n upper halves, 2n girdle facets, 2n lower halves, n
/// mains that meet in the culet. `off` is added to each facet's angles, by tier and number.
Solid fold(int n, const std::function<Vec3(char, int)>& off = {}) {
    std::vector<NamedPlane> planes{{"T", {{0, 0, 1}, 0.55}}};
    const auto tier = [&](char letter, int count, double first_deg, double inclination_deg,
                          bool below, double offset) {
        for (int k = 0; k < count; ++k) {
            const Vec3 by = off ? off(letter, k) : Vec3(0);
            planes.push_back(
                {fmt::format("{}{}", letter, k + 1),
                 {direction(inclination_deg + by.x, first_deg + 360.0 * k / count + by.y, below),
                  offset + by.z}});
        }
    };
    const double half = 90.0 / n;
    // Halves cut off the ridge between two bezels (mains) at 0.8 of the radius.
    const auto through_ridge = [&](double main_deg, double main_offset, double half_deg) {
        const double ridge = radians(180.0 / n), m = radians(main_deg), h = radians(half_deg);
        const double z = (main_offset - 0.8 * std::sin(m) * std::cos(ridge)) / std::cos(m);
        return 0.8 * std::sin(h) * std::cos(radians(half)) + z * std::cos(h);
    };
    tier('C', n, 0, 35, false, 0.78);
    tier('U', 2 * n, half, 43, false, through_ridge(35, 0.78, 43));
    tier('G', 2 * n, half, 90, false, 1);
    tier('L', 2 * n, half, 44, true, through_ridge(41, 0.85, 44));
    tier('P', n, 0, 41, true, 0.85);
    return enclosed(planes);
}

// By construction: n bezels and n mains about one axis, with mirror planes through them.
TEST(FindSymmetry, OfStonesOfAnyFold) {
    for (const int n : {3, 5, 6, 8}) {
        const Solid truth = fold(n);
        ASSERT_EQ(truth.facets.size(), std::size_t(1 + 8 * n));
        const SymmetryReport report =
            find_symmetry(stone_of(truth), noisy(readings_of(truth, 0.1, 0.003), 5));
        EXPECT_EQ(report.form, fmt::format("C{}v", n));
        EXPECT_EQ(report.proposed, report.form) << report.message;
        const GroupTest& g = report.groups.front();
        EXPECT_EQ(g.tested, g.conditions);
        EXPECT_GT(g.p, 0.001);
        // Every facet's angles were read to 0.1 degrees, which bounds how far the stone may be from
        // symmetric.
        EXPECT_LT(degrees(report.sigma), 0.05);
        EXPECT_THAT(report.readings.front(),
                    ::testing::HasSubstr(fmt::format("of = [\"{}\"], exact = true", n)));
    }
}

// Facets are turned by N(0, 0.3 degrees) in both directions and read to 0.05: no exact symmetry.
// The estimate must agree to 12 % with the root mean square of the numbers drawn (inclinations
// about their tier's mean). The readings' 0.05 add in square; the rest comes from offsets that did
// not turn with their planes and from the choice of the axis.
TEST(FindSymmetry, OfAnApproximatelySymmetricStone) {
    for (const int n : {3, 8}) {
        std::mt19937_64 random(40u + unsigned(n));
        std::normal_distribution<double> normal(0, 0.3);
        std::map<char, std::vector<double>> leant;
        double squares = 0, count = 0;
        const Solid truth = fold(n, [&](char letter, int) {
            const double inclination_deg = letter == 'C'   ? 35
                                           : letter == 'U' ? 43
                                           : letter == 'G' ? 90
                                           : letter == 'L' ? 44
                                                           : 41;
            const double a = normal(random), b = normal(random);
            leant[letter].push_back(a);
            squares += b * b;
            count += 1;
            return Vec3{a, b / std::sin(radians(inclination_deg)), 0};
        });
        for (const auto& [letter, values] : leant) {
            double mean = 0;
            for (double v : values) mean += v / double(values.size());
            for (double v : values) squares += (v - mean) * (v - mean);
            count += double(values.size()) - 1;
        }
        ASSERT_EQ(truth.facets.size(), std::size_t(1 + 8 * n));
        const Stone stone = stone_of(fold(n));
        FitOptions options;
        options.meets = MeetTreatment::released;
        const std::vector<Reading> readings = plane_readings(stone.solid, truth, 0.05, 0.003);
        const SymmetryReport report = find_symmetry(stone, noisy(readings, 6), options);
        EXPECT_EQ(report.form, fmt::format("C{}v", n));
        EXPECT_EQ(report.proposed, "C1") << report.message;
        EXPECT_THAT(report.message, ::testing::HasSubstr("denied"));
        EXPECT_NEAR(degrees(report.sigma) / std::sqrt(squares / count), 1, 0.12) << n;
        EXPECT_LT(degrees(report.sigma_sigma), 0.04) << n;
        EXPECT_THAT(report.readings.front(), ::testing::HasSubstr("sigma = "));
    }
}

// With known variances v_i the estimate is unbiased, and its limit holds in 95 of 100 cases: 400
// draws of 40 contrasts.
TEST(VarianceComponent, IsHonest) {
    std::mt19937_64 random(1);
    std::normal_distribution<double> normal;
    for (const double truth : {0.0, 0.5, 2.0}) {
        double squares = 0, sigma = 0, kept = 0;
        const int draws = 400;
        for (int d = 0; d < draws; ++d) {
            Contrasts contrasts;
            for (int i = 0; i < 40; ++i) {
                const double v = 0.25 + 0.05 * i;
                contrasts.variances.push_back(v);
                contrasts.values.push_back(std::sqrt(v + truth * truth) * normal(random));
            }
            const VarianceComponent found = variance_component(contrasts);
            squares += found.sigma * found.sigma / draws;
            sigma += found.sigma_sigma / draws;
            kept += (found.at_most >= truth ? 1.0 : 0.0) / draws;
        }
        // The mean variance has a standard error of sigma^2 sqrt(2 / 40) / sqrt(400). Negative
        // estimates are set to zero.
        EXPECT_NEAR(squares, truth * truth, truth == 0 ? 0.2 : 0.08 + 0.02 * truth * truth);
        EXPECT_GT(kept, 0.93);
        if (truth > 1) {
            EXPECT_LT(kept, 0.98);
            // For large sigma its standard error is sigma / sqrt(2 n).
            EXPECT_NEAR(sigma, truth / std::sqrt(80.0), 0.1);
        }
    }
}

// A stone whose table alone is tilted: the group is rejected, and the findings about tiers show
// why.
TEST(FindSymmetry, ATiltedTableIsFoundOut) {
    // The table becomes an independent plane: with the meets at its corners released, nothing else
    // moves.
    Solid design = fold(8);
    std::vector<NamedPlane> planes;
    for (const Facet& f : design.facets) {
        planes.push_back({f.name, f.plane});
        if (f.name == "T") planes.back().plane.normal = direction(0.8, 30);
    }
    Solid truth = intersect_half_spaces(planes).solid;
    ASSERT_EQ(truth.facets.size(), design.facets.size());
    const Vec3 up = truth.facets[std::size_t(find_facet(truth, "T"))].plane.normal;
    const Vec3 axis = glm::cross(up, Vec3{0, 0, 1});
    const auto level = [&](const Vec3& v) {
        return v * up.z + glm::cross(axis, v) + axis * (glm::dot(axis, v) / (1 + up.z));
    };
    for (Vec3& v : truth.vertices) v = level(v);
    for (Facet& f : truth.facets) f.plane.normal = level(f.plane.normal);
    const SymmetryReport report =
        find_symmetry(stone_of(design), noisy(plane_readings(design, truth, 0.05, 0.003), 6));
    EXPECT_EQ(report.form, "C8v");
    for (const TierSymmetry& t : report.tiers) {
        if (t.tier == "T") {
            EXPECT_NEAR(degrees(t.deviation), 0.8, 0.05);
            EXPECT_LT(t.p, 1e-6);
        } else {
            EXPECT_GT(t.p, 1e-4) << t.tier;
            EXPECT_LT(degrees(t.deviation), 0.1) << t.tier;
        }
    }
}

// All pavilion facets of a symmetric stone are turned together by d = 0.75 degrees. Each tier is as
// symmetric as before about an axis of its own, but the stone is not. A turn by d about a
// horizontal axis changes inclination and azimuth (times the sine) of a tier of n facets at
// inclination i by a sum of squares of d^2 n (1 + cos^2 i) / 2. The best common axis lies between
// crown (sum a) and pavilion (sum b) and leaves d^2 a b / (a + b), spread over all contrasts: the
// scatter expected here.
TEST(FindSymmetry, APavilionAskewIsFarFromSymmetric) {
    const double d = radians(0.75);
    const auto turned = [&](double inclination_deg, double azimuth_deg) {
        const Vec3 n = direction(inclination_deg, azimuth_deg, true);
        const Vec3 m{std::cos(d) * n.x + std::sin(d) * n.z, n.y,
                     std::cos(d) * n.z - std::sin(d) * n.x};
        return Vec3{degrees(std::acos(-m.z)) - inclination_deg,
                    std::remainder(degrees(std::atan2(m.y, m.x)) - azimuth_deg, 360), 0};
    };
    const Solid truth = fold(8, [&](char letter, int k) {
        if (letter == 'L') return turned(44, 11.25 + 22.5 * k);
        return letter == 'P' ? turned(41, 45.0 * k) : Vec3(0);
    });
    ASSERT_EQ(truth.facets.size(), 65u);
    const auto square = [](int n, double inclination_deg) {
        const double c = std::cos(radians(inclination_deg));
        return 0.5 * n * (1 + c * c);
    };
    const double a = square(1, 0) + square(8, 35) + square(16, 43) + square(16, 90),
                 b = square(16, 44) + square(8, 41);
    // Two directions per facet, less a mean inclination per tier, two tilts and a turn.
    const double contrasts = 2 * 65 - 5 - 3;
    FitOptions options;
    options.meets = MeetTreatment::released;
    const Stone stone = stone_of(fold(8));
    const SymmetryReport report =
        find_symmetry(stone, noisy(plane_readings(stone.solid, truth, 0.05, 0.003), 6), options);
    EXPECT_EQ(report.form, "C8v");
    EXPECT_EQ(report.proposed, "Cs") << report.message;
    EXPECT_NEAR(report.sigma / (d * std::sqrt(a * b / (a + b) / contrasts)), 1, 0.12);
}

TEST(FindSymmetry, IsLeftOpenWhereNothingWasRead) {
    const Solid truth = fold(6);
    const SymmetryReport report = find_symmetry(
        stone_of(truth), {depth(truth, 0.01), width(truth, 0, 0.01), width(truth, 30, 0.01)});
    EXPECT_EQ(report.form, "C6v");
    EXPECT_EQ(report.proposed, "C1");
    EXPECT_THAT(report.message, ::testing::HasSubstr("leave C6v open"));
    EXPECT_LT(report.groups.front().tested, 6);
}

TEST(FindSymmetry, OfAStoneWithoutAny) {
    std::mt19937_64 random(4);
    std::normal_distribution<double> normal;
    std::vector<NamedPlane> planes{{"T", {{0, 0, 1}, 0.5}}};
    for (int i = 0; i < 20; ++i) {
        const Vec3 n = glm::normalize(Vec3{normal(random), normal(random), normal(random)});
        planes.push_back({fmt::format("f{}", i), {n, 1}});
    }
    const Solid truth = enclosed(planes);
    const SymmetryReport report = find_symmetry(stone_of(truth), readings_of(truth, 0.1, 0.01));
    EXPECT_EQ(report.form, "C1");
    EXPECT_EQ(report.proposed, "C1");
}

// The linear test must agree with its definition: chi-square of a fit with exact rotations and
// mirrors less that of the free fit, over the difference in degrees of freedom. Rotations and
// mirrors in readings are about the table's normal, as in the test for a stone whose table is its
// datum.
TEST(FindSymmetry, AgreesWithASymmetricFit) {
    const Solid truth = fold(6);
    const std::vector<Reading> readings = noisy(plane_readings(truth, truth, 0.05, 0.003), 8);
    const FitResult free = fit_stone(stone_of(truth), readings);
    const SymmetryReport report = find_symmetry(stone_of(truth), readings);
    std::vector<Reading> symmetric = readings;
    Reading turn = reading(ReadingKind::rotation, {}, 0, 0);
    turn.exact = true;
    turn.order = 6;
    symmetric.push_back(turn);
    const FitResult six = fit_stone(stone_of(truth), symmetric);
    ASSERT_EQ(six.status, FitStatus::converged) << six.message;
    const GroupTest& test = group(report, "C6");
    EXPECT_NEAR(six.statistics.dof - free.statistics.dof, test.conditions, 1e-6);
    EXPECT_EQ(test.tested, test.conditions);
    EXPECT_NEAR(six.statistics.chi2 - free.statistics.chi2, test.chi2, 0.02 * test.chi2);
}

TEST(FindSymmetry, OfAStepCut) {
    const Solid truth = make_cut("step");
    const SymmetryReport report =
        find_symmetry(stone_of(truth), noisy(readings_of(truth, 0.1, 0.01), 5));
    EXPECT_EQ(report.proposed, "C2v") << report.message;
}

// Under true symmetry p is uniform: the mean of 16 has a standard deviation of 0.29 / 4.
TEST(FindSymmetry, PValuesAreUniform) {
    const Solid truth = fold(5);
    double mean = 0;
    const int stones = 16;
    for (unsigned seed = 1; seed <= stones; ++seed) {
        const SymmetryReport report =
            find_symmetry(stone_of(truth), noisy(readings_of(truth, 0.1, 0.003), seed));
        mean += group(report, "C5v").p / stones;
    }
    EXPECT_NEAR(mean, 0.5, 4 * 0.29 / std::sqrt(double(stones)));
}

}  // namespace
}  // namespace culet
