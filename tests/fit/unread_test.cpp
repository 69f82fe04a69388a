// Readings that leave out a whole kind.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "stone/checks.h"
#include "tests/fit/fit_trials.h"
#include "tests/fit/test_stones.h"

namespace culet {
namespace {

using namespace bench;
using ::testing::Contains;
using ::testing::HasSubstr;

std::vector<WrittenReading> angles_of(const Truth& truth, unsigned seed) {
    std::vector<WrittenReading> readings = read_by_instruments(truth, seed);
    std::erase_if(readings, [](const WrittenReading& r) { return r.kind != "inclination"; });
    const std::vector<WrittenReading> azimuths = read_azimuths(truth, seed);
    readings.insert(readings.end(), azimuths.begin(), azimuths.end());
    return readings;
}

// Meets released, no angle of the girdle read: beside the prior its facets stay upright, as they
// were drawn, though the mesh is of other proportions than the stone.
TEST(Unread, AGirdleStaysUpright) {
    const test::BrilliantSize drawn{.radius = 1, .crown_deg = 30, .pavilion_deg = 43};
    const Solid truth = test::brilliant();
    const Stone mesh = test::stone_of(test::brilliant(drawn));
    std::vector<Reading> readings;
    for (const Reading& r : test::plane_readings(mesh.solid, truth, 0.1, 0.01)) {
        const bool is_girdle = std::any_of(r.facets.begin(), r.facets.end(), [&](int f) {
            return mesh.solid.facets[std::size_t(f)].name[0] == 'G';
        });
        if (is_angle(r.kind) && !is_girdle) readings.push_back(r);
    }
    readings.push_back(test::depth(truth, 0.01));
    for (const double azimuth : {0.0, 45.0, 90.0, 135.0}) {
        readings.push_back(test::width(truth, azimuth, 0.01));
    }
    FitOptions options;
    options.meets = MeetTreatment::released;
    options.prior.source = Prior::Source::mesh;
    const FitResult result = fit_stone(mesh, test::noisy(readings, 5), options);
    EXPECT_EQ(result.statistics.prior.source, Prior::Source::mesh) << result.message;
    int girdle = 0;
    for (const FittedFacet& f : result.facets) {
        if (f.name[0] != 'G') continue;
        ++girdle;
        EXPECT_NEAR(degrees(f.inclination), 90, 1) << f.name;
    }
    EXPECT_EQ(girdle, 16);
}

// Angles agree best with a stone of no size, all of whose planes meet in one point: chi-square 0.
TEST(Unread, AllLengthsOfAPearLeaveItsSizeAsInTheMesh) {
    const Truth truth = make_truth(TruthKind::pear, false, 1);
    const Stone mesh = noisy_mesh(truth.stone, 0.01, 2);
    const FitResult result = fit_mesh(mesh, angles_of(truth, 3)).result;
    EXPECT_EQ(result.status, FitStatus::undetermined) << result.message;
    EXPECT_THAT(result.message, HasSubstr("no length was read"));
    EXPECT_THAT(result.findings.undetermined_words,
                Contains("nothing measured fixes the size of the stone"));
    EXPECT_TRUE(result.checks.closed);
    EXPECT_TRUE(result.checks.convex);
    EXPECT_NEAR(width_along(result.solid, {0, 0, 1}) / width_along(truth.stone.solid, {0, 0, 1}), 1,
                0.1);
    for (const FittedReading& r : result.readings) EXPECT_NE(r.kind, ReadingKind::depth);
}

}  // namespace
}  // namespace culet
