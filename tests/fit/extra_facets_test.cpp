// Facets that the stone has and the mesh lacks: planted ones are suspected at their place, clean
// stones are left alone.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cfenv>
#include <cmath>
#include <glm/geometric.hpp>

#include "fit/findings/extra_facets.h"
#include "fit/starts/refit.h"
#include "tests/fit/test_stones.h"

namespace culet {
namespace {

using namespace test;
using ::testing::Contains;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr double k_sigma_deg = 0.1, k_sigma = 0.01;

/// The brilliant with one more facet, `depth` below the corner that lies furthest along `normal`.
Solid with_extra(const Solid& solid, const Vec3& normal, double depth) {
    std::vector<NamedPlane> planes;
    for (const Facet& f : solid.facets) planes.push_back({f.name, f.plane});
    const Vec3 n = glm::normalize(normal);
    double highest = -1e300;
    for (const Vec3& v : solid.vertices) highest = std::max(highest, glm::dot(n, v));
    planes.push_back({"extra", {n, highest - depth}});
    return enclosed(planes);
}

/// Readings of the true stone by someone who holds the mesh for it: nothing of the extra facet.
std::vector<Reading> readings_between(const Solid& mesh, const Solid& truth, unsigned seed) {
    return noisy(plane_readings(mesh, truth, k_sigma_deg, k_sigma), seed);
}

std::vector<std::string> places(const FitResult& result) {
    std::vector<std::string> all;
    for (const ExtraFacet& f : result.findings.extra_facets) {
        all.push_back("");
        for (const std::string& name : f.at) all.back() += " " + name;
        all.back() += " ";
    }
    return all;
}

TEST(ExtraFacets, ABrutedCuletIsSuspected) {
    const Solid mesh = brilliant();
    for (unsigned seed = 1; seed <= 4; ++seed) {
        const Solid truth = with_extra(mesh, {0, 0, -1}, 0.06);
        const FitResult result = fit_stone(stone_of(mesh), readings_between(mesh, truth, seed));
        ASSERT_FALSE(result.findings.extra_facets.empty()) << seed << " " << result.message;
        const ExtraFacet& first = result.findings.extra_facets.front();
        EXPECT_THAT(first.at, Contains("P1"));
        EXPECT_NEAR(first.depth, 0.06, 5 * first.sigma);
        EXPECT_LT(first.sigma, 0.02);
        EXPECT_THAT(first.shown_by, Contains("depth"));
        EXPECT_THAT(result.message, testing::HasSubstr("a facet that the mesh lacks"));
    }
}

TEST(ExtraFacets, OneOnACornerOfTheGirdleIsSuspected) {
    const Solid mesh = brilliant();
    // Over the corner where C1 reaches the girdle, slanting like a crown facet.
    for (const double inclination_deg : {60.0, 75.0, 90.0}) {
        const Solid truth = with_extra(mesh, direction(inclination_deg, 0), 0.05);
        const FitResult result = fit_stone(stone_of(mesh), readings_between(mesh, truth, 7));
        ASSERT_FALSE(result.findings.extra_facets.empty())
            << inclination_deg << " " << result.message;
        EXPECT_THAT(places(result).front(),
                    testing::AnyOf(testing::HasSubstr(" C1 "), testing::HasSubstr(" G1 "),
                                   testing::HasSubstr(" G16 ")))
            << inclination_deg;
    }
}

TEST(ExtraFacets, ACleanStoneHasNone) {
    // The level of the test is 0.001 a stone, in the linear model.
    const Solid mesh = brilliant();
    int alarms = 0;
    for (unsigned seed = 1; seed <= 20; ++seed) {
        const FitResult result = fit_stone(stone_of(mesh), readings_between(mesh, mesh, seed));
        alarms += result.findings.extra_facets.empty() ? 0 : 1;
    }
    EXPECT_EQ(alarms, 0);
}

TEST(ExtraFacets, AWrongReadingIsNotTakenForOne) {
    const Solid mesh = brilliant();
    for (const char* id_kind : {"inclination", "edge", "width"}) {
        std::vector<Reading> readings = readings_between(mesh, mesh, 3);
        for (std::size_t i = 0; i < readings.size(); ++i) {
            if (std::string(name_of(readings[i].kind)) != id_kind || i < 20) continue;
            readings[i].value += (id_kind[0] == 'i' ? 40 : 60) * readings[i].sigma;  // longer
            break;
        }
        const FitResult result = fit_stone(stone_of(mesh), readings);
        EXPECT_FALSE(result.findings.suspects.empty()) << id_kind;
        EXPECT_THAT(places(result), IsEmpty()) << id_kind;
    }
}

// Where the search ended in planes that are no stone's, the mean of the normals at a corner may
// face away from one of them exactly: no direction lies between the two.
TEST(ExtraFacets, NoneIsSoughtBetweenPlanesThatFaceAwayFromEachOther) {
    const Solid mesh = brilliant();
    const Stone stone = stone_of(mesh);
    const System system(stone, readings_between(mesh, mesh, 1), {});
    Finished finished = finish_from(system, system.mesh_shape(), 100).finished;
    const Diagnosis diagnosis = diagnose(system, finished.shape, finished.outline);
    const std::vector<int>& facets = system.edges().facets_of_vertex.front();
    ASSERT_GE(facets.size(), 3u);
    std::vector<Vec3>& normals = finished.shape.normals;
    const Vec3 same = normals[std::size_t(facets.front())];
    for (const int f : facets) normals[std::size_t(f)] = f == facets.back() ? -same : same;
    std::feclearexcept(FE_INVALID);
    const auto found = suspect_extra_facets(system, finished, diagnosis, 0.001);
    EXPECT_EQ(std::fetestexcept(FE_INVALID), 0) << "a direction of no length";
    for (const ExtraFacet& f : found) EXPECT_TRUE(std::isfinite(f.depth + f.sigma + f.chi2));
}

}  // namespace
}  // namespace culet
