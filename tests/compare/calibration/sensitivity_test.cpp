#include "compare/calibration/sensitivity.h"
#include "compare/calibration/level_curve.h"

#include <gtest/gtest.h>

#include <cmath>

#include "compare/calibration/calibrated_verdict.h"
#include "compare/calibration/several.h"
#include "compare/scores/chance.h"

namespace culet {
namespace {

// Scores that fall with the facet error by a known law and scatter slightly: "zncc" mostly at large
// errors, "psnr" everywhere, "cw_ssim" hardly.
std::vector<std::optional<double>> scores_near(double deg, Chance& chance, double scatter = 0.1) {
    const double noisy = std::max(deg, 0.01) * std::exp(scatter * chance.normal());
    return {1 / (1 + 0.5 * noisy), 30 - 6 * std::log10(noisy),
            0.9 - 0.02 * noisy + 0.01 * chance.normal()};
}

Calibration synthetic_calibration(int draws = 8) {
    Calibration calibration;
    calibration.keys = {"zncc", "psnr", "cw_ssim"};
    Chance chance(11);
    std::vector<double> levels = facet_errors_deg();
    levels.push_back(0);
    for (const double deg : levels) {
        for (int k = 0; k < draws; ++k) {
            calibration.draws.push_back(
                {Alternative::facet_error, "", deg, scores_near(deg, chance)});
        }
    }
    for (const Alternative alternative :
         {Alternative::light, Alternative::pose, Alternative::both}) {
        for (int k = 0; k < 24; ++k) {
            calibration.draws.push_back(
                {alternative, "", 0, {0.2 + 0.1 * chance.normal(), 14 + chance.normal(), 0.4}});
        }
    }
    return calibration;
}

std::vector<Score> scores_of(const std::vector<std::optional<double>>& values) {
    const Calibration calibration = synthetic_calibration(1);
    std::vector<Score> scores;
    for (std::size_t k = 0; k < values.size(); ++k) {
        Score score;
        score.key = calibration.keys[k];
        score.value = values[k];
        score.is_correlation = k == 0;
        scores.push_back(score);
    }
    return scores;
}

// Barlow et al. (1972), by hand: 3 and 2 pool to 2.5, then 6, 5 and 4 to 5.
TEST(Monotone, PoolsWhatRunsTheWrongWay) {
    EXPECT_EQ(monotone({1, 3, 2, 6, 5, 4, 9}), (std::vector<double>{1, 2.5, 2.5, 5, 5, 5, 9}));
    EXPECT_EQ(monotone({3, 2, 1}), (std::vector<double>{2, 2, 2}));
    EXPECT_TRUE(monotone({}).empty());
}

// The scores scatter by 10 % of the error; curves from 8 draws add 4 %.
TEST(FacetErrorScale, FindsTheErrorThatMadeTheScores) {
    const Calibration calibration = synthetic_calibration();
    const FacetErrorScale scale(calibration, calibration.keys);
    ASSERT_TRUE(scale.usable());
    Chance chance(12);
    int inside = 0, all = 0;
    for (const double deg : {0.05, 0.08, 0.15, 0.3, 0.7, 1.0}) {
        for (int k = 0; k < 10; ++k) {
            const EquivalentError found = scale.of(scores_near(deg, chance));
            ASSERT_TRUE(found.deg.has_value());
            EXPECT_LT(std::abs(std::log(*found.deg / deg)), std::log(1.5)) << deg;
            inside += found.low_deg <= deg && deg <= found.high_deg ? 1 : 0;
            ++all;
        }
    }
    // 95 % intervals: at least 48 of 60, which is six binomial standard deviations below.
    EXPECT_GE(inside, 48) << "of " << all;
}

TEST(FacetErrorScale, SaysWhenItIsAtItsEnds) {
    const Calibration calibration = synthetic_calibration();
    const FacetErrorScale scale(calibration, calibration.keys);
    const EquivalentError perfect = scale.of({1.0, 60.0, 0.99}),
                          hopeless = scale.of({0.0, 5.0, 0.0});
    EXPECT_TRUE(perfect.at_most);
    EXPECT_EQ(perfect.low_deg, 0);
    EXPECT_NEAR(*perfect.deg, 0.02, 1e-9);
    EXPECT_TRUE(hopeless.at_least);
    EXPECT_NEAR(*hopeless.deg, 2, 1e-9);
    EXPECT_FALSE(scale.of({std::nullopt, std::nullopt, std::nullopt}).deg.has_value());
}

TEST(FacetErrorScale, TrustsTheScoreThatScattersLess) {
    const Calibration calibration = synthetic_calibration();
    const FacetErrorScale scale(calibration, calibration.keys);
    Chance chance(13);
    const auto curves = scale.curves(scores_near(0.1, chance));
    double psnr = 0, cw_ssim = 0, sum = 0;
    for (const SensitivityCurve& curve : curves) {
        sum += curve.weight;
        if (curve.key == "psnr") psnr = curve.weight;
        if (curve.key == "cw_ssim") cw_ssim = curve.weight;
    }
    EXPECT_NEAR(sum, 1, 1e-12);
    EXPECT_GT(psnr, 4 * cw_ssim);
}

TEST(FacetErrorScale, OfTooFewLevelsIsNotUsable) {
    Calibration calibration = synthetic_calibration();
    std::erase_if(calibration.draws,
                  [](const CalibrationDraw& d) { return d.facet_error_deg > 0.03; });
    const FacetErrorScale scale(calibration, calibration.keys);
    EXPECT_FALSE(scale.usable());
    EXPECT_FALSE(scale.of({0.9, 30.0, 0.9}).deg.has_value());
}

TEST(CalibratedVerdict, OfARightStoneIsAMatchAndItsSentenceSaysSo) {
    Chance chance(14);
    const CalibratedVerdict verdict =
        calibrated_verdict(scores_of(scores_near(0.2, chance)), synthetic_calibration());
    EXPECT_EQ(verdict.verdict, Verdict::match);
    EXPECT_TRUE(verdict.headline.starts_with(
        "The photograph agrees with this stone: as well as with facets off by 0."))
        << verdict.headline;
    EXPECT_TRUE(verdict.headline.find("; 0 of 24 wrong ") != std::string::npos) << verdict.headline;
    ASSERT_EQ(verdict.nulls.size(), 3u);
    EXPECT_EQ(verdict.nulls[0].as_good, 0);
    EXPECT_NEAR(verdict.nulls[0].p, 1.0 / 25, 1e-12);
    EXPECT_LE(verdict.nulls[0].z, verdict.nulls[1].z);
}

TEST(CalibratedVerdict, OfChanceIsNoEvidence) {
    const CalibratedVerdict verdict =
        calibrated_verdict(scores_of({0.25, 14.5, 0.4}), synthetic_calibration());
    EXPECT_EQ(verdict.verdict, Verdict::no_evidence);
    EXPECT_GT(verdict.nulls[0].as_good, 0);
}

TEST(CalibratedVerdict, GrowsLessWithTheError) {
    const Calibration calibration = synthetic_calibration();
    double before = 1e9;
    for (const double deg : {0.03, 0.1, 0.3, 0.9}) {
        Chance chance(15);
        const double evidence =
            calibrated_verdict(scores_of(scores_near(deg, chance, 0)), calibration).evidence;
        EXPECT_LT(evidence, before);
        before = evidence;
    }
}

TEST(CalibratedVerdict, WithoutDrawsIsNoEvidence) {
    Calibration empty;
    empty.keys = {"zncc"};
    const CalibratedVerdict verdict = calibrated_verdict(scores_of({0.9, 30.0, 0.9}), empty);
    EXPECT_EQ(verdict.verdict, Verdict::no_evidence);
    EXPECT_FALSE(verdict.equivalent.deg.has_value());
}

TEST(CalibrationJson, ComesBackAsItWas) {
    Calibration calibration = synthetic_calibration(2);
    calibration.hash = "abc";
    calibration.notes = {"a note"};
    calibration.draws[3].scores[1] = std::nullopt;
    const auto back = calibration_from(calibration_json(calibration));
    ASSERT_TRUE(back.has_value());
    EXPECT_EQ(calibration_json(*back), calibration_json(calibration));
    EXPECT_EQ(back->draws[3].scores[1], std::nullopt);
}

TEST(CalibrationJson, OfRubbishIsNothing) {
    const std::string good = calibration_json(synthetic_calibration(1));
    for (const std::string& text :
         {std::string(), std::string("[]"), std::string("{\"schema\":1}"), good.substr(0, 200),
          std::string("{\"schema\":1,\"kind\":\"calibration\",\"keys\":3}")}) {
        EXPECT_FALSE(calibration_from(text).has_value());
    }
    std::string other = good;
    other.replace(other.find("\"light\""), 7, "\"night\"");
    EXPECT_FALSE(calibration_from(other).has_value());
}

PhotographRow row_with(double deg, Verdict verdict) {
    PhotographRow row;
    row.comparison.verdict = verdict;
    CalibratedVerdict calibrated;
    calibrated.equivalent.deg = deg;
    calibrated.equivalent.low_deg = deg / 1.2;
    calibrated.equivalent.high_deg = deg * 1.2;
    row.calibrated = calibrated;
    row.name = std::to_string(deg);
    row.scores_json = "{}";
    return row;
}

// Equal weights give the geometric mean. 0.1, 0.1 and 0.8 give 0.2 together; without the last 0.1.
TEST(SeveralPhotographs, AreAveragedAndLeftOutOneByOne) {
    const std::vector<PhotographRow> rows{row_with(0.1, Verdict::match),
                                          row_with(0.1, Verdict::match),
                                          row_with(0.8, Verdict::partial)};
    const SeveralPhotographs several = together(rows);
    EXPECT_NEAR(*several.together.deg, 0.2, 1e-12);
    EXPECT_NEAR(*several.without[2].deg, 0.1, 1e-12);
    EXPECT_NEAR(*several.without[0].deg, std::sqrt(0.08), 1e-12);
    EXPECT_NEAR(several.largest_change, 2, 1e-12);
    EXPECT_EQ(several.verdict, Verdict::match);
    // They disagree by more than their intervals: the common interval is wider than either.
    EXPECT_GT(several.together.high_deg / *several.together.deg, 1.2);
}

TEST(SeveralPhotographs, OfWhichNoneCouldBeComparedAreRefused) {
    PhotographRow refused;
    refused.comparison.verdict = Verdict::refused;
    const SeveralPhotographs several = together({refused, refused});
    EXPECT_EQ(several.verdict, Verdict::refused);
    EXPECT_FALSE(several.together.deg.has_value());
    EXPECT_EQ(together({row_with(0.1, Verdict::match), row_with(1, Verdict::partial)}).verdict,
              Verdict::partial);
}

}  // namespace
}  // namespace culet
