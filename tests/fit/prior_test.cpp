// The prior of the facets: it determines what readings leave open, and its sigmas are honest.

#include "fit/model/prior.h"
#include "fit/fit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "stone/cuts/cuts.h"
#include "stone/solid/checks.h"
#include "tests/fit/cutters.h"
#include "tests/fit/fit_truth.h"

namespace culet {
namespace {

using bench::cutters_evening;
using bench::Evening;
using bench::Slipped;

FitOptions with_prior() {
    FitOptions options;
    options.prior.source = Prior::Source::catalogue;
    options.first_check = true;
    return options;
}

class PriorOfCut : public testing::TestWithParam<const char*> {};

double true_inclination(const Evening& evening, const FittedFacet& facet) {
    const int there = find_facet(evening.truth, facet.name);
    return inclination(evening.truth.facets[std::size_t(there)].plane.normal, {0, 0, 1});
}

void expect_whole(const FitResult& result) {
    EXPECT_EQ(result.status, FitStatus::converged) << result.message;
    EXPECT_TRUE(result.checks.closed && result.checks.convex &&
                result.checks.missing_facets.empty());
    EXPECT_EQ(result.statistics.prior.source, Prior::Source::catalogue);
    EXPECT_EQ(result.statistics.rank_defect, 0);
    // The sigmas of the simulated readings are those of their errors.
    EXPECT_THAT(result.message, testing::Not(testing::HasSubstr("than their sigmas")));
}

// Squares of errors over sigmas of facets that nobody read.
void add_unread(const Evening& evening, const FitResult& result, double& squares, int& count) {
    for (std::size_t f = 0; f < result.facets.size(); ++f) {
        const FittedFacet& fitted = result.facets[f];
        if (evening.was_read[f] || fitted.name == "T") continue;
        squares += std::pow(
            (fitted.inclination - true_inclination(evening, fitted)) / fitted.sigma_inclination, 2);
        ++count;
    }
}

// Every fit takes a second or two and serves all three questions: is the stone whole; are the
// sigmas of facets that nobody read honest; are the facets that were read no further off than their
// readings. Stones whose planes meet, and stones whose planes miss each other by some 0.02 mm.
TEST_P(PriorOfCut, GivesAWholeStoneWithHonestSigmasNoFurtherOffThanItsReadings) {
    for (const bool meets : {true, false}) {
        double errors = 0, own = 0, over_sigma = 0, unread = 0;
        int count = 0, unread_count = 0;
        bench::Population population;
        population.meets = meets;
        for (std::uint64_t seed = 11; seed <= 16; ++seed) {
            const Evening evening = cutters_evening(GetParam(), population, Slipped::none, seed);
            const std::vector<Reading> readings = bind_readings(evening.rows, evening.design);
            const FitResult result = fit_stone(evening.design, readings, with_prior());
            if (!meets) {
                expect_whole(result);
                add_unread(evening, result, unread, unread_count);
            }
            for (const Reading& r : readings) {
                if (r.kind != ReadingKind::inclination || !evening.was_read[r.facets[0]]) continue;
                const FittedFacet& fitted = result.facets[std::size_t(r.facets[0])];
                const double is = true_inclination(evening, fitted);
                errors += std::pow(fitted.inclination - is, 2);
                own += std::pow(r.value - is, 2);
                over_sigma += std::pow((fitted.inclination - is) / fitted.sigma_inclination, 2);
                ++count;
            }
        }
        // The readings are the standard: the fit must not move away from them, and must not claim
        // to be better than it is. With 100 correlated facets a ratio of 1.2 is two standard errors
        // above 1.
        EXPECT_LT(std::sqrt(errors / own), 1.1) << meets;
        EXPECT_LT(std::sqrt(over_sigma / count), 1.2) << meets;
        if (meets) continue;
        // Chi-square of some 70 correlated facets: twice the expected value would mean sigmas that
        // are too small by 1.4.
        EXPECT_LT(unread / unread_count, 1.5);
        EXPECT_GT(unread / unread_count, 0.3);
    }
}

INSTANTIATE_TEST_SUITE_P(Cuts, PriorOfCut,
                         testing::Values("round-brilliant", "oval", "cushion", "step"));

TEST(Prior, IsLeftOutWhereTheReadingsHoldTheStone) {
    const bench::Truth truth = bench::make_truth(bench::TruthKind::step, false, 1);
    std::vector<WrittenReading> rows = bench::read_by_instruments(truth, 5);
    for (const WrittenReading& w : bench::read_azimuths(truth, 5)) rows.push_back(w);
    FitOptions options = with_prior();
    options.prior.source = Prior::Source::mesh;
    const std::vector<Reading> readings = bind_readings(rows, truth.stone);
    const FitResult with = fit_stone(truth.stone, readings, options);
    const FitResult without = fit_stone(truth.stone, readings, FitOptions());
    EXPECT_EQ(with.statistics.prior.source, Prior::Source::none);
    EXPECT_EQ(with.status, without.status);
    EXPECT_DOUBLE_EQ(with.statistics.chi2, without.statistics.chi2);
    for (const FittedFacet& facet : with.facets) EXPECT_EQ(facet.read_inclination, 1);
}

TEST(Prior, AReadingDrawsItsFacetAndIsToldFromThePrior) {
    Stone stone;
    stone.solid = make_cut("round-brilliant");
    stone.up_facet = "T";
    WrittenReading w;
    w.kind = "inclination";
    w.of = {"P1"};
    const double start = degrees(inclination(
        stone.solid.facets[std::size_t(find_facet(stone.solid, "P1"))].plane.normal, {0, 0, 1}));
    w.value = start + 0.5;
    w.sigma = 0.05;
    WrittenReading width;
    width.kind = "width";
    width.of = {"0"};
    width.value = 6.5;
    width.sigma = 0.01;
    const FitResult result = fit_stone(stone, bind_readings({w, width}, stone), with_prior());
    ASSERT_EQ(result.status, FitStatus::converged) << result.message;
    for (const FittedFacet& facet : result.facets) {
        if (facet.name == "P1") {
            EXPECT_GT(facet.read_inclination, 0.8);
            EXPECT_GT(degrees(facet.inclination), start + 0.3);
        }
        if (facet.name == "U1") {
            EXPECT_LT(facet.read_inclination, 0.2);
        }
    }
}

// Three planes always meet: there is nothing to weigh, and the fit equals that with exact meets.
TEST(Prior, MeetsOfThreePlanesAreExact) {
    for (const unsigned seed : {1U, 2U, 3U}) {
        const bench::Truth truth = bench::make_tiered(24, seed);
        const Stone mesh = bench::wrongly_drawn(truth.stone, 0.03, seed);
        std::vector<WrittenReading> rows;
        for (const WrittenReading& w : bench::read_by_instruments(truth, seed, 0)) {
            if (w.kind == "inclination" || w.kind == "width") rows.push_back(w);
        }
        const std::vector<Reading> readings = bind_readings(rows, mesh);
        FitOptions options;
        options.prior.source = Prior::Source::mesh;
        const FitResult weighed = fit_stone(mesh, readings, options);
        options.meets_named = true;
        const FitResult exact = fit_stone(mesh, readings, options);
        EXPECT_NE(exact.statistics.prior.source, Prior::Source::none);
        EXPECT_EQ(weighed.status, exact.status) << weighed.message;
        EXPECT_TRUE(weighed.checks.convex) << seed;
        EXPECT_DOUBLE_EQ(weighed.statistics.chi2, exact.statistics.chi2) << seed;
    }
}

TEST(Prior, SoftSymmetryOfFewReadingsEnds) {
    // The users' second job: 80 readings for 128 unknowns, and a rotation to within a sigma.
    for (const double sigma : {0.3, 0.5}) {
        Evening evening = cutters_evening("round-brilliant", {}, Slipped::none, 2);
        WrittenReading w;
        w.kind = "rotation";
        w.of = {"8"};
        w.sigma = sigma;
        evening.rows.push_back(w);
        const FitResult result =
            fit_stone(evening.design, bind_readings(evening.rows, evening.design), with_prior());
        EXPECT_NE(result.status, FitStatus::not_converged) << result.message;
        EXPECT_TRUE(result.checks.closed && result.checks.convex);
    }
}

}  // namespace
}  // namespace culet
