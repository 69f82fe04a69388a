#include "page/study_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "stone/text/errors.h"
#include "tests/page/kept_pages.h"
#include "tests/page/xml.h"

namespace culet {
namespace {

using test::xml_fault;
using ::testing::HasSubstr;
using ::testing::Not;

nlohmann::json study() {
    return nlohmann::json::parse(R"({"schema": 1, "kind": "fit", "name": "Stone & <co>",
        "status": "converged", "message": "chi2 3", "unit": "mm", "facets": 7, "readings": 9,
        "options": {"seed": 1, "draws": 2},
        "settings": [
          {"sweep": "iterations", "setting": "1", "as_asked": false, "fits": 2, "sound": 1,
           "settled": 0, "best": 0, "angle_error": 0.5, "offset_error": 0.01, "seconds": 0.001,
           "seconds_low": 0.0009, "seconds_high": 0.0011},
          {"sweep": "iterations", "setting": "100", "as_asked": true, "fits": 2, "sound": 2,
           "settled": 2, "best": 2, "angle_error": 0.05, "offset_error": 0.001, "seconds": 0.01,
           "seconds_low": 0.009, "seconds_high": 0.011},
          {"sweep": "meets", "setting": "released", "fits": 2, "sound": 0, "settled": 0,
           "best": null, "angle_error": null, "offset_error": null, "seconds": 0.02}],
        "limits": [
          {"readings": 9, "share": 1, "dof": 3, "draws": 2, "failed": 0, "angle_error": 0.05,
           "angle_limit": 0.049, "ratio": 1.02, "ratio_sigma": 0.05, "offset_error": 0.001,
           "offset_limit": 0.001}],
        "limit_made_exact": true, "limit_message": "fewer than 6 readings", "left_out": ["x 1"]})");
}

TEST(StudyPage, ShowsTablesAndCharts) {
    const std::string page = study_page({study().dump(), "", "1.2", "culet study s"});
    test::keep_page("study", study_page({study().dump(), test::hostile_name(), "1.2",
                                         "culet study " + test::hostile_name()}));
    EXPECT_THAT(page, HasSubstr("<h1>Stone &amp; &lt;co&gt;</h1>"));
    EXPECT_THAT(page, HasSubstr("<section id=\"time\""));
    EXPECT_THAT(page, HasSubstr("<section id=\"limit\""));
    EXPECT_THAT(page, HasSubstr("1.020 <small>± 0.050"));
    EXPECT_THAT(page, HasSubstr("x 1."));
    EXPECT_THAT(page, HasSubstr("culet study s"));
    EXPECT_EQ(xml_fault(study_time_chart(study().dump())), "");
    EXPECT_EQ(xml_fault(study_limit_chart(study().dump())), "");
}

TEST(StudyPage, WritesAPlainTable) {
    const std::string text = study_table(study().dump());
    EXPECT_THAT(text, HasSubstr("most steps  100 *            2/2      2/2    2/2"));
    EXPECT_THAT(text, HasSubstr("1.020"));
    for (const char c : text) EXPECT_GT(c, 0) << text;  // ASCII only
}

TEST(StudyPage, OfAnEmptyStudySaysWhy) {
    const std::string page = study_page({R"({"status": "not_converged", "message": "no stone",
                        "limit_message": "there is no fitted stone to study"})"});
    EXPECT_THAT(page, HasSubstr("not converged"));
    EXPECT_THAT(page, HasSubstr("there is no fitted stone to study"));
    EXPECT_THAT(page, Not(HasSubstr("<section id=\"time\"")));
    EXPECT_EQ(study_table("{}"), "");
    EXPECT_EQ(study_time_chart("{}"), "");
}

TEST(StudyPage, SurvivesJsonOfUnexpectedShape) {
    const char* odd = R"({"settings": [1, {"sweep": 3, "seconds": "x"}, null], "limits": [[]],
                          "options": [1], "left_out": {"a": 1}, "unit": 4, "name": []})";
    EXPECT_NO_THROW(study_page({odd}));
    EXPECT_NO_THROW(study_table(odd));
    EXPECT_THROW(study_page({"{"}), InputError);
}

}  // namespace
}  // namespace culet
