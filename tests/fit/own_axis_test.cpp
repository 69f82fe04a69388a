// The stone's own axis, independent of the datum of its angles.
#include "fit/findings/own_axis.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "stone/cuts/cuts.h"
#include "tests/fit/test_stones.h"

namespace culet {
namespace {

using namespace test;

/// A brilliant whose table is tilted by `tilt_deg` towards azimuth 30 against the axis of the rest.
/// The stars pass through the table's corners and follow.
Solid with_tilted_table(double tilt_deg) {
    Solid solid = brilliant();
    const Vec3 normal = direction(tilt_deg, 30);
    const Facet table = solid.facets[std::size_t(find_facet(solid, "T"))];
    std::vector<NamedPlane> planes{through("T", normal, corner_mean(solid, table))};
    // Table corners move along the edges between bezel and star planes that end there, down along
    // the bezel. Each star passes through two moved corners and its old tip.
    const auto plane = [&](const std::string& name) {
        return solid.facets[std::size_t(find_facet(solid, name))].plane;
    };
    std::vector<Vec3> corners;
    for (int k = 0; k < 8; ++k) {
        // On bezel k, in the vertical plane of its azimuth.
        const Plane bezel = plane(fmt::format("C{}", k + 1));
        const double a = radians(45.0 * k);
        const Vec3 across{-std::sin(a), std::cos(a), 0};
        const glm::dmat3 rows = glm::transpose(glm::dmat3(normal, bezel.normal, across));
        corners.push_back(glm::inverse(rows) * Vec3{planes[0].plane.offset, bezel.offset, 0});
    }
    for (const Facet& f : solid.facets) {
        if (f.name == "T") continue;
        if (f.name[0] != 'S') {
            planes.push_back({f.name, f.plane});
            continue;
        }
        const std::size_t k = std::size_t(std::stoi(f.name.substr(1))) - 1;
        Vec3 tip{0, 0, 1e9};
        for (int c : f.corners) {
            if (solid.vertices[std::size_t(c)].z < tip.z) tip = solid.vertices[std::size_t(c)];
        }
        const Vec3 &left = corners[k], &right = corners[(k + 1) % 8];
        Vec3 n = glm::cross(right - left, tip - left);
        if (n.z < 0) n = -n;
        planes.push_back(through(f.name, n, tip));
    }
    return enclosed(planes);
}

/// The solid with its table level, as an instrument holds it.
Solid levelled(Solid solid) {
    const Vec3 up = solid.facets[std::size_t(find_facet(solid, "T"))].plane.normal;
    const Vec3 axis = glm::cross(up, Vec3{0, 0, 1});
    const auto level = [&](const Vec3& v) {
        return v * up.z + glm::cross(axis, v) + axis * (glm::dot(axis, v) / (1 + up.z));
    };
    for (Vec3& v : solid.vertices) v = level(v);
    for (Facet& f : solid.facets) f.plane.normal = level(f.plane.normal);
    return solid;
}

const Tier& tier(const FitResult& result, const std::string& name) {
    for (const Tier& t : result.findings.tiers) {
        if (t.name == name) return t;
    }
    throw std::runtime_error("no tier " + name);
}

// The stone of the issue: its table is tilted by 0.8 degrees, so pavilion angles measured from it
// spread over twice that. About the stone's own axis they are equal, as they were made.
TEST(OwnAxis, ATiltedTableDoesNotSpreadThePavilion) {
    const Solid truth = levelled(with_tilted_table(0.8));
    ASSERT_EQ(truth.facets.size(), 73u);
    const FitResult result = fit_stone(stone_of(truth), noisy(readings_of(truth, 0.02, 0.002), 3));
    ASSERT_EQ(result.status, FitStatus::converged) << result.message;
    ASSERT_TRUE(result.findings.own_axis.known);
    EXPECT_EQ(result.findings.own_axis.basis, "tiers");
    const Tier& pavilion = tier(result, "P*");
    // Facets lie at steps of 45 degrees from the lean: 2 * 0.8 * cos(15) is the largest spread.
    EXPECT_NEAR(degrees(pavilion.spread), 2 * 0.8 * std::cos(radians(15)), 0.1);
    EXPECT_LT(degrees(pavilion.spread_own_axis), 0.1);
    EXPECT_NEAR(degrees(pavilion.mean_own_axis), 40.8, 0.02);
    // Within four of its standard uncertainties, which are small.
    EXPECT_LT(degrees(result.findings.own_axis.sigma), 0.02);
    EXPECT_NEAR(degrees(result.findings.own_axis.tilt), 0.8,
                4 * degrees(result.findings.own_axis.sigma));
    const int p1 = find_facet(truth, "P1");
    EXPECT_NEAR(degrees(result.facets[std::size_t(p1)].inclination_own_axis), 40.8, 0.08);
}

// The axis of a perfect stone is the table's normal, however the mesh is oriented.
TEST(OwnAxis, OfAPerfectStoneIsUp) {
    const Solid truth = brilliant();
    const FitResult result = fit_stone(stone_of(truth), readings_of(truth, 0.1, 0.01));
    ASSERT_TRUE(result.findings.own_axis.known);
    EXPECT_LT(result.findings.own_axis.tilt, 1e-7);
    EXPECT_NEAR(result.findings.own_axis.direction.z, 1, 1e-12);
    EXPECT_LT(degrees(tier(result, "C*").spread_own_axis), 1e-6);
    EXPECT_NEAR(degrees(tier(result, "C*").mean_own_axis), 34.5, 1e-6);
}

// Errors of the axis, in units of its sigma, have unit standard deviation (12 stones, two
// components each: the estimate's standard error is 1/sqrt(48) = 0.14).
TEST(OwnAxis, SigmaIsHonest) {
    const Solid truth = brilliant();
    double squares = 0;
    const int stones = 12;
    for (unsigned seed = 1; seed <= stones; ++seed) {
        const FitResult result =
            fit_stone(stone_of(truth), noisy(readings_of(truth, 0.1, 0.01), seed));
        ASSERT_TRUE(result.findings.own_axis.known);
        squares += result.findings.own_axis.tilt * result.findings.own_axis.tilt /
                   (2 * result.findings.own_axis.sigma * result.findings.own_axis.sigma) / stones;
    }
    EXPECT_NEAR(std::sqrt(squares), 1, 4 * 0.14);
}

// Pairs of equal sides are enough: a step cut's tiers are pairs across its length and its width.
TEST(OwnAxis, OfAStepCut) {
    const Solid truth = make_cut("step");
    Stone stone = stone_of(truth);
    const FitResult result = fit_stone(stone, readings_of(truth, 0.05, 0.005));
    ASSERT_TRUE(result.findings.own_axis.known) << result.findings.own_axis.basis;
    EXPECT_LT(result.findings.own_axis.tilt, 1e-6);
}

TEST(OwnAxis, OfAnIrregularStoneIsNotKnown) {
    std::mt19937_64 random(4);
    std::normal_distribution<double> normal;
    std::vector<NamedPlane> planes{{"T", {{0, 0, 1}, 0.5}}};
    for (int i = 0; i < 14; ++i) {
        const Vec3 n = glm::normalize(Vec3{normal(random), normal(random), normal(random)});
        // None of them is upright.
        planes.push_back({fmt::format("f{}", i),
                          {glm::normalize(Vec3{n.x, n.y, n.z + (n.z < 0 ? -0.5 : 0.5)}), 1}});
    }
    const Solid truth = enclosed(planes);
    const FitResult result = fit_stone(stone_of(truth), readings_of(truth, 0.1, 0.01));
    EXPECT_FALSE(result.findings.own_axis.known);
    EXPECT_THAT(result.findings.own_axis.basis, ::testing::HasSubstr("neither"));
}

}  // namespace
}  // namespace culet
