#include <gtest/gtest.h>

#include "compare/calibration/several.h"
#include "compare/report/report.h"
#include "compare/report/scores_json.h"
#include "compare/report/several_page.h"

namespace culet {
namespace {

const std::string k_hostile = "<script>alert(1)</script>\"'&";

Comparison small_comparison() {
    Comparison comparison;
    comparison.verdict = Verdict::match;
    comparison.pictures.photo.width = comparison.pictures.photo.height = 8;
    comparison.pictures.photo.rgb.assign(3 * 64, 0.5f);
    comparison.pictures.render = comparison.pictures.photo;
    Score score;
    score.key = "zncc";
    score.value = 0.97;
    score.null = {0.1, 0.2, 0.3};
    comparison.scores = {score};
    comparison.reflexes.in_photo = 2;
    comparison.reflexes.in_render = 1;
    comparison.reflexes.matched = 1;
    comparison.reflexes.displacement = 0.004;
    comparison.reflexes.marks = {
        {{2, 2}, 1, true, 0}, {{5, 5}, 1, true, -1}, {{2.5, 2}, 1, false, 0}};
    return comparison;
}

CalibratedVerdict calibrated_as_match() {
    Calibration calibration;
    calibration.keys = {"zncc"};
    calibration.notes = {k_hostile};
    calibration.draws.push_back({Alternative::light, "", 0, {0.2}});
    CalibratedVerdict verdict;
    verdict.calibration = calibration;
    verdict.headline =
        "The photograph agrees with this stone: as well as with facets off by 0.2 degrees";
    verdict.equivalent.deg = 0.2;
    verdict.equivalent.low_deg = 0.15;
    verdict.equivalent.high_deg = 0.3;
    SensitivityCurve curve;
    curve.key = "zncc";
    curve.levels = {{0, 4, 0.99, 0.01, 0.99}, {0.1, 8, 0.97, 0.01, 0.97}, {1, 8, 0.7, 0.1, 0.7}};
    curve.value = 0.97;
    curve.equivalent_deg = 0.1;
    curve.weight = 1;
    verdict.curves = {curve};
    NullStatistics null;
    null.draws = 24;
    verdict.nulls = {null};
    verdict.hypotheses = {{Alternative::material, k_hostile, 0.9, verdict.equivalent}};
    return verdict;
}

TEST(CalibrationReport, HasSentenceCurvesChanceAndHypotheses) {
    Report report;
    report.comparison = small_comparison();
    report.calibrated = calibrated_as_match();
    const std::string page = report_page(report);
    for (const char* part : {"id=\"meaning\"", "with facets off by 0.2 degrees.", "class=\"curve\"",
                             "Another light", "What else it could be", "id=\"reflexes\"",
                             "1 of 2 reflexes found, 0.4 % of the diameter", "class=\"blink\""}) {
        EXPECT_NE(page.find(part), std::string::npos) << part;
    }
    EXPECT_EQ(page.find(k_hostile), std::string::npos);
    EXPECT_EQ(page.find("<script>alert"), std::string::npos);
}

TEST(CalibrationReport, SaysThatAPhotographIsForGeometryOnly) {
    Report report;
    report.comparison = small_comparison();
    report.comparison->geometry_only = true;
    EXPECT_NE(report_page(report).find("cannot serve for photometry"), std::string::npos);
}

TEST(SeveralPage, LinksEachPhotographsPageAndEscapesNames) {
    PhotographRow row;
    row.name = k_hostile;
    row.page = "photograph-1.html";
    row.comparison = small_comparison();
    row.calibrated = calibrated_as_match();
    row.scores_json = scores_json(row.comparison, {}, row.calibrated);
    const std::vector<PhotographRow> rows{row, row, row};
    const SeveralPhotographs several = together(rows);
    const std::string page = several_page(several, rows, k_hostile, "1", k_hostile);
    EXPECT_NE(page.find("href=\"photograph-1.html\""), std::string::npos);
    EXPECT_EQ(page.find("<script>alert"), std::string::npos);
    EXPECT_NE(several_json(several, rows).find("\"leave_one_out\""), std::string::npos);
}

}  // namespace
}  // namespace culet
