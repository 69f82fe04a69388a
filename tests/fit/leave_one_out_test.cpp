// Readings so wrong that the stone breaks or bends: the report must name the reading, not the
// stone. The step cut is that of the benchmark; the right value of each reading is known by
// construction.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "stone/numbers/units.h"
#include "stone/solid/checks.h"
#include "tests/fit/fit_trials.h"

namespace culet {
namespace {

using namespace bench;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class GrossReadings : public ::testing::Test {
protected:
    GrossReadings() : truth_(make_truth(TruthKind::step, false, 3)) {
        readings_ = read_by_instruments(truth_, 11);
        for (std::size_t i = 0; i < readings_.size(); ++i) {
            readings_[i].id = "m" + std::to_string(i);
        }
    }
    WrittenReading& inclination_of(const std::string& facet) {
        return *std::find_if(readings_.begin(), readings_.end(), [&](const WrittenReading& r) {
            return r.kind == "inclination" && r.of[0] == facet;
        });
    }
    FitResult fitted() const {
        FitOptions options;
        options.first_check = true;
        const Trial trial = fit_mesh(noisy_mesh(truth_.stone, 0.01, 4), readings_, options);
        EXPECT_EQ(trial.refusal, "");
        return trial.result;
    }

    Truth truth_;
    std::vector<WrittenReading> readings_;
};

// 1 ct = 0.2 g. With this weight the girdle has no room, but the girdle is not at fault.
TEST_F(GrossReadings, AWeightInGramsIsNamedAndNotTheGirdle) {
    const double mm3 = volume(truth_.stone.solid);
    const double carats = carat(mm3, *truth_.stone.material.density_g_cm3);
    WrittenReading weight;
    weight.kind = "weight";
    weight.id = "scale";
    weight.value = 0.2 * carats;
    weight.sigma = 0.002;
    readings_.push_back(weight);
    const FitResult result = fitted();
    EXPECT_EQ(result.status, FitStatus::contradictory) << result.message;
    EXPECT_THAT(result.findings.suspects, ElementsAre("scale"));
    ASSERT_FALSE(result.findings.proposals.empty());
    EXPECT_EQ(result.findings.proposals[0].slip, "grams for carats");
    EXPECT_NEAR(result.findings.proposals[0].corrected, carats, 1e-9);
    EXPECT_NEAR(result.findings.proposals[0].estimate, carats,
                5 * result.findings.proposals[0].sigma);
    EXPECT_THAT(result.message, HasSubstr("scale (weight"));
    EXPECT_THAT(find_faults(result.solid), ::testing::IsEmpty());
    ASSERT_EQ(result.readings.size(), readings_.size());
    EXPECT_DOUBLE_EQ(result.readings.back().sigma, 0.002);
    EXPECT_FALSE(result.readings.back().left_out.empty());
}

// Such a reading bends the stone so much that its neighbour looks wrong too, and its own error is
// misestimated.
TEST_F(GrossReadings, OneInclinationWithSwappedDigitsIsAccusedAlone) {
    WrittenReading& wrong = inclination_of("C1E");
    const double meant = std::round(*wrong.value);
    ASSERT_GT(std::abs(meant - 10 * (int(meant) % 10) - int(meant) / 10), 9) << meant;
    wrong.value = 10 * (int(meant) % 10) + int(meant) / 10;
    const FitResult result = fitted();
    EXPECT_EQ(result.status, FitStatus::contradictory) << result.message;
    EXPECT_THAT(result.findings.suspects, ElementsAre(wrong.id));
    ASSERT_FALSE(result.findings.proposals.empty());
    EXPECT_EQ(result.findings.proposals[0].slip, "two digits swapped");
    EXPECT_NEAR(degrees(result.findings.proposals[0].corrected), meant, 1e-9);
}

TEST_F(GrossReadings, AzimuthsThatCountFromElsewhereThanTheMeshAreSaidToBe) {
    truth_.stone.azimuth_from_mesh = true;
    for (const Facet& f : truth_.stone.solid.facets) {
        if (f.name == "T") continue;
        WrittenReading r;
        r.kind = "azimuth";
        r.of = {f.name};
        r.value = std::remainder(degrees(azimuth(f.plane.normal)) + 90, 360);
        r.sigma = 0.1;
        readings_.push_back(r);
    }
    std::erase_if(readings_, [](const WrittenReading& r) { return r.kind == "width"; });
    const FitResult result = fitted();
    EXPECT_EQ(result.status, FitStatus::converged) << result.message;
    EXPECT_THAT(result.log.notes, ::testing::Contains(HasSubstr("turned by -90 degrees")));
}

// Azimuths counted in the opposite sense, which contradict the drawing of a step cut: the fit takes
// the mirror image because it suits the readings better, and reports both chi-squares.
TEST_F(GrossReadings, AzimuthsOfTheMirrorImageAreSaidToBe) {
    truth_.stone.azimuth_from_mesh = true;
    for (const Facet& f : truth_.stone.solid.facets) {
        if (f.name == "T") continue;
        WrittenReading r;
        r.kind = "azimuth";
        r.of = {f.name};
        r.value = -degrees(azimuth(f.plane.normal));
        r.sigma = 0.1;
        readings_.push_back(r);
    }
    std::erase_if(readings_, [](const WrittenReading& r) { return r.kind == "width"; });
    const FitResult result = fitted();
    EXPECT_EQ(result.status, FitStatus::contradictory) << result.message;
    EXPECT_THAT(result.message, HasSubstr("mirror image"));
    ASSERT_EQ(result.log.changed.size(), 1u);
    EXPECT_EQ(result.log.changed[0].what, "mesh mirrored");
    EXPECT_LT(result.log.changed[0].after, result.statistics.chi2_limit);
    EXPECT_GT(result.log.changed[0].before, result.log.changed[0].after + 25);
}

}  // namespace
}  // namespace culet
