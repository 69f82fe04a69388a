// Azimuths of level facets.
#include "fit/readings/level_facets.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "stone/text/errors.h"
#include "tests/fit/test_stones.h"

namespace culet {
namespace {

using namespace test;
using ::testing::HasSubstr;

std::vector<Reading> cube_readings(const Solid& solid) {
    std::vector<Reading> readings = all_angles(solid, radians(0.1), "T");
    for (const double azimuth_deg : {0.0, 90.0})
        readings.push_back(width(solid, azimuth_deg, 0.01));
    readings.push_back(depth(solid, 0.01));
    return readings;
}

TEST(LevelFacets, TheAzimuthOfANearlyLevelOneIsLeftOutAndSaid) {
    const Solid solid = cube();
    std::vector<Reading> readings = cube_readings(solid);
    const int bottom = find_facet(solid, "B");
    for (Reading& r : readings) {
        if (r.kind == ReadingKind::inclination && r.facets[0] == bottom) r.value = radians(0.15);
    }
    const FitResult without = fit_stone(stone_of(solid), readings);
    Reading azimuth = reading(ReadingKind::azimuth, {bottom}, radians(40), radians(0.1));
    azimuth.of = {"B"};
    readings.insert(readings.begin() + 3, azimuth);
    const FitResult result = fit_stone(stone_of(solid), readings);
    ASSERT_EQ(result.readings.size(), readings.size());
    EXPECT_FALSE(result.readings[3].left_out.empty());
    EXPECT_EQ(result.readings[3].id, azimuth.id);
    EXPECT_THAT(result.message, HasSubstr("a level facet has no azimuth"));
    // Everything else is as if the azimuth had not been read.
    EXPECT_EQ(result.status, without.status);
    EXPECT_DOUBLE_EQ(result.statistics.chi2, without.statistics.chi2);
}

TEST(LevelFacets, AnAzimuthThatMeansSomethingCounts) {
    // A tilt of five sigmas defines a direction.
    std::vector<Reading> readings{
        reading(ReadingKind::inclination, {5}, radians(0.5), radians(0.1)),
        reading(ReadingKind::azimuth, {5}, radians(40), radians(0.1))};
    EXPECT_TRUE(meaningless_azimuths(readings).empty());
    readings[0].value = radians(0.2);
    EXPECT_THAT(meaningless_azimuths(readings), testing::ElementsAre(1u));
    // A facet that leans by 34 degrees is not level, however uncertain its angle is.
    readings[0].value = radians(34);
    readings[0].sigma = 1e12;
    EXPECT_TRUE(meaningless_azimuths(readings).empty());
}

TEST(LevelFacets, AnAzimuthOfAnExactlyLevelOneIsRefused) {
    const Solid solid = cube();
    const int bottom = find_facet(solid, "B");
    std::vector<Reading> readings{reading(ReadingKind::inclination, {bottom}, 0, 0),
                                  reading(ReadingKind::azimuth, {bottom}, 1, 0.1)};
    EXPECT_NO_THROW(refuse_level_azimuths(readings, stone_of(solid)));
    readings[0].exact = true;
    EXPECT_THROW(refuse_level_azimuths(readings, stone_of(solid)), InputError);
}

}  // namespace
}  // namespace culet
