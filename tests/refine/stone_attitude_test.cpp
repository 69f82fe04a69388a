// Expectation: the attitude in which the stone was laid.

#include "refine/spin/stone_attitude.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "stone/cuts/cuts.h"
#include "stone/numbers/units.h"

namespace culet {
namespace {

// The crown of one side, seen by nobody, is cut off: the widest direction is off by degrees, the
// axis of half a turn by none.
TEST(StoneAttitude, IsThatOfTheFacetsThatAreSeen) {
    std::vector<NamedPlane> planes;
    for (const Facet& f : make_cut("step").facets) {
        const Vec3& n = f.plane.normal;
        if (n.y > 0.3 && n.z > 0.1) continue;
        planes.push_back({f.name, f.plane});
    }
    planes.push_back({"X", {glm::normalize(Vec3(0, 0.2, 1)), planes[0].plane.offset}});
    const Solid solid = intersect_half_spaces(planes).solid;
    std::vector<bool> seen;
    for (const Facet& f : solid.facets) seen.push_back(f.name != "X");
    const StoneAttitude at = attitude_of(solid, seen, {0, 0, 1});
    EXPECT_LT(degrees(angle_between(at.z, Vec3(0, 0, 1))), 0.05);
    const StoneAttitude unknown =
        attitude_of(solid, std::vector<bool>(seen.size(), false), {0, 0, 1});
    EXPECT_GT(degrees(angle_between(unknown.z, Vec3(0, 0, 1))), 1);
}

}  // namespace
}  // namespace culet
