// Planes from outlines. These tests run under the sanitizers at every change, so the program links
// only what outlines need.

#include <gtest/gtest.h>

#include <random>

#include "fit/silhouettes/find_planes.h"
#include "fit/silhouettes/plane_solver.h"
#include "fit/silhouettes/silhouette_fit.h"
#include "fit/silhouettes/silhouette_start.h"
#include "fit/silhouettes/turning_fit.h"
#include "stone/cuts/cuts.h"
#include "tests/fit/test_stones.h"
#include "tests/fit/turntable_outlines.h"

namespace culet {
namespace {

using test::off_standard;
using test::stone_of;
using test::turntable_outlines;

// A cube of edge 2 seen along its diagonal (1, 1, 0) is a rectangle of 2 sqrt 2 by 2.
TEST(ProjectedOutline, OfACubeAlongADiagonalIsARectangle) {
    const Vec3 across = glm::normalize(Vec3{1, -1, 0}), along{0, 0, 1};
    const ProjectedOutline outline = projected_outline(test::cube().vertices, across, along);
    ASSERT_EQ(outline.edges.size(), 4u);
    double around = 0;
    for (const auto& e : outline.edges) around += e.length;
    EXPECT_NEAR(around, 4 * std::numbers::sqrt2 + 4, 1e-12);
    EXPECT_NEAR(outline.nearest(0, 0).distance, -1, 1e-12);
    EXPECT_NEAR(outline.nearest(2, 0.5).distance, 2 - std::numbers::sqrt2, 1e-12);
}

// The same of a turntable: each contour's own turn, and the camera.
PlaneFitProblem turning_problem(const Solid& truth) {
    PlaneFitProblem problem;
    problem.from.series.camera = {0.1, 0.02, 0.7, 0.02};
    std::mt19937_64 random(3);
    std::normal_distribution<double> error(0, 0.002);
    for (int k = 0; k < 6; ++k) {
        problem.from.series.turns.push_back(k);
        FlatContour& contour = problem.contours.emplace_back();
        for (const glm::dvec2& p :
             outline_in_picture(truth.vertices, {0.1, 0.021, 0.702, 0.021}, k + 0.001))
            contour.points.push_back({p.x + error(random), p.y + error(random)});
        contour.weights.assign(contour.points.size(), 1);
    }
    problem.expected = {{0.11, 0.02, 0.71, 0.02}, {0, 0, 0.1, 0.05}, {0, 1.01, 2, 3, 4, 5}, 0.1};
    return problem;
}

// The analytic gradient of half the cost against central differences: with a step of 1e-6 the
// quadratic error is about 1e-6 times a curvature of order one. There is no derivative at kinks,
// where a corner leaves the outline within the step; few of the unknowns hit one.
void expect_gradient(const Solid& truth, PlaneFitProblem problem) {
    problem.stated_sigmas = {0};
    problem.start_tilts.assign(truth.facets.size(), 0.03);
    for (const Facet& f : truth.facets) problem.start.push_back(f.plane);
    const PlaneSolver solver(problem);
    PlaneState state{problem.start, problem.from, {}, {}};
    ASSERT_TRUE(solver.look(state));
    const std::vector<double> sigmas{0.01};
    const PlaneSolver::Weights weights = solver.weights(state, {1});
    const auto equations = solver.equations(state, weights, sigmas, true);
    // Every fifth unknown: a different coordinate of each plane, and some of the motion.
    constexpr Eigen::Index k_stride = 5;
    int seen = 0, alike = 0, other = 0;
    for (Eigen::Index i = 0; i < equations.gradient.size(); i += k_stride) {
        constexpr double k_step = 1e-6;
        Eigen::VectorXd step = Eigen::VectorXd::Zero(equations.gradient.size());
        double cost[2];
        for (int side = 0; side < 2; ++side) {
            step(i) = side == 0 ? -k_step : k_step;
            PlaneState there = solver.moved(state, step);
            ASSERT_TRUE(solver.look(there));
            cost[side] = solver.cost(there, weights, sigmas);
        }
        const double difference = 0.5 * (cost[1] - cost[0]) / (2 * k_step);
        const double allowed = 1e-3 * (1 + std::abs(difference)) + 1e-6 * equations.matrix(i, i);
        (std::abs(equations.gradient(i) - difference) < allowed ? alike : other)++;
        seen += std::abs(difference) > 1;
    }
    EXPECT_GT(seen, 60 / k_stride);
    EXPECT_LT(other, 0.05 * alike);
}

TEST(PlaneSolver, GradientIsThatOfCentralDifferences) {
    const Solid truth = off_standard(test::brilliant(), 0.3, 0.01, 3);
    SilhouetteSet set = turntable_outlines(truth, {.views = 6, .points = 60, .sigma = 0.002});
    PlaneFitProblem problem;
    for (const Contour& c : set.contours) problem.contours.push_back(flattened(c, 0));
    problem.from.motions.resize(1);
    problem.from.motions[0].shift = {0.01, -0.02, 0.03};
    problem.is_free = {true};
    expect_gradient(truth, problem);
    expect_gradient(truth, turning_problem(truth));
}

// A step cut with facets far off the design, and few and rough outlines: added facets become too
// narrow at the end. All numbering must refer to the remaining planes, each of which has a facet.
// (This seed drops planes in its last round.)
TEST(FindPlanes, WhatIsNumberedByPlanesIsOfThoseThatAreLeft) {
    const Solid design = make_cut("step");
    constexpr unsigned seed = 8;
    const Solid truth = off_standard(design, degrees(0.03), 0.05, seed);
    const double elevation = radians(30);
    std::mt19937_64 random(seed);
    auto set = std::make_shared<SilhouetteSet>();
    for (int k = 0; k < 8; ++k) {
        const double a = 2 * std::numbers::pi * k / 8;
        const Vec3 sight{std::cos(elevation) * std::cos(a), std::cos(elevation) * std::sin(a),
                         std::sin(elevation)};
        set->contours.push_back(
            test::seen_along(truth, sight, {.points = 350, .sigma = 0.01}, random));
    }
    SilhouetteStart start = silhouette_start(stone_of(design), {set});
    const FoundPlanes found = find_planes(stone_of(design), start.problem);
    const std::size_t planes = found.fit.planes.size();
    EXPECT_EQ(start.problem.start.size(), planes);
    EXPECT_EQ(found.mesh_facet.size(), planes);
    EXPECT_EQ(found.fit.body.present, std::vector<bool>(planes, true));
    for (const std::array<int, 3>& crossing : found.fit.body.planes) {
        for (const int p : crossing) EXPECT_LT(p, int(planes));
    }
    const SilhouetteFit fit = fit_silhouettes(stone_of(design), {set});
    ASSERT_EQ(fit.stone.solid.facets.size(), planes);
    for (const auto& row : fit.observations->rows) EXPECT_EQ(row.normal.size(), planes);
}

}  // namespace
}  // namespace culet
