// Readings of one quantity share an equation. The results must be those of separate equations: the
// sums of squares differ by a constant.

#include "fit/readings/replicates.h"
#include "fit/model/equations.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "fit/solve/relaxation.h"
#include "fit/starts/refit.h"
#include "fit/uncertainty/diagnostics.h"
#include "stone/numbers/units.h"
#include "tests/fit/fit_truth.h"

namespace culet {
namespace {

using namespace bench;

Reading inclination(double value, double sigma, int facet = 3) {
    Reading r;
    r.facets = {facet};
    r.value = value;
    r.sigma = sigma;
    return r;
}

// 10 with sigma 1 and 13 with sigma 2: weights 1 and 1/4, mean 10.6, variance 0.8, and a remaining
// sum of squares of 0.36 + 2.4^2 / 4 = 1.8.
TEST(Replicates, AreWeightedByTheirSigmas) {
    const std::vector<Reading> readings{inclination(10, 1), inclination(13, 2)};
    const Replicates both = merged(readings, {0, 1}, 1);
    EXPECT_NEAR(both.value, 10.6, 1e-14);
    EXPECT_NEAR(both.sigma, std::sqrt(0.8), 1e-15);
    EXPECT_NEAR(both.scatter, 1.8, 1e-14);
    EXPECT_NEAR(both.all[0].off, -0.6, 1e-14);
    EXPECT_NEAR(both.all[1].off, 2.4, 1e-14);
}

TEST(Replicates, OfAnAzimuthMeetAcrossZero) {
    std::vector<Reading> readings{inclination(radians(359.0), 1), inclination(radians(3.0), 1)};
    for (Reading& r : readings) r.kind = ReadingKind::azimuth;
    const Replicates both = merged(readings, {0, 1}, 1);
    EXPECT_NEAR(std::remainder(both.value - radians(1.0), 2 * std::numbers::pi), 0, 1e-14);
    EXPECT_NEAR(both.all[0].off, -radians(2.0), 1e-14);
}

TEST(Replicates, AreOfOneQuantityOnly) {
    std::vector<Reading> readings{inclination(0.6, 1), inclination(0.6, 1, 4), inclination(0.61, 1),
                                  inclination(0, 1), inclination(0.6, 1)};
    readings[4].exact = true;
    readings.push_back(inclination(0.6, 1));
    readings.back().datum = {Datum::Kind::facet, 1};
    Reading width;
    width.kind = ReadingKind::width;
    width.sigma = 1;
    width.azimuth = 0.3;
    readings.push_back(width);
    width.azimuth = 0.4;
    readings.push_back(width);
    width.azimuth = 0.3;
    readings.push_back(width);
    const std::vector<std::vector<int>> expected{{0, 2}, {6, 8}};
    EXPECT_EQ(repeated_readings(readings), expected);
}

class RepeatedReadings : public ::testing::TestWithParam<int> {
protected:
    // One to four of each, with sigmas from half to twice as large, some rounded, and azimuths.
    std::vector<WrittenReading> repeated(const Truth& truth, unsigned seed) const {
        std::mt19937 random(seed);
        std::vector<WrittenReading> all;
        std::vector<WrittenReading> once = read_perfectly(truth);
        const std::vector<Facet>& facets = truth.stone.solid.facets;
        for (std::size_t f = 1; f < facets.size(); f += 5) {
            const Vec3& n = facets[f].plane.normal;
            if (std::hypot(n.x, n.y) < 0.1) continue;
            WrittenReading azimuth;
            azimuth.kind = "azimuth";
            azimuth.of = {facets[f].name};
            azimuth.value = degrees(std::atan2(n.y, n.x)) + (n.y < 0 ? 360 : 0);
            azimuth.sigma = 0.2;
            once.push_back(azimuth);
        }
        for (const WrittenReading& reading : once) {
            const int count = reading.value ? 1 + int(random() % 4) : 1;
            for (int k = 0; k < count; ++k) {
                WrittenReading r = reading;
                r.id = "m" + std::to_string(all.size());
                if (r.value && r.sigma) {
                    r.sigma = *r.sigma * std::exp2(double(random() % 201) / 100 - 1);
                    r.value = *r.value + *r.sigma * std::normal_distribution<>()(random);
                    // A protractor shows the supplement for a facet that leans a little the other
                    // way.
                    if (r.kind == "inclination" && *r.value > 90) r.value = 180 - *r.value;
                    if (r.kind == "azimuth" && *r.value > 360) r.value = *r.value - 360;
                    if (random() % 4 == 0) r.rounding = 0.5 * *r.sigma;
                }
                all.push_back(std::move(r));
            }
        }
        return all;
    }
};

void expect_same(const Diagnosis& one, const Diagnosis& other) {
    EXPECT_NEAR(one.chi2, other.chi2, 1e-9 * other.chi2);
    EXPECT_NEAR(one.dof, other.dof, 1e-9 * other.dof);
    EXPECT_EQ(one.suspect_limit, other.suspect_limit);
    EXPECT_EQ(one.suspects, other.suspects);
    EXPECT_EQ(one.disagreeing, other.disagreeing);
    EXPECT_EQ(one.rank_defect, other.rank_defect);
    ASSERT_EQ(one.readings.size(), other.readings.size());
    for (std::size_t i = 0; i < one.readings.size(); ++i) {
        const ReadingCheck &a = one.readings[i], &b = other.readings[i];
        EXPECT_NEAR(a.residual, b.residual, 1e-10) << i;
        EXPECT_NEAR(a.normalized, b.normalized, 1e-6 * (1 + std::abs(b.normalized))) << i;
        EXPECT_NEAR(a.redundancy, b.redundancy, 1e-9) << i;
        EXPECT_NEAR(a.detectable, b.detectable, 1e-6 * b.detectable) << i;
        EXPECT_EQ(a.suspect, b.suspect) << i;
    }
    ASSERT_EQ(one.facets.size(), other.facets.size());
    for (std::size_t f = 0; f < one.facets.size(); ++f) {
        EXPECT_NEAR(one.facets[f].inclination, other.facets[f].inclination, 1e-9) << f;
        EXPECT_NEAR(one.facets[f].offset, other.facets[f].offset, 1e-9) << f;
    }
    ASSERT_EQ(one.suspicions.size(), other.suspicions.size());
    for (std::size_t i = 0; i < one.suspicions.size(); ++i) {
        const Suspicion &a = one.suspicions[i], &b = other.suspicions[i];
        EXPECT_EQ(a.reading, b.reading);
        EXPECT_EQ(a.alternatives, b.alternatives);
        EXPECT_NEAR(a.estimate, b.estimate, 1e-8);
        EXPECT_NEAR(a.sigma, b.sigma, 1e-8);
    }
}

TEST_P(RepeatedReadings, SayTheSameTogetherAndApart) {
    const int seed = GetParam();
    const Truth truth = make_truth(TruthKind(seed % 4), seed % 3 == 0, unsigned(seed));
    std::vector<WrittenReading> written = repeated(truth, unsigned(100 + seed));
    const bool is_wrong = seed % 2 == 1;
    if (is_wrong) {
        for (std::size_t i = written.size() / 3;; ++i) {
            if (!written[i].value) continue;
            written[i].value = *written[i].value - 15 * *written[i].sigma;
            break;
        }
    }
    const std::vector<Reading> readings = bind_readings(written, truth.stone);
    const FitOptions options;
    const FitModel together(truth.stone, readings, options);
    ASSERT_TRUE(!together.replicated().empty());
    FitModel apart = together;
    apart.keep_replicates_apart();
    const Candidate one = finish_from(together, together.mesh_shape(), options.iterations);
    const Candidate other = finish_from(apart, apart.mesh_shape(), options.iterations);
    ASSERT_TRUE(one.finished.converged && other.finished.converged);
    EXPECT_LT(all_equations(together, one.finished.shape, one.finished.outline).size(),
              all_equations(apart, one.finished.shape, one.finished.outline).size());
    EXPECT_NEAR(one.finished.chi2, other.finished.chi2, 1e-5);
    for (std::size_t f = 0; f < one.finished.shape.normals.size(); ++f) {
        EXPECT_LT(glm::length(one.finished.shape.normals[f] - other.finished.shape.normals[f]),
                  1e-5)
            << f;
    }
    const Diagnosis of_one = diagnose(together, one.finished.shape, one.finished.outline);
    expect_same(of_one, diagnose(apart, one.finished.shape, one.finished.outline));
    EXPECT_EQ(of_one.suspects.empty(), !is_wrong);
    // The same number of readings counts in the chi-square test.
    const Parameters parameters = together.parameters();
    EXPECT_EQ(Relaxation(together, parameters).counts().soft,
              Relaxation(apart, parameters).counts().soft);
}

INSTANTIATE_TEST_SUITE_P(Stones, RepeatedReadings, ::testing::Range(1, 9));

}  // namespace
}  // namespace culet
