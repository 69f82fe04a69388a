#include "compare/refine/plane_moves.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "compare/scores/chance.h"
#include "stone/cuts/cuts.h"

namespace culet {
namespace {

constexpr double k_small = 1e-5;
// Second-order terms of a small move, for a stone about 1 across.
constexpr double k_second_order = 10 * k_small * k_small;

TEST(PlaneMoves, BetweenTwoStonesAreThoseThatWereMade) {
    const Solid solid = make_cut("princess");
    const auto facets = moves_of(solid);
    for (std::size_t f = 0; f < solid.facets.size(); f += 3) {
        for (std::size_t move = 0; move < k_moves_of_a_facet; ++move) {
            const auto moved = with_plane_moved(solid, f, facets[f], move, k_small);
            ASSERT_TRUE(moved);
            const auto found = moves_between(solid, *moved);
            for (std::size_t k = 0; k < found.size(); ++k) {
                const double made = k == k_moves_of_a_facet * f + move ? k_small : 0;
                EXPECT_NEAR(found[k], made, k_second_order) << solid.facets[f].name << " " << k;
            }
        }
    }
}

// A quantity that is linear in the moves changes by the planes' slopes.
TEST(PlaneMoves, HaveTheSlopesOfTheirPlanes) {
    const Solid solid = make_cut("princess");
    const auto facets = moves_of(solid);
    const double by[3] = {0.7, -1.3, 2.1};
    for (std::size_t f = 0; f < solid.facets.size(); ++f) {
        const PlaneSlopes slopes = plane_slopes(facets[f], by[0], by[1], by[2]);
        for (std::size_t move = 0; move < k_moves_of_a_facet; ++move) {
            const Plane plane = moved_plane(facets[f], move, k_small);
            const double change =
                glm::dot(slopes.normal, plane.normal - facets[f].normal) +
                slopes.offset * (plane.offset - glm::dot(facets[f].normal, facets[f].middle));
            EXPECT_NEAR(change, k_small * by[move], k_second_order);
        }
    }
}

// The planes of a stone that is turned about its middle, shifted, or enlarged.
TEST(PlaneMoves, OfTheWholeStoneAreAMotionOfIt) {
    const Solid solid = make_cut("princess");
    const Vec3 middle = centroid(solid);
    const auto whole = moves_of_the_whole(solid);
    ASSERT_EQ(whole.size(), 7u);
    for (std::size_t k = 0; k < whole.size(); ++k) {
        Vec3 along(0);
        if (k < 6) along[int(k % 3)] = 1;
        Solid moved = solid;
        for (Facet& facet : moved.facets) {
            Plane& plane = facet.plane;
            double from_middle = plane.offset - glm::dot(plane.normal, middle);
            if (k >= 3 && k < 6) plane.normal = rotation_about(along, k_small) * plane.normal;
            if (k == 6) from_middle *= 1 + k_small;
            plane.offset = from_middle + glm::dot(plane.normal, middle);
            if (k < 3) plane.offset += k_small * glm::dot(plane.normal, along);
        }
        const auto found = moves_between(solid, moved);
        for (std::size_t i = 0; i < found.size(); ++i) {
            EXPECT_NEAR(found[i], k_small * whole[k][i], k_second_order) << k << " " << i;
        }
    }
}

}  // namespace
}  // namespace culet
