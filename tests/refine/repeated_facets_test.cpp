// A stone one side of which no frame shows. Expectations: the stone that was cut off.

#include "refine/spin/repeated_facets.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "stone/cuts/cuts.h"
#include "stone/numbers/units.h"
#include "tests/fit/test_stones.h"

namespace culet {
namespace {

const Vec3 k_place(0.3, -0.2, 0.5);

struct LyingStone {
    Solid whole, cut_off;
    std::vector<double> sigmas;
    std::vector<bool> shown;
};

// The pavilion's facets on the side of +y lie on the ground; one plane closes the stone there.
LyingStone lying(const Solid& stone) {
    LyingStone result;
    std::vector<NamedPlane> planes, above{{"ground", {glm::normalize(Vec3(0, 1, -1)), 0}}};
    for (const Facet& facet : stone.facets) {
        const Vec3& n = facet.plane.normal;
        planes.push_back({facet.name, {n, facet.plane.offset + glm::dot(n, k_place)}});
        if (n.y < 0.1 || n.z > -0.1) above.push_back(planes.back());
    }
    above[0].plane.offset = glm::dot(above[0].plane.normal, k_place) + 0.2 * diameter(stone);
    result.whole = intersect_half_spaces(planes).solid;
    result.cut_off = intersect_half_spaces(above).solid;
    for (const Facet& facet : result.cut_off.facets) {
        result.sigmas.push_back(radians(0.1));
        result.shown.push_back(facet.name != "ground");
    }
    return result;
}

void expect_given_back(const LyingStone& stone, const CutSymmetry& symmetry, double within) {
    EXPECT_LT(stone.cut_off.facets.size(), stone.whole.facets.size());
    SCOPED_TRACE(symmetry.order * 10 + symmetry.mirrors);
    const auto repeated = repeated_facets(stone.cut_off, stone.sigmas, stone.shown, symmetry);
    ASSERT_TRUE(repeated);
    const Solid solid = intersect_half_spaces(repeated->planes).solid;
    ASSERT_EQ(solid.facets.size(), stone.whole.facets.size());
    for (const Facet& facet : stone.whole.facets) {
        double nearest = 1;
        for (const Facet& mine : solid.facets)
            nearest = std::min(nearest, glm::distance(mine.plane.normal, facet.plane.normal) +
                                            std::abs(mine.plane.offset - facet.plane.offset));
        EXPECT_LT(nearest, within) << facet.name;
    }
    EXPECT_EQ(std::size_t(std::count(repeated->is_copy.begin(), repeated->is_copy.end(), true)),
              stone.whole.facets.size() - stone.cut_off.facets.size() + 1);
}

TEST(RepeatedFacets, GiveBackTheSideOnWhichAStoneLies) {
    expect_given_back(lying(make_cut("step")), {2, false}, 1e-6);
    expect_given_back(lying(make_cut("step")), {2, true}, 1e-6);
    expect_given_back(lying(make_cut("asscher")), {4, true}, 1e-6);
}

// Turned about z, the mirrors are no longer at azimuth 0.
TEST(RepeatedFacets, AreFoundAboutMirrorsOfAnyAzimuth) {
    expect_given_back(lying(make_cut("princess", {{"azimuth", 13}})), {4, true}, 1e-6);
}

// Exact copies agree with every condition; a facet that is turned by 1 degree does not.
TEST(RepeatedFacets, SatisfyTheirConditions) {
    const LyingStone stone = lying(make_cut("asscher"));
    const auto repeated = repeated_facets(stone.cut_off, stone.sigmas, stone.shown, {4, true});
    ASSERT_TRUE(repeated);
    std::vector<Plane> planes;
    for (const NamedPlane& p : repeated->planes) planes.push_back(p.plane);
    ASSERT_GT(repeated->conditions.size(), 100u);
    double worst = 0;
    for (const PlaneCondition& condition : repeated->conditions)
        worst = std::max(worst, std::abs(residual(condition, planes)) / condition.sigma);
    EXPECT_LT(worst, 1e-3);
    const int turned = repeated->conditions[0].parts[0].plane;
    Vec3& n = planes[std::size_t(turned)].normal;
    n = glm::normalize(n + radians(1.0) * glm::normalize(glm::cross(n, Vec3(0.3, 0.5, 0.1))));
    worst = 0;
    for (const PlaneCondition& condition : repeated->conditions)
        worst = std::max(worst, std::abs(residual(condition, planes)) / condition.sigma);
    EXPECT_GT(worst, 1);
}

// Facets off by 0.4 degrees: their common sigma is estimated from some 40 angles, to 20 %, and
// medians are worth two thirds of them.
TEST(RepeatedFacets, EstimateHowAlikeTheyAre) {
    const Solid off = test::off_standard(make_cut("asscher"), 0.4, 0, 5);
    LyingStone stone = lying(off);
    for (double& sigma : stone.sigmas) sigma = radians(0.01);
    const auto repeated = repeated_facets(stone.cut_off, stone.sigmas, stone.shown, {4, true});
    ASSERT_TRUE(repeated);
    EXPECT_NEAR(degrees(repeated->tilt_sigma), 0.4, 0.2);
}

TEST(RepeatedFacets, AreNotFoundInAStoneThatRepeatsNone) {
    const LyingStone stone = lying(test::off_standard(make_cut("step"), 12, 0, 3));
    EXPECT_FALSE(repeated_facets(stone.cut_off, stone.sigmas, stone.shown, {2, false}));
}

}  // namespace
}  // namespace culet
