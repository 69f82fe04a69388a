// A stone one side of which no frame shows. Expectations: the stone that was cut off.

#include "refine/spin/half_turn.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "stone/cuts/cuts.h"
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
        result.sigmas.push_back(0.01);
        result.shown.push_back(facet.name != "ground");
    }
    return result;
}

TEST(HalfTurn, GivesBackTheSideOnWhichAStoneLies) {
    const LyingStone stone = lying(make_cut("step"));
    EXPECT_LT(stone.cut_off.facets.size(), stone.whole.facets.size());
    const auto completed = completed_by_half_turn(stone.cut_off, stone.sigmas, stone.shown);
    ASSERT_TRUE(completed);
    EXPECT_NEAR(completed->axis_sigma, 0, 1e-9);
    ASSERT_EQ(completed->solid.facets.size(), stone.whole.facets.size());
    for (const Facet& facet : stone.whole.facets) {
        double nearest = 1;
        for (const Facet& mine : completed->solid.facets)
            nearest = std::min(nearest, glm::distance(mine.plane.normal, facet.plane.normal) +
                                            std::abs(mine.plane.offset - facet.plane.offset));
        EXPECT_LT(nearest, 1e-6) << facet.name;
    }
    EXPECT_EQ(completed->copies.size(),
              stone.whole.facets.size() - stone.cut_off.facets.size() + 1);
}

TEST(HalfTurn, TakesNoStoneWithoutSuchAnAxis) {
    const LyingStone stone = lying(test::off_standard(make_cut("step"), 12, 0, 3));
    EXPECT_FALSE(completed_by_half_turn(stone.cut_off, stone.sigmas, stone.shown));
}

}  // namespace
}  // namespace culet
