#include "stone/solid/automorphisms.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <set>

#include "stone/cuts/cuts.h"
#include "stone/solid/half_edges.h"
#include "stone/text/errors.h"
#include "tests/stone/enclosed.h"
#include "tests/stone/synthetic_solids.h"

namespace culet {
namespace {

using test::cube;
using test::enclosed;

// Every edge maps to an edge, and every facet's loop to the image's loop, forward or backward.
void expect_is_automorphism(const Solid& solid, const Automorphism& a) {
    for (std::size_t f = 0; f < solid.facets.size(); ++f) {
        std::vector<int> image;
        for (int corner : solid.facets[f].corners) image.push_back(a.vertices[corner]);
        if (a.turns_over) std::reverse(image.begin(), image.end());
        const std::vector<int>& loop = solid.facets[a.facets[f]].corners;
        ASSERT_EQ(image.size(), loop.size());
        const auto start = std::find(image.begin(), image.end(), loop.front());
        ASSERT_NE(start, image.end());
        std::rotate(image.begin(), start, image.end());
        EXPECT_EQ(image, loop);
    }
}

// The full octahedral group has 48 elements, 24 of them rotations (Coxeter 1973, table I).
TEST(Automorphisms, CubeHasTheOctahedralGroup) {
    const Solid solid = cube();
    const std::vector<Automorphism> all = automorphisms(solid);
    ASSERT_EQ(all.size(), 48u);
    EXPECT_EQ(std::count_if(all.begin(), all.end(), [](const auto& a) { return a.turns_over; }),
              24);
    for (const Automorphism& a : all) expect_is_automorphism(solid, a);
    EXPECT_EQ(that_keep(all, 0).size(), 8u);
    EXPECT_EQ(facet_orbits(all, 6).size(), 1u);
    EXPECT_EQ(facet_orbits(that_keep(all, 0), 6).size(), 3u);
    // A group: closed under products.
    for (const Automorphism& a : all) {
        for (const Automorphism& b : all) {
            EXPECT_NE(std::find(all.begin(), all.end(), followed_by(a, b)), all.end());
        }
    }
}

// By construction a round brilliant of n mains has Cnv about its table for any n.
TEST(Automorphisms, RoundBrilliantsHaveTheSymmetryOfTheirMains) {
    for (const int mains : {3, 5, 6, 8, 16}) {
        Solid solid;
        try {
            solid = make_cut("round-brilliant", {{"mains", double(mains)}});
        } catch (const InputError&) {
            continue;  // this cut does not allow this number of mains
        }
        const std::vector<Automorphism> all = automorphisms(solid);
        const int table = find_facet(solid, "T");
        ASSERT_GE(table, 0);
        const std::vector<Automorphism> kept = that_keep(all, table);
        EXPECT_EQ(kept.size(), std::size_t(2 * mains)) << mains;
        std::set<int> steps;
        for (const Automorphism& a : kept) {
            expect_is_automorphism(solid, a);
            if (a.turns_over) {
                EXPECT_EQ(order_of(a), 2);
                continue;
            }
            const int s = steps_of_turn(solid, table, a);
            steps.insert(s);
            // A shift by s of n corners moves a main by s / n of a full turn.
            const int main = find_facet(solid, "C1");
            const Vec3 &n = solid.facets[main].plane.normal,
                       &m = solid.facets[a.facets[main]].plane.normal;
            const double turned = std::atan2(m.y, m.x) - std::atan2(n.y, n.x);
            EXPECT_NEAR(
                std::remainder(turned - 2 * std::numbers::pi * s / mains, 2 * std::numbers::pi), 0,
                1e-9);
        }
        EXPECT_EQ(steps.size(), std::size_t(mains));
        // Table, pavilion tiers and girdle: each tier of mains is one orbit.
        for (const std::vector<int>& orbit : facet_orbits(kept, solid.facets.size())) {
            EXPECT_TRUE(orbit.size() == 1 || orbit.size() % std::size_t(mains) == 0);
        }
    }
}

// Geometry does not matter: moving corners by 20 % of the width, or all to one point, changes
// nothing.
TEST(Automorphisms, DependOnNothingButWhoMeetsWhom) {
    Solid solid = make_cut("round-brilliant");
    const std::vector<Automorphism> before = automorphisms(solid);
    std::mt19937_64 random(7);
    std::normal_distribution<double> noise(0, 1.3);
    for (Vec3& v : solid.vertices) v += Vec3{noise(random), noise(random), noise(random)};
    EXPECT_EQ(automorphisms(solid), before);
    for (Vec3& v : solid.vertices) v = Vec3{0, 0, 0};
    EXPECT_EQ(automorphisms(solid), before);
}

// Planes of random directions have no symmetry: a chance symmetry is very rare at this size, and
// none of these seeds has one.
TEST(Automorphisms, RandomSolidsHaveNone) {
    for (unsigned seed = 1; seed <= 10; ++seed) {
        std::mt19937_64 random(seed);
        std::normal_distribution<double> normal;
        std::vector<NamedPlane> planes;
        for (int i = 0; i < 40; ++i) {
            Vec3 n{normal(random), normal(random), normal(random)};
            n /= std::sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
            planes.push_back({"f" + std::to_string(i), {n, 1}});
        }
        const std::vector<Automorphism> all = automorphisms(enclosed(planes));
        ASSERT_EQ(all.size(), 1u) << "seed " << seed;
        EXPECT_EQ(order_of(all.front()), 1);
    }
}

// Combinatorially a cube with one bevelled edge is a pentagonal prism: D5h, 20 elements (Coxeter
// 1973, 1.5), 4 of which fix a side.
TEST(Automorphisms, ABevelledCubeIsAPrism) {
    std::vector<NamedPlane> planes{{"T", {{0, 0, 1}, 1}},   {"X+", {{1, 0, 0}, 1}},
                                   {"Y+", {{0, 1, 0}, 1}},  {"X-", {{-1, 0, 0}, 1}},
                                   {"Y-", {{0, -1, 0}, 1}}, {"B", {{0, 0, -1}, 1}}};
    const double s = std::sqrt(0.5);
    planes.push_back({"bevel", {{s, 0, s}, 1.7 * s}});
    const Solid solid = enclosed(planes);
    const std::vector<Automorphism> all = automorphisms(solid);
    EXPECT_EQ(all.size(), 20u);
    EXPECT_EQ(that_keep(all, find_facet(solid, "T")).size(), 4u);
    EXPECT_EQ(that_keep(all, find_facet(solid, "Y+")).size(), 10u);
}

TEST(Automorphisms, RefusesWhatIsNoClosedSurface) {
    Solid open = cube();
    open.facets.pop_back();
    EXPECT_THROW(automorphisms(open), InternalError);
    Solid two = cube();
    for (Facet facet : cube().facets) {
        for (int& corner : facet.corners) corner += 8;
        two.facets.push_back(facet);
    }
    two.vertices.resize(16);
    EXPECT_EQ(automorphisms(two).size(), 1u);
    EXPECT_THROW(automorphisms(Solid{}), InternalError);
}

}  // namespace
}  // namespace culet
