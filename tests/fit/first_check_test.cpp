// Checks readings against their tier and the mesh before any fit. Expectations: the sizes of the
// slips that the tests make.

#include "fit/findings/first_check.h"
#include "fit/fit.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fit/findings/tier_findings.h"
#include "fit/hypotheses/doubted_readings.h"
#include "stone/cuts/cuts.h"
#include "stone/design/tiers.h"
#include "tests/fit/cutters.h"
#include "tests/says.h"

namespace culet {
namespace {

using bench::cutters_evening;
using bench::Evening;
using bench::Slipped;
using test::says;
using testing::HasSubstr;

WrittenReading row(const std::string& kind, std::vector<std::string> of, double value, double sigma,
                   long line) {
    WrittenReading w;
    w.kind = kind;
    w.of = std::move(of);
    w.value = value;
    w.sigma = sigma;
    w.file = "readings.csv";
    w.line = line;
    return w;
}

class FirstCheck : public testing::Test {
protected:
    FirstCheck() {
        stone_.solid = make_cut("round-brilliant", {{"crown-angle", 33.8}});
        stone_.up_facet = "T";
        stone_.material.density_g_cm3 = 3.52;
    }
    std::vector<Reading> mains(double fifth) const {
        const double values[]{33.8, 33.7, 33.9, 33.8, fifth, 33.8, 33.9, 33.7};
        std::vector<WrittenReading> rows;
        for (int i = 0; i < 8; ++i) {
            rows.push_back(
                row("inclination", {"C" + std::to_string(i + 1)}, values[i], 0.1, i + 2));
        }
        return bind_readings(rows, stone_);
    }
    std::vector<Reading> lengths(double third, double depth, double carats) const {
        return bind_readings(
            {row("width", {"0"}, 6.50, 0.01, 2), row("width", {"45"}, 6.51, 0.01, 3),
             row("width", {"90"}, third, 0.01, 4), row("width", {"135"}, 6.49, 0.01, 5),
             row("depth", {}, depth, 0.01, 6), row("weight", {}, carats, 0.005, 7)},
            stone_);
    }
    double depth() const { return width_along(stone_.solid, {0, 0, 1}); }
    double carats() const { return carat(volume(stone_.solid), 3.52); }
    Stone stone_;
};

TEST_F(FirstCheck, NamesSwappedDigitsWithFileLineAndSlip) {
    const std::vector<Doubt> doubts = first_check(stone_, mains(38.3), true);
    ASSERT_EQ(doubts.size(), 1u);
    EXPECT_EQ(doubts[0].reading, 4u);
    EXPECT_EQ(doubts[0].slip, "two digits swapped");
    EXPECT_NEAR(degrees(doubts[0].corrected), 33.8, 1e-9);
    EXPECT_THAT(doubts[0].what, HasSubstr("readings.csv line 6"));
    EXPECT_THAT(doubts[0].what, says("4.5 degrees", "33.7", "33.9"));
}

TEST_F(FirstCheck, AMainHalfADegreeOffIsAFindingAndNoSlip) {
    EXPECT_TRUE(first_check(stone_, mains(34.3), true).empty());
}

TEST_F(FirstCheck, LoneAnglesAreHeldAgainstTheMesh) {
    const auto one = bind_readings({row("inclination", {"C1"}, 56.2, 0.1, 2)}, stone_);
    const std::vector<Doubt> doubts = first_check(stone_, one, true);
    ASSERT_EQ(doubts.size(), 1u);
    EXPECT_EQ(doubts[0].slip, "counted from the other side");
}

TEST_F(FirstCheck, LengthsAreHeldAgainstEachOtherAndTheMesh) {
    EXPECT_TRUE(first_check(stone_, lengths(6.50, depth(), carats()), true).empty());
    const auto only = [&](const std::vector<Reading>& readings, std::size_t wanted) {
        const std::vector<Doubt> doubts = first_check(stone_, readings, true);
        ASSERT_EQ(doubts.size(), 1u);
        EXPECT_EQ(doubts[0].reading, wanted) << doubts[0].what;
    };
    only(lengths(5.60, depth(), carats()), 2);       // digits swapped
    only(lengths(6.50, depth() * 10, carats()), 4);  // decimal point
    only(lengths(6.50, depth(), carats() / 5), 5);   // grams
}

TEST_F(FirstCheck, ARowForAWholeTierDoesNotVouchForItself) {
    // Eight equal values from one row are wrong together.
    const auto readings = bind_readings({row("inclination", {"C*"}, 43.3, 0.1, 2)}, stone_);
    EXPECT_EQ(first_check(stone_, readings, true).size(), 8u);
}

// One row or value for each of five tiers, all as drawn except the pavilion mains, which each test
// changes.
std::vector<Reading> tiers_as_drawn(const Stone& stone, double mains, double others) {
    std::vector<WrittenReading> rows;
    long line = 2;
    double sign = 1;
    for (const Facet& facet : stone.solid.facets) {
        const char tier = facet.name[0];
        const bool is_main = tier == 'C' || tier == 'P';
        if (tier == 'T' || (!is_main && facet.name.size() > 1 && facet.name.substr(1) != "1")) {
            continue;
        }
        const double drawn = degrees(inclination(facet.plane.normal, {0, 0, 1}));
        if (!is_main) sign = -sign;
        rows.push_back(row("inclination", {is_main ? facet.name : facet.name.substr(0, 1) + "*"},
                           tier == 'P' ? mains : std::min(90.0, drawn + sign * others), 0.1,
                           line++));
    }
    return bind_readings(rows, stone);
}

TEST_F(FirstCheck, ATierTypedWithTheValueOfAnotherIsNamedAsAWhole) {
    // The crown mains get the design angle, but were read 0.3 degrees flatter. They are seven
    // degrees off, the others at most 0.3.
    const std::vector<Doubt> doubts = first_check(stone_, tiers_as_drawn(stone_, 33.8, 0.3), true);
    ASSERT_EQ(doubts.size(), 8u);
    EXPECT_THAT(doubts[0].what, says("pavilion mains", "than the mesh", "within 0.3",
                                     "33.5 is the value of the crown mains"));
}

TEST_F(FirstCheck, ATierThatIsOffAsOthersAreIsNoSlip) {
    const double drawn = degrees(inclination(
        stone_.solid.facets[std::size_t(find_facet(stone_.solid, "P1"))].plane.normal, {0, 0, 1}));
    EXPECT_TRUE(first_check(stone_, tiers_as_drawn(stone_, drawn + 1, 0.3), true).empty());
    // Where the others are off by two degrees, three are unsurprising.
    EXPECT_TRUE(first_check(stone_, tiers_as_drawn(stone_, drawn + 3.1, 2), true).empty());
    // Five degrees off where the others are within 0.1, and not another tier's value.
    EXPECT_EQ(first_check(stone_, tiers_as_drawn(stone_, drawn + 5, 0.1), true).size(), 8u);
}

Stone an_oval() {
    Stone oval;
    oval.solid = make_cut("oval", {{"ratio", 1.4}});
    oval.up_facet = "T";
    return oval;
}

std::vector<WrittenReading> rows_as_drawn(const Stone& stone, const std::string& letters) {
    std::vector<WrittenReading> rows;
    for (const Facet& facet : stone.solid.facets) {
        if (letters.find(facet.name[0]) == std::string::npos) continue;
        const double is = degrees(inclination(facet.plane.normal, {0, 0, 1}));
        rows.push_back(row("inclination", {facet.name}, is, 0.1, long(rows.size()) + 2));
    }
    return rows;
}

// An oval's crown mains are three tiers with angles of their own. All of them get the value of the
// stars: compared with one another, each would hide the others' slip.
TEST_F(FirstCheck, SeveralTiersWithTheValueOfAnotherAreNamed) {
    const Stone oval = an_oval();
    std::vector<WrittenReading> rows = rows_as_drawn(oval, "CPS");
    const auto star = std::find_if(rows.begin(), rows.end(),
                                   [](const WrittenReading& r) { return r.of[0] == "S1"; });
    ASSERT_NE(star, rows.end());
    for (WrittenReading& r : rows) {
        if (r.of[0][0] == 'C') r.value = star->value;
    }
    const std::vector<Reading> readings = bind_readings(rows, oval);
    const std::vector<Doubt> doubts = first_check(oval, readings, true);
    ASSERT_EQ(doubts.size(), 8u);
    for (const Doubt& d : doubts) EXPECT_EQ(readings[d.reading].of[0][0], 'C') << d.what;
}

TEST_F(FirstCheck, ATierWhoseFacetsDifferByDesignIsNoSlip) {
    const Stone oval = an_oval();
    EXPECT_TRUE(first_check(oval, bind_readings(rows_as_drawn(oval, "C"), oval), true).empty());
}

// C1 and C5, the mains at an oval's two ends, form a tier of two facets with equal angles by
// symmetry. A lost digit in the second row is not a slip in the first.
TEST_F(FirstCheck, ASlipInOneOfTwoFacetsIsNotOneOfTheirTier) {
    const Stone oval = an_oval();
    std::vector<WrittenReading> rows = rows_as_drawn(oval, "CPS");
    const auto fifth = std::find_if(rows.begin(), rows.end(), [](const WrittenReading& r) {
        return r.of == std::vector<std::string>{"C5"};
    });
    ASSERT_NE(fifth, rows.end());
    fifth->value = std::fmod(*fifth->value, 10);
    const std::vector<Doubt> doubts = first_check(oval, bind_readings(rows, oval), true);
    ASSERT_EQ(doubts.size(), 1u);
    EXPECT_FALSE(doubts[0].of_tier);
    EXPECT_THAT(doubts[0].what, HasSubstr(fmt::format("line {}", fifth->line)));
}

TEST_F(FirstCheck, AFitGoesOnWithoutTheDoubtedReadingAndListsItFirst) {
    const Evening evening = cutters_evening("round-brilliant", {}, Slipped::digits_swapped, 3);
    const std::vector<Reading> readings = bind_readings(evening.rows, evening.design);
    FitOptions options;
    options.prior.source = Prior::Source::catalogue;
    options.first_check = true;
    const FitResult result = fit_stone(evening.design, readings, options);
    EXPECT_EQ(result.status, FitStatus::contradictory);
    ASSERT_EQ(result.readings.size(), readings.size());
    ASSERT_FALSE(result.findings.suspects.empty());
    const auto wrong = std::find_if(readings.begin(), readings.end(), [&](const Reading& r) {
        return r.line == evening.wrong_lines[0];
    });
    EXPECT_EQ(result.findings.suspects[0], wrong->id);
    // The same measure applies before and after, and both figures are reported.
    ASSERT_EQ(result.log.changed.size(), 1u);
    EXPECT_EQ(result.log.changed[0].what, "readings left out");
    EXPECT_GT(result.log.changed[0].before, result.log.changed[0].after + 10.8);  // chi2, 1 in 1000
    EXPECT_TRUE(result.checks.closed && result.checks.convex &&
                result.checks.missing_facets.empty());
}

TEST_F(FirstCheck, IsHeededOnlyWhereTheFitIsBetterWithoutTheReading) {
    Problem given{stone_, mains(38.3), {}};
    given.options.first_check = true;
    given.options.prior.source = Prior::Source::catalogue;
    given.read_in_full = false;
    Attempt first;
    const auto changed = without_doubted(given, first);
    ASSERT_TRUE(changed);
    EXPECT_EQ(changed->readings.size(), 7u);
    // A single reading lowers chi-square by more than 10.8 by chance once in a thousand times (one
    // degree of freedom).
    const struct {
        FitStatus with;
        double chi2_with, chi2_without;
        double baarda;  // of the doubted reading in the first fit; 3.29 squared is 10.8
        bool is_left_out;
    } cases[] = {
        {FitStatus::converged, 15, 15, 0, false},   {FitStatus::converged, 15, 4.5, 0, false},
        {FitStatus::converged, 15, 4, 0, true},     {FitStatus::converged, 15, 14, -3.2, false},
        {FitStatus::converged, 15, 14, -3.4, true}, {FitStatus::not_converged, 15, 15, 0, true}};
    const auto doubted =
        std::find_if(given.readings.begin(), given.readings.end(), [&](const Reading& r) {
            return std::none_of(changed->readings.begin(), changed->readings.end(),
                                [&](const Reading& kept) { return kept.id == r.id; });
        });
    ASSERT_NE(doubted, given.readings.end());
    first.result.readings.resize(1);
    first.result.readings[0].id = doubted->id;
    for (const auto& c : cases) {
        first.result.status = c.with;
        first.result.statistics.chi2 = c.chi2_with;
        first.result.readings[0].normalized = c.baarda;
        FitResult again;
        again.status = FitStatus::converged;
        again.statistics.chi2 = c.chi2_without;
        again.readings.resize(7);
        again.facets.resize(stone_.solid.facets.size());
        EXPECT_EQ(judge_doubted(given, first, *changed, again).explained.has_value(), c.is_left_out)
            << c.chi2_without << ", " << c.baarda;
    }
}

TEST_F(FirstCheck, TwoSteepMainsAreToldInOneSentence) {
    std::vector<Reading> readings = mains(33.8);
    readings[2].value += radians(0.5);
    readings[3].value += radians(0.5);
    const auto tiers = tier_findings(stone_, readings, {}, true);
    ASSERT_EQ(tiers.size(), 1u);
    EXPECT_EQ(tiers[0].name, "C*");
    ASSERT_EQ(tiers[0].odd.size(), 1u);
    EXPECT_THAT(tiers[0].odd[0].facets, testing::ElementsAre("C3", "C4"));
    // Weighted means: these values are 0.55 steeper, with sigma 0.1 sqrt(1/2 + 1/6).
    EXPECT_NEAR(degrees(tiers[0].odd[0].sigma), 0.0816, 1e-4);
    EXPECT_THAT(tiers[0].what[0], says("C3", "C4", "0.6 ± 0.1 degrees", "steeper"));
}

TEST_F(FirstCheck, MainsThatAreAlikeGiveNoSentence) {
    EXPECT_TRUE(tier_findings(stone_, mains(33.8), {}, true)[0].odd.empty());
}

// An oval whose facets an exporter numbered, read as drawn: its angles take many values, and none
// of them stands out.
TEST(FirstCheckOfNumberedFacets, FindsNothingInAStoneReadAsDrawn) {
    Stone stone;
    stone.solid = make_cut("oval");
    std::vector<WrittenReading> rows;
    for (std::size_t f = 0; f < stone.solid.facets.size(); ++f) {
        Facet& facet = stone.solid.facets[f];
        facet.name = "F" + std::to_string(f);
        rows.push_back(row("inclination", {facet.name},
                           degrees(inclination(facet.plane.normal, {0, 0, 1})), 0.1, long(f) + 2));
    }
    stone.up_facet = stone.solid.facets[std::size_t(table_facet(stone.solid, {0, 0, 1}))].name;
    const std::vector<Reading> readings = bind_readings(rows, stone);
    EXPECT_TRUE(first_check(stone, readings, false).empty());
    for (const NamedTierFinding& tier : tier_findings(stone, readings, {}, false)) {
        EXPECT_TRUE(tier.odd.empty()) << tier.what[0];
    }
}

// A difference that the drawing has too is not reported.
TEST_F(FirstCheck, AMainThatIsDrawnSteeperIsNotSaidToStandOut) {
    std::vector<Reading> readings = mains(33.8);
    readings[2].value += radians(1.0);
    EXPECT_FALSE(tier_findings(stone_, readings, {}, false)[0].odd.empty());
    Facet& c3 = stone_.solid.facets[std::size_t(find_facet(stone_.solid, "C3"))];
    const double tilt = radians(33.8 + 1.0), turn = azimuth(c3.plane.normal);
    c3.plane.normal = {std::sin(tilt) * std::cos(turn), std::sin(tilt) * std::sin(turn),
                       std::cos(tilt)};
    for (const NamedTierFinding& tier : tier_findings(stone_, readings, {}, false)) {
        EXPECT_TRUE(tier.odd.empty()) << tier.what[0];
    }
}

}  // namespace
}  // namespace culet
