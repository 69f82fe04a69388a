#include "page/grade_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "page/grade_section.h"
#include "stone/errors.h"

namespace culet {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

const char* const k_section =
    R"({"azimuth_deg": 22.5, "outline": [[-1, 0], [1, 0], [0, 1]],
        "paths": [{"points": [[0, 2], [0, 1], [0.5, 0]], "end": "leak"}]})";

GradeDesign design(const std::string& name) {
    return {R"({"schema": 1, "name": ")" + name +
                R"(", "index": 2.417, "head_deg": 10, "crystal": "merged",
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
    const std::string page = grade_page({{design("Mine")}, "0.2", "culet grade mine.asc"});
    EXPECT_THAT(page, HasSubstr("70.12 ± 0.46 %"));
    EXPECT_THAT(page, HasSubstr("60.00 %"));
    EXPECT_THAT(page, testing::AllOf(HasSubstr("8 of 8 hearts"), HasSubstr("7 of 8 arrows")));
    EXPECT_THAT(page, HasSubstr("P3&lt;b&gt;"));
    EXPECT_THAT(page, Not(HasSubstr("P3<b>\"")));
    EXPECT_THAT(page, HasSubstr("1.84"));
    EXPECT_THAT(page, HasSubstr("data:image/png;base64,AAAA"));
    EXPECT_THAT(page, HasSubstr("Tilted about x"));
    EXPECT_THAT(page, HasSubstr("its two waves go one way"));
}

TEST(GradePage, SetsDesignsSideBySide) {
    const std::string page = grade_page({{design("Mine"), design("Yours")}, "0.2", "culet grade"});
    EXPECT_THAT(page, HasSubstr("2 designs"));
    EXPECT_THAT(page, HasSubstr(">Mine</th>"));
    EXPECT_THAT(page, HasSubstr(">Yours</th>"));
    EXPECT_THAT(page, HasSubstr("iso, about x and (dashed) y"));
}

TEST(GradePage, DrawsLightPathsByHowTheyEnd) {
    const std::string drawing = section_drawing(k_section);
    EXPECT_THAT(drawing, HasSubstr("class=\"path-leak\""));
    EXPECT_THAT(drawing, HasSubstr("azimuth 22.5"));
    EXPECT_EQ(section_drawing("{}"), "");
    EXPECT_THROW(section_drawing("[]"), InputError);
    EXPECT_THROW(grade_page({{{"[]", "{}", {}, {}}}, "0.2", ""}), InputError);
}

}  // namespace
}  // namespace culet
