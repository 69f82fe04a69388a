// Readings that leave out a whole kind, or that share one error.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "stone/cuts/cuts.h"
#include "stone/solid/checks.h"
#include "tests/fit/fit_trials.h"
#include "tests/fit/test_stones.h"

namespace culet {
namespace {

using namespace bench;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::vector<WrittenReading> angles_of(const Truth& truth, unsigned seed) {
    std::vector<WrittenReading> readings = read_by_instruments(truth, seed);
    std::erase_if(readings, [](const WrittenReading& r) { return r.kind != "inclination"; });
    const std::vector<WrittenReading> azimuths = read_azimuths(truth, seed);
    readings.insert(readings.end(), azimuths.begin(), azimuths.end());
    return readings;
}

// Meets are released and no girdle angle was read: with the prior, girdle facets stay upright as
// drawn, though the mesh has other proportions than the stone.
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

// Angles fit best to a stone of zero size, all of whose planes meet in one point: chi-square 0.
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

// Numbered names do not tell tiers: all facets share their letter. Open quantities are grouped into
// stars, halves and mains, by their side of the girdle.
TEST(Unread, NumberedFacetsAreGroupedByTheirForm) {
    Stone stone;
    stone.solid = make_cut("round-brilliant");
    std::vector<std::string> mains;
    for (std::size_t f = 0; f < stone.solid.facets.size(); ++f) {
        std::string& name = stone.solid.facets[f].name;
        const bool is_main = name[0] == 'P';
        name = "f" + std::to_string(f + 1);
        if (is_main) mains.push_back(name);
    }
    ASSERT_EQ(mains.size(), 8u);
    stone.solid.design.reset();
    stone.up_facet = "f1";
    const std::vector<Reading> readings{test::width(stone.solid, 0, 0.01),
                                        test::width(stone.solid, 45, 0.01)};
    const FitResult result = fit_stone(stone, readings);
    EXPECT_EQ(result.status, FitStatus::undetermined) << result.message;
    EXPECT_THAT(result.findings.undetermined_words,
                Contains("nothing measured fixes the inclinations of the pavilion facets " +
                         fmt::format("{}", fmt::join(mains, ", "))));
}

// The goniometer's zero was set to the wrong mark: widths are not to blame.
TEST(Unread, ThatAzimuthsCountFromElsewhereIsSaidOnce) {
    const Truth truth = make_truth(TruthKind::step, false, 1);
    std::vector<WrittenReading> readings = read_by_instruments(truth, 3);
    for (WrittenReading azimuth : read_azimuths(truth, 4)) {
        *azimuth.value += 90;
        readings.push_back(std::move(azimuth));
    }
    Stone mesh = truth.stone;
    mesh.azimuth_from_mesh = true;
    const FitResult result = fit_mesh(mesh, readings).result;
    EXPECT_EQ(result.status, FitStatus::contradictory) << result.message;
    EXPECT_THAT(result.message, HasSubstr("all azimuths read are 90 degrees off"));
    EXPECT_THAT(result.findings.suspects, IsEmpty());
    EXPECT_LT(result.statistics.chi2, result.statistics.chi2_limit);
    // Residuals refer to the azimuths as they were read.
    for (const FittedReading& r : result.readings) {
        if (r.kind != ReadingKind::azimuth) continue;
        EXPECT_LT(std::abs(std::remainder(r.fitted - r.value, 2 * std::numbers::pi)), 6 * r.sigma);
    }
}

}  // namespace
}  // namespace culet
