// Finding the turn between the azimuths that were read and the mesh. A drawing with random errors
// counts as not turned. Expectations: the turns that the tests make.

#include "fit/model/azimuth_turn.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "stone/numbers/units.h"

namespace culet {
namespace {

struct Azimuths {
    std::vector<Reading> readings;
    std::vector<Vec3> drawn;
    double turn(bool counted_from_mesh) const {
        return degrees(azimuth_turn(
            readings, [&](int facet) { return drawn[std::size_t(facet)]; }, counted_from_mesh));
    }
};

// 64 facets all round. Each drawn azimuth is off by its own error of `scatter_deg` and by a common
// `turn_deg`.
Azimuths azimuths(double scatter_deg, double turn_deg, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal(0, radians(scatter_deg));
    Azimuths made;
    for (int f = 0; f < 64; ++f) {
        Reading r;
        r.kind = ReadingKind::azimuth;
        r.facets = {f};
        r.value = radians(360.0 / 64 * f);
        made.readings.push_back(r);
        const double drawn = r.value - radians(turn_deg) + normal(random);
        made.drawn.push_back({std::cos(drawn), std::sin(drawn), 0});
    }
    return made;
}

TEST(AzimuthTurn, OfARoughDrawingIsNone) {
    int turned = 0;
    for (unsigned seed = 0; seed < 200; ++seed) {
        for (const double scatter : {5.0, 40.0, 80.0}) {
            turned += azimuths(scatter, 0, seed).turn(true) != 0 ? 1 : 0;
        }
    }
    EXPECT_EQ(turned, 0);
    EXPECT_NE(azimuths(40, 0, 1).turn(false), 0) << "a free zero follows whatever it can";
}

TEST(AzimuthTurn, OfATurnedMeshIsFound) {
    EXPECT_NEAR(azimuths(0, -90, 1).turn(true), -90, 1e-9);
    EXPECT_NEAR(azimuths(20, 30, 1).turn(true), 30, 3 * 20 / 8.0);
    Azimuths one = azimuths(0, 30, 1);
    one.readings.resize(1);
    EXPECT_EQ(one.turn(true), 0) << "a facet may be drawn wrong";
}

}  // namespace
}  // namespace culet
