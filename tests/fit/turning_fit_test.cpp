// A stone on a turntable, seen from above, with conditions on its planes. Expectations: the stone
// whose outlines they are.

#include "fit/silhouettes/turning_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "stone/cuts/cuts.h"
#include "stone/numbers/units.h"
#include "tests/fit/test_stones.h"

namespace culet {
namespace {

constexpr int k_views = 36;

// Points every 2 % of the width along the outlines, without errors. The camera stands 40 degrees
// above the turntable: level facets turn edge-on in no view.
TurningOutlines outlines_of(const Solid& solid) {
    TurningOutlines given;
    given.start.camera = {0, 0, radians(40.0), 0.001};
    for (int k = 0; k < k_views; ++k) {
        const double turn = 2 * std::numbers::pi * k / k_views;
        given.start.turns.push_back(turn);
        const PicturePoints corners = outline_in_picture(solid.vertices, given.start.camera, turn);
        PicturePoints points;
        for (std::size_t c = 0; c < corners.size(); ++c) {
            const glm::dvec2 &begin = corners[c], &end = corners[(c + 1) % corners.size()];
            for (double at = 0.05; at < glm::distance(begin, end); at += 0.1)
                points.push_back(begin + at * glm::normalize(end - begin));
        }
        given.outlines.push_back(points);
    }
    given.expected.camera = given.start.camera;
    given.expected.sigmas = {1e-3, 1e-4, 1e-4, 1e-5};
    given.expected.turns = given.start.turns;
    given.expected.turn_sigma = 1e-4;
    for (const Facet& facet : solid.facets) given.planes.push_back(facet.plane);
    return given;
}

struct FoundTable {
    double off_deg = 0, sigma_deg = 0;
};
FoundTable table_of(const TurningFit& fit, int plane, const Vec3& normal) {
    const int f = find_facet(fit.solid, "F" + std::to_string(plane + 1));
    if (f < 0) return {180, 180};
    return {degrees(angle_between(fit.solid.facets[std::size_t(f)].plane.normal, normal)),
            degrees(fit.tilt_sigmas[std::size_t(f)])};
}

// The table starts 2 degrees off. Conditions of 0.1 degrees across bring it back; without them its
// corners alone tell it, and its sigma is larger.
TEST(TurningFit, KeepsConditionsOnPlanesThatNoViewShowsEdgeOn) {
    const Solid solid = make_cut("step");
    const int table = find_facet(solid, "T");
    const Vec3 up = solid.facets[std::size_t(table)].plane.normal;
    TurningOutlines given = outlines_of(solid);
    Plane& start = given.planes[std::size_t(table)];
    start.normal = glm::normalize(start.normal + radians(2.0) * Vec3(1, 0, 0));
    const FoundTable alone = table_of(refit_turning(given), table, up);
    given.conditions = {{{{table, {1, 0, 0}, 0}}, 0, radians(0.1)},
                        {{{table, {0, 1, 0}, 0}}, 0, radians(0.1)}};
    const FoundTable held = table_of(refit_turning(given), table, up);
    EXPECT_LT(held.off_deg, 0.1);
    EXPECT_LT(held.sigma_deg, 0.11);
    EXPECT_LE(held.off_deg, alone.off_deg + 1e-6);
    EXPECT_LT(held.sigma_deg, alone.sigma_deg);
}

// The girdle's sides are seen edge-on: a condition that contradicts them by 5 degrees, and is a
// hundred times less sure, moves them by less than a hundredth of that.
TEST(TurningFit, WeighsConditionsAgainstOutlines) {
    const Solid solid = make_cut("step");
    const int side = find_facet(solid, "P1E");
    ASSERT_GE(side, 0);
    const Vec3 normal = solid.facets[std::size_t(side)].plane.normal;
    TurningOutlines given = outlines_of(solid);
    given.conditions = {{{{side, {0, 0, 1}, 0}}, normal.z + radians(5.0), radians(10.0)}};
    EXPECT_LT(table_of(refit_turning(given), side, normal).off_deg, 0.05);
}

// A point's sigma counts: four times the sigma, four times the tilt's.
TEST(TurningFit, MakesSigmasLargerWhereErrorsAreShared) {
    const Solid solid = make_cut("step");
    const int side = find_facet(solid, "P1E");
    const Vec3 normal = solid.facets[std::size_t(side)].plane.normal;
    TurningOutlines given = outlines_of(solid);
    for (std::size_t k = 0; k < given.outlines.size(); ++k) {
        for (std::size_t p = 0; p < given.outlines[k].size(); ++p)
            given.outlines[k][p] *= 1 + 0.002 * std::sin(double(7 * p + 3 * k * k));
    }
    const double one = table_of(refit_turning(given), side, normal).sigma_deg;
    given.sigmas_times = 4;
    const double four = table_of(refit_turning(given), side, normal).sigma_deg;
    EXPECT_NEAR(four / one, 4, 0.4);
}

}  // namespace
}  // namespace culet
