#include "page/grade_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "page/grade_section.h"
#include "stone/text/errors.h"
#include "tests/page/kept_pages.h"

namespace culet {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

const char* const k_section =
    R"({"azimuth_deg": 22.5, "outline": [[-1, 0], [1, 0], [0, 1]],
        "paths": [{"points": [[0, 2], [0, 1], [0.5, 0]], "end": "leak"}]})";

GradeDesign design(const std::string& name) {
    return {R"({"schema": 1, "name": )" + nlohmann::json(name).dump() +
                R"(, "file": "a.toml", "index": 2.417, "head_deg": 10, "crystal": "merged",
            "face_up": {"iso": {"whole": 70.123, "table": null}},
            "models": [{"name": "iso", "tilt_deg": [-10, 0, 10], "tilt_azimuth_deg": 0,
                        "whole": [60, 70, 60], "table": [1, 2, 3]}],
            "balance": {"return": 0.6}, "hearts": {"count": 8, "evenness": 0.98},
            "arrows": {"count": 7}, "sigma": {"iso": 0.46},
            "costs": [{"facet": "P3<b>", "cost": 1.84, "off_deg": -0.31}], "notes": []})",
            k_section,
            {{"aset", "colours by elevation", "data:image/png;base64,AAAA"}},
            {}};
}

TEST(GradePage, ShowsFiguresWithTheirSigmasCostsAndNotes) {
    const std::string page = grade_page({{design("Mine")}, "0.2", "culet grade mine.asc", {}});
    EXPECT_THAT(page, HasSubstr("70.12 ± 0.46\u00a0%"));
    EXPECT_THAT(page, HasSubstr("60.00\u00a0%"));
    EXPECT_THAT(page, testing::AllOf(HasSubstr("8 of 8 hearts"), HasSubstr("7 of 8 arrows")));
    EXPECT_THAT(page, HasSubstr("P3&lt;b&gt;"));
    EXPECT_THAT(page, Not(HasSubstr("P3<b>\"")));
    EXPECT_THAT(page, HasSubstr("1.84"));
    EXPECT_THAT(page, HasSubstr("data:image/png;base64,AAAA"));
    EXPECT_THAT(page, HasSubstr("Tilted about x"));
    EXPECT_THAT(page, HasSubstr("its two waves go one way"));
}

TEST(GradePage, SetsDesignsSideBySide) {
    GradeDesign yours = design("Yours");
    yours.json.replace(yours.json.find("a.toml"), 6, "b.toml");
    const std::string page = grade_page({{design("Mine"), yours}, "0.2", "culet grade", {}});
    EXPECT_THAT(page, HasSubstr("2 designs"));
    EXPECT_THAT(page, HasSubstr(">Mine</bdi>"));
    EXPECT_THAT(page, HasSubstr(">Yours</bdi>"));
    EXPECT_THAT(page, HasSubstr("iso, about x and (dashed) y"));
}

TEST(GradePage, CallsAStoneAndItsDrawingByTheStonesName) {
    const std::string page =
        grade_page({{design("Mine"), design("Mine (as drawn)")}, "0.2", "culet grade", {}});
    EXPECT_THAT(page, HasSubstr("<h1>Mine</h1>"));
}

TEST(GradePage, CountsOfEightOnlyWhatAStandardBrilliantHas) {
    EXPECT_EQ(counted_of_eight(7, "heart"), "7 of 8 hearts");
    EXPECT_EQ(counted_of_eight(12, "heart"), "12 hearts");
    // A single heart is perfectly even.
    GradeDesign one = design("Mine");
    one.json.replace(one.json.find("{\"count\": 8"), 11, "{\"count\": 1");
    EXPECT_THAT(grade_page({{one}, "0.2", "", {}}), Not(HasSubstr("98.0")));
    EXPECT_THAT(grade_page({{design("Mine")}, "0.2", "", {}}), HasSubstr("98.0"));
}

TEST(GradePage, SaysWhatWasOptimised) {
    const char* const optimized = R"({"objective": "brilliance=2,tilt=1", "model": "cos",
        "merit": {"start": {"total": 48.21, "brilliance": 40.5, "tilt": 63.6},
                  "two_factors": {"total": 49}, "better": {"total": 50.13, "brilliance": 43.1}},
        "found": true, "recut": false, "volume_ratio": 0.968,
        "table_percent": {"start": 55, "better": 56.2},
        "tiers": [{"name": "", "part": "pavilion", "facets": ["P1<b>", "P2"], "from_deg": 43,
                   "to_deg": 41.5}]})";
    const std::string page = grade_page(
        {{design(test::hostile_name()), design("better")}, "0.2", "culet optimize", optimized});
    for (const char* said :
         {"brilliance=2,tilt=1", "48.21", "50.13", "43.10", "P1&lt;b&gt;", "43.00", "41.50",
          "−1.50", "−3.20 %", "55.0 to 56.2 %", "better: before and after"})
        EXPECT_THAT(page, HasSubstr(said));
    test::keep_page("grade", page);
}

TEST(GradePage, DrawsLightPathsByHowTheyEnd) {
    const std::string drawing = section_drawing(k_section);
    EXPECT_THAT(drawing, HasSubstr("class=\"path-leak\""));
    EXPECT_THAT(drawing, HasSubstr("azimuth 22.5"));
    // 2 wide and 2 high, 640 across, with a margin of 4 on every side.
    EXPECT_THAT(drawing, HasSubstr("viewBox=\"-4 -4 648 648\""));
    EXPECT_EQ(section_drawing("{}"), "");
    EXPECT_THROW(section_drawing("[]"), InputError);
    EXPECT_THROW(grade_page({{{"[]", "{}", {}, {}}}, "0.2", "", {}}), InputError);
}

}  // namespace
}  // namespace culet
