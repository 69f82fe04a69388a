#include "fit/findings/summary.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "stone/numbers/units.h"
#include "tests/says.h"

namespace culet {
namespace {

using test::says;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

FittedFacet facet(const std::string& name, double sigma_deg) {
    FittedFacet f;
    f.name = name;
    f.inclination = radians(90);
    f.sigma_inclination = radians(0.6 * sigma_deg);
    f.sigma_azimuth = radians(0.8 * sigma_deg);
    return f;
}

FitResult result() {
    FitResult r;
    r.status = FitStatus::converged;
    r.statistics.chi2 = 48.9;
    r.statistics.dof = 94;
    r.statistics.chi2_limit = 142.1;
    r.facets = {facet("P1", 0.1), facet("P2", 0.3), facet("P3", 0.2)};
    FittedReading reading;
    reading.id = "r0";
    reading.of = {"P1"};
    reading.value = radians(43.4);
    reading.residual = radians(-4.5);
    reading.redundancy = 0.5;
    reading.normalized = -12.34;
    r.readings = {reading};
    return r;
}

TEST(Summary, NamesTheLeastSureFacets) {
    const auto lines = fit_summary(result());
    EXPECT_THAT(lines.front(), says("48.9", "94.0"));
    EXPECT_THAT(lines, Contains(says("P2 (0.3", "P3 (0.2")));
    EXPECT_THAT(lines, Not(Contains(HasSubstr("r0"))));
}

TEST(Summary, SaysWhatTheOthersSayOfASuspect) {
    FitResult r = result();
    r.status = FitStatus::contradictory;
    r.findings.suspects = {"r0"};
    r.findings.proposals = {{"r0", true, radians(34.4), radians(0.1), {}, 0, {}}};
    EXPECT_THAT(fit_summary(r), Contains(says("r0", "inclination", "P1", "43.4", "34.4", "12.3")));
}

TEST(Summary, NamesTheSlipThatWouldExplainASuspect) {
    FitResult r = result();
    r.findings.suspects = {"r0"};
    r.findings.proposals = {
        {"r0", true, radians(34.41), radians(0.1), "digits swapped", radians(34.4), {}}};
    EXPECT_THAT(fit_summary(r), Contains(says("34.41 ± 0.1", "digits swapped", "34.4?")));
}

TEST(Summary, NamesASetOnlyWhereNoSingleReadingExplains) {
    FitResult r = result();
    r.findings.disagreeing = {"a", "b", "c"};
    EXPECT_THAT(fit_summary(r), Contains(HasSubstr("a, b, c")));
    r.findings.suspects = {"r0"};
    EXPECT_THAT(fit_summary(r), Not(Contains(HasSubstr("a, b, c"))));
}

TEST(Summary, TellsWhatWasFoundOut) {
    FitResult r = result();
    r.findings.undetermined_words = {"nothing measured fixes the azimuth of star S3"};
    r.findings.help = {{ReadingKind::azimuth, {"S4"}, 0.1, 0.02, true}, {}};
    r.log.changes = {"edges gone: A|B"};
    r.findings.own_axis.known = true;
    r.findings.own_axis.tilt = radians(0.8);
    r.findings.own_axis.sigma = radians(0.04);
    r.findings.own_axis.azimuth = radians(120);
    MeetFinding meet;
    meet.contradicted = true;
    meet.advice = "meet of P1..P8: planes miss by 20 µm: release it";
    r.findings.meets = {meet, {}};
    r.findings.symmetry.emplace();
    r.findings.symmetry->message = "C8v is supported";
    const auto lines = fit_summary(r);
    // Findings keep their wording; a sentence begins with a capital letter.
    for (const char* words : {"azimuth of star S3", "edges gone: A|B",
                              "P1..P8: planes miss by 20 µm: release it", "C8v is supported"}) {
        EXPECT_THAT(lines, Contains(HasSubstr(words)));
    }
    EXPECT_THAT(lines, Contains(HasSubstr("0.8 ± 0.04")));
    EXPECT_THAT(lines, Contains(says("azimuth", "S4")));
    // A tilt within its uncertainty is not reported, and a reading that gains little is not
    // requested.
    r.findings.own_axis.sigma = radians(0.4);
    r.findings.help[0].closes = false;
    for (const std::string& line : fit_summary(r)) {
        EXPECT_THAT(line, Not(HasSubstr("0.8 +-")));
        EXPECT_THAT(line, Not(HasSubstr("S4")));
    }
}

TEST(Summary, SaysWhatIsOpenAndWhatNothingChecks) {
    FitResult r = result();
    r.status = FitStatus::undetermined;
    r.message = "2 freedoms";
    r.readings[0].redundancy = 0;
    r.findings.undetermined_words = {
        "nothing measured fixes the azimuth of pavilion facet P3",
        "nothing measured fixes the offsets of pavilion facets P1 and P3"};
    const auto lines = fit_summary(r);
    EXPECT_THAT(lines, Contains(says("azimuth", "P3")));
    EXPECT_THAT(lines, Contains(says("offsets", "P1", "P3")));
    EXPECT_THAT(lines, Contains(says("1 of 1", "r0")));
}

// Chi-square need not fall, since both fits estimate their sigmas; figures that do not show why a
// reading was left out are not said.
TEST(Summary, SaysChiSquareWithTheDoubtedReadingOnlyWhereItIsLarger) {
    FitResult r = result();
    r.status = FitStatus::contradictory;
    r.findings.doubts = {"readings.csv line 12: 43.4 is no angle of its tier"};
    r.log.changed = {{k_readings_left_out, "", 120.5, 48.9, "chi-square"}};
    EXPECT_THAT(fit_summary(r), Contains(says("left out", "120.5", "48.9")));
    r.log.changed[0].before = 40.5;
    const auto lines = fit_summary(r);
    EXPECT_THAT(lines, Contains(HasSubstr("left out")));
    for (const std::string& line : lines) EXPECT_THAT(line, Not(HasSubstr("chi-square")));
}

TEST(Summary, OfAFailureSaysNotToRelyOnIt) {
    FitResult r;
    r.message = "the fitted stone is not closed";
    const auto lines = fit_summary(r);
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_THAT(lines[0], HasSubstr(r.message));
}

TEST(Summary, SurvivesWhatIsNotKnown) {
    FitResult r = result();
    for (FittedFacet& f : r.facets) f.sigma_inclination = f.sigma_azimuth = std::nan("");
    r.readings[0].redundancy = std::nan("");
    r.findings.suspects = {"gone"};
    for (const std::string& line : fit_summary(r)) EXPECT_THAT(line, Not(HasSubstr("nan")));
}

}  // namespace
}  // namespace culet
