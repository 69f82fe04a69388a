#include "page/cutting_sheet.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "stone/cuts/cuts.h"
#include "tests/page/kept_pages.h"

namespace culet {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

CuttingSheet brilliant() {
    CuttingSheet sheet;
    sheet.name = "<b>brilliant</b>";
    sheet.solid = make_cut("round-brilliant");
    sheet.steps = cutting_list(sheet.solid);
    sheet.design = cutting_design(sheet.solid);
    sheet.unit = "mm";
    return sheet;
}

const CuttingStep& step_called(const CuttingSheet& sheet, const std::string& tier) {
    for (const CuttingStep& step : sheet.steps) {
        if (step.tier == tier) return step;
    }
    throw std::runtime_error("no tier " + tier);
}

TEST(CuttingSheet, TellsWhatEachTierOfABrilliantIsCutTo) {
    // As textbooks cut a standard brilliant: halves to a point, mains from it, the girdle where
    // both meet, upper halves to the girdle's width; then everything follows from meets. The mains
    // meet each other on the halves' edges at any depth, which is not a stop, so their depth is a
    // length. Depths by the cut's proportions: a diameter of 6.5 mm, a pavilion main at 40.75
    // degrees from the girdle's edge to the middle, a girdle of 3 % (docs of culet cut).
    const CuttingSheet sheet = brilliant();
    const auto words = [&](const char* tier) {
        return depth_words(step_called(sheet, tier), sheet.unit, 6.5);
    };
    EXPECT_THAT(words("L"), HasSubstr("centre point"));
    EXPECT_THAT(words("P"), HasSubstr("centre point 2.8"));
    EXPECT_EQ(words("G"), "meet L, P");
    EXPECT_THAT(words("U"), ::testing::MatchesRegex("leave 0\\.[0-9]+ mm of G"));
    EXPECT_EQ(words("C"), "meet G, U");
    EXPECT_EQ(words("S"), "meet U, C");
    EXPECT_EQ(words("T"), "meet C, S");
    std::vector<std::string> order;
    for (const CuttingStep& step : sheet.steps) order.push_back(step.tier);
    EXPECT_EQ(order, (std::vector<std::string>{"L", "P", "G", "U", "C", "S", "T"}));
}

TEST(CuttingSheet, OfADesignWithoutMeetsIsCutToSize) {
    CuttingSheet sheet = brilliant();
    // A box: each pair of facets is free.
    std::vector<NamedPlane> planes;
    for (int k = 0; k < 3; ++k) {
        for (const double side : {-1.0, 1.0}) {
            Vec3 normal{0};
            normal[k] = side;
            planes.push_back({std::string(1, static_cast<char>('a' + k)), {normal, 1}});
        }
    }
    sheet.solid = intersect_half_spaces(planes).solid;
    for (const CuttingStep& step : cutting_list(sheet.solid))
        EXPECT_NE(step.depth.to, CutDepth::To::meet) << step.tier;
    EXPECT_DOUBLE_EQ(least_girdle(sheet.solid), 2);
}

TEST(CuttingSheet, PageAndTextSayTheSame) {
    CuttingSheet sheet = brilliant();
    sheet.sigmas_deg.assign(sheet.steps.size(), 0.12);
    sheet.sigmas_deg.front() = 0.034;  // a machine is read to a hundredth of a degree
    const std::string page = cutting_sheet_page(sheet), text = cutting_sheet_text(sheet);
    EXPECT_THAT(page, Not(HasSubstr("<b>brilliant</b>")));
    EXPECT_THAT(page, HasSubstr("<svg"));
    EXPECT_THAT(page, HasSubstr("34.50 ± 0.12"));
    EXPECT_THAT(text, HasSubstr("34.50 +- 0.12"));
    EXPECT_THAT(page, HasSubstr(" ± 0.03"));
    EXPECT_THAT(page, Not(HasSubstr("± 0.034")));
    EXPECT_THAT(page, ::testing::ContainsRegex("Pavilion</th>.*Crown</th>"));
    test::keep_page("cutting-sheet-on-paper", page);
    sheet.name = test::hostile_name();
    test::keep_page("cutting-sheet", cutting_sheet_page(sheet));
    for (const char* both :
         {"Meet G, U", "96-12-24-36-48", "0.5700", "6.5 mm", "57 + 16 facets", "8-fold"}) {
        EXPECT_THAT(page, HasSubstr(both));
        EXPECT_THAT(text, HasSubstr(both));
    }
}

// GemCad prints two headings, settings from the wheel's last tooth with two digits, and what a tier
// meets; a page of text has 80 columns.
TEST(CuttingSheet, TextIsPrintedAsGemCadDoes) {
    CuttingSheet sheet = brilliant();
    sheet.name = "A name of a design that is longer than a line of text has columns, by many words";
    sheet.sigmas_deg.assign(sheet.steps.size(), 0.12);
    const std::string text = cutting_sheet_text(sheet);
    std::istringstream lines(text);
    std::vector<std::string> all;
    for (std::string line; std::getline(lines, line);) {
        EXPECT_LE(line.size(), 80u) << line;
        EXPECT_TRUE(line.empty() || line.back() != ' ') << line;
        all.push_back(line);
    }
    const auto place = [&](const std::string& line) {
        return std::find(all.begin(), all.end(), line) - all.begin();
    };
    EXPECT_LT(place("PAVILION"), place("CROWN"));
    EXPECT_LT(place("CROWN"), std::ssize(all));
    EXPECT_THAT(text, ::testing::ContainsRegex("\n  3  G [^\n]*90\\.00 [^\n]*Meet L, P\n"));
    EXPECT_EQ(printed_indices(step_called(sheet, "P"), 96), "96-12-24-36-48-60-72-84");
    EXPECT_EQ(printed_indices(step_called(sheet, "T"), 96), "any");
    EXPECT_TRUE(printed_indices(step_called(sheet, "L"), 120).starts_with("003-009"));
}

}  // namespace
}  // namespace culet
