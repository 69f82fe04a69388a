// Stones whose facets nearly meet: high-valence points of drop cuts, off by 1e-9 to 1e-3 of the
// width.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "fit/fit.h"
#include "stone/solid/checks.h"
#include "tests/fit/test_stones.h"

namespace culet {
namespace {

using namespace test;

/// A regular briolette: `rows` staggered rows of `n` facets that touch a drop, so that n of them
/// meet in a point at the top and at the bottom. Every plane is off by N(0, `miss`) half widths.
Solid drop(int n, int rows, double miss) {
    std::mt19937_64 random(3);
    std::normal_distribution<double> normal;
    std::vector<NamedPlane> planes;
    for (int r = 0; r < rows; ++r) {
        const double down = (r + 0.5) / rows;
        for (int k = 0; k < n; ++k) {
            const Vec3 d = direction(180 * down, 360.0 * (k + 0.5 * (r % 2)) / n);
            const double tall = (1.6 - 0.6 * down) * (d.z > 0 ? 1.6 : 1);
            planes.push_back(through(fmt::format("R{}F{}", r + 1, k + 1), {d.x, d.y, d.z / tall},
                                     {d.x, d.y, d.z * tall}));
            planes.back().plane.offset += miss * normal(random);
        }
    }
    return intersect_half_spaces(planes).solid;
}

Stone standing(Solid solid) {
    Stone stone = stone_of(std::move(solid), "");
    stone.azimuth_from_mesh = true;
    return stone;
}

const MeetFinding& point_of(const FitResult& result, const std::string& facet) {
    for (const MeetFinding& m : result.findings.meets) {
        if (m.facets.size() > 8 &&
            std::find(m.facets.begin(), m.facets.end(), facet) != m.facets.end()) {
            return m;
        }
    }
    throw std::runtime_error("no such point");
}

// The half-space intersection of the perfect planes (with the meets joined) has 16 facets at each
// point. Misses far below the readings' sigmas are no contradiction, whatever their size.
TEST(NearMeets, ASixteenValentPointThatMissesByLittleIsNotAccused) {
    const Solid mesh = contract_near_meets(drop(16, 5, 0), 1e-9).solid;
    for (const double miss : {1e-9, 1e-6, 1e-5}) {
        const Solid truth = drop(16, 5, miss);
        const FitResult result =
            fit_stone(standing(mesh), noisy(plane_readings(mesh, truth, 0.05, 0.002), 4));
        EXPECT_EQ(result.status, FitStatus::converged) << miss << ": " << result.message;
        EXPECT_THAT(find_faults(result.solid), ::testing::IsEmpty()) << miss;
        for (const char* facet : {"R1F1", "R5F1"}) {
            const MeetFinding& point = point_of(result, facet);
            EXPECT_EQ(point.facets.size(), 16u);
            EXPECT_EQ(point.conditions, 13);
            EXPECT_EQ(point.tested, 13);
            EXPECT_FALSE(point.contradicted) << miss << " p " << point.p;
        }
    }
}

// Planes miss by 1e-3 of the half width and are read ten times better: the report names the point.
TEST(NearMeets, ASixteenValentPointThatMissesByMuchIsNamed) {
    const Solid mesh = contract_near_meets(drop(16, 5, 0), 1e-9).solid;
    const Solid truth = drop(16, 5, 1e-3);
    ASSERT_EQ(truth.facets.size(), mesh.facets.size());
    // Plane observations: angles, and the distance of each plane from the lowest point.
    std::vector<Reading> readings;
    for (const Reading& r : plane_readings(mesh, truth, 0.01, 1e-4)) {
        if (r.kind != ReadingKind::edge) readings.push_back(r);
    }
    for (const Reading& r : all_edges(mesh, 1e-4)) {
        // Lengths of edges that end at neither point.
        const bool top = mesh.facets[std::size_t(r.facets[0])].name[1] == '1' &&
                         mesh.facets[std::size_t(r.facets[1])].name[1] == '1';
        const bool bottom = mesh.facets[std::size_t(r.facets[0])].name[1] == '5' &&
                            mesh.facets[std::size_t(r.facets[1])].name[1] == '5';
        if (top || bottom) continue;
        for (const Edge& e : half_edges(truth).edges) {
            const auto same = [&](int f, int g) {
                return truth.facets[std::size_t(f)].name == mesh.facets[std::size_t(g)].name;
            };
            if (!(same(e.left, r.facets[0]) && same(e.right, r.facets[1])) &&
                !(same(e.left, r.facets[1]) && same(e.right, r.facets[0]))) {
                continue;
            }
            readings.push_back(r);
            readings.back().value = glm::length(truth.vertices[std::size_t(e.from)] -
                                                truth.vertices[std::size_t(e.to)]);
        }
    }
    FitOptions options;
    options.starts = 2;
    const FitResult result = fit_stone(standing(mesh), noisy(readings, 4), options);
    EXPECT_EQ(result.status, FitStatus::contradictory) << result.message;
    EXPECT_TRUE(point_of(result, "R1F1").contradicted || point_of(result, "R5F1").contradicted);
}

TEST(NearMeets, ADropHasTheSymmetryOfItsRows) {
    const Solid truth = contract_near_meets(drop(16, 5, 0), 1e-9).solid;
    const SymmetryReport report =
        find_symmetry(standing(truth), noisy(plane_readings(truth, truth, 0.05, 0.002), 4));
    EXPECT_EQ(report.form, "C16v");
    EXPECT_EQ(report.proposed, "C16v") << report.message;
}

// 304 facets: the analysis must stay feasible and true. By construction the drop stands upright.
TEST(NearMeets, ABrioletteOf304Facets) {
    const Solid mesh = contract_near_meets(drop(16, 19, 0), 1e-9).solid;
    ASSERT_EQ(mesh.facets.size(), 304u);
    const Solid truth = drop(16, 19, 1e-6);
    ASSERT_GT(truth.vertices.size(), mesh.vertices.size());
    const FitResult result =
        fit_stone(standing(mesh), noisy(plane_readings(mesh, truth, 0.03, 0.001), 2));
    EXPECT_EQ(result.solid.facets.size(), 304u);
    EXPECT_THAT(find_faults(result.solid), ::testing::IsEmpty());
    ASSERT_TRUE(result.findings.own_axis.known);
    EXPECT_LT(result.findings.own_axis.tilt, 4 * result.findings.own_axis.sigma);
    EXPECT_FALSE(point_of(result, "R1F1").contradicted);
    EXPECT_FALSE(point_of(result, "R19F1").contradicted);
}

}  // namespace
}  // namespace culet
