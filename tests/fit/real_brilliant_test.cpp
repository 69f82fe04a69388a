// The main evidence: a real polished diamond. Its readings (to 0.1 degree and 0.01 mm) are fitted
// from the catalogue's round brilliant. The facet areas measured on the same stone
// (real_brilliant_areas.csv) do not enter the fit and judge the result. bench_outside compares it
// with the unrounded planes of the scan.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <string>

#include "fit/fit.h"
#include "stone/solid/checks.h"
#include "stone/stone_io.h"

namespace culet {
namespace {

const std::filesystem::path k_sample = CULET_SOURCE_DIR "/samples/real-brilliant/stone.toml";

std::map<std::string, double> measured_areas() {
    std::ifstream file(CULET_SOURCE_DIR "/tests/fit/real_brilliant_areas.csv");
    std::map<std::string, double> areas;
    for (std::string line; std::getline(file, line);) {
        const std::size_t comma = line.find(',');
        if (line[0] != '#' && line != "name,area")
            areas[line.substr(0, comma)] = std::stod(line.substr(comma + 1));
    }
    return areas;
}

double degrees_apart(double a, double b) {
    return std::abs(degrees(std::remainder(a - b, 2 * std::numbers::pi)));
}

class RealBrilliant : public ::testing::Test {
protected:
    StoneFile stone_ = read_stone(k_sample);
    std::vector<Reading> readings_ = bind_readings(read_readings(k_sample), stone_.stone);
};

void expect_is_a_stone_that_could_be_cut(const FitResult& result, std::size_t facets) {
    EXPECT_EQ(result.status, FitStatus::converged) << result.message;
    EXPECT_TRUE(result.checks.closed);
    EXPECT_TRUE(result.checks.convex);
    EXPECT_LT(result.checks.planarity_max, 1e-9 * diameter(result.solid));
    EXPECT_EQ(result.solid.facets.size(), facets);
    EXPECT_THAT(result.checks.missing_facets, ::testing::IsEmpty());
    EXPECT_THAT(find_faults(result.solid), ::testing::IsEmpty());
}

// Checks angles and lengths of the written solid itself, not the fit's statistics.
void expect_holds_the_readings(const FitResult& result, const std::vector<Reading>& readings) {
    int angles = 0, lengths = 0;
    for (const Reading& r : readings) {
        const double turned = r.azimuth + result.azimuth_zero;
        const Vec3 across{std::cos(turned), std::sin(turned), 0};
        if (r.kind == ReadingKind::width) {
            EXPECT_NEAR(width_along(result.solid, across), r.value, 0.02) << r.id;
            ++lengths;
        } else if (r.kind == ReadingKind::depth) {
            EXPECT_NEAR(width_along(result.solid, {0, 0, 1}), r.value, 0.02);
            ++lengths;
        } else if (r.facets.size() == 1) {
            const auto& facet = result.solid.facets.at(static_cast<std::size_t>(r.facets[0]));
            if (facet.name[0] == 'G') continue;  // assumed upright, not read
            const Vec3 n = facet.plane.normal;
            const double there = r.kind == ReadingKind::azimuth ? azimuth(n) - result.azimuth_zero
                                                                : inclination(n, {0, 0, 1});
            EXPECT_LT(degrees_apart(there, r.value), 0.15) << r.id << " of " << facet.name;
            ++angles;
        }
    }
    EXPECT_EQ(angles, 56 * 2);
    EXPECT_EQ(lengths, 13);
}

// What limits areas is how facets miss their meets, not the instrument: the scan's unrounded angles
// give the same errors. Each facet may be off by three and a half of its reported standard
// uncertainties, and together the errors must be as large as reported. Measured: 49 of 57 within 10
// %; the worst (a pavilion main of 0.52 mm2, reported with 22 %) is off by 25 %.
void expect_areas_are_as_good_as_the_report_says(const FitResult& result) {
    const std::map<std::string, double> measured = measured_areas();
    double squares = 0;
    int within = 0, count = 0;
    for (const FittedFacet& f : result.facets) {
        if (f.name[0] == 'G') continue;
        ASSERT_TRUE(measured.contains(f.name)) << f.name;
        const double truth = measured.at(f.name);
        const double z = (f.area - truth) / f.sigma_area;
        EXPECT_LT(std::abs(z), 3.5) << f.name;
        squares += z * z;
        ++count;
        const double off = std::abs(f.area / truth - 1);
        if (off < 0.10) ++within;
        EXPECT_LT(off, 0.30) << f.name;
    }
    EXPECT_EQ(count, 57);
    EXPECT_GE(within, 48) << "of " << count;
    EXPECT_LT(std::sqrt(squares / count), 1.3);
    EXPECT_GT(std::sqrt(squares / count), 0.5);
}

// The scan's own planes miss the common points of table corners by 4.0 um, of star tips by 2.3, of
// the culet by 1.2 and of the lower halves' tips by 1.3 (square root of squares over redundancy).
void expect_estimates_how_meets_miss(const FitResult& result) {
    EXPECT_TRUE(result.statistics.meets.estimated);
    EXPECT_GT(result.statistics.meets.sigma, 0.0012);
    EXPECT_LT(result.statistics.meets.sigma, 0.0045);
}

TEST_F(RealBrilliant, ContradictsExactMeets) {
    FitOptions exact = read_fit_options(k_sample);
    exact.meets = MeetTreatment::exact;
    const FitResult result = fit_stone(stone_.stone, readings_, exact);
    EXPECT_EQ(result.status, FitStatus::contradictory) << result.message;
    EXPECT_GT(result.statistics.chi2, 5 * result.statistics.chi2_limit);
    EXPECT_FALSE(result.findings.suspects.empty());
    EXPECT_LT(result.checks.planarity_max, 1e-12 * diameter(result.solid));
}

// One test, because its fit takes seconds.
TEST_F(RealBrilliant, IsTheMeasuredStone) {
    const FitResult result = fit_stone(stone_.stone, readings_, read_fit_options(k_sample));
    expect_is_a_stone_that_could_be_cut(result, stone_.stone.solid.facets.size());
    expect_holds_the_readings(result, readings_);
    expect_areas_are_as_good_as_the_report_says(result);
    expect_estimates_how_meets_miss(result);
}

}  // namespace
}  // namespace culet
