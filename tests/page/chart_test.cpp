#include "page/chart.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <regex>

#include "tests/page/xml.h"

namespace culet {
namespace {

using test::count_of;
using test::xml_fault;
using ::testing::HasSubstr;
using ::testing::Not;

Chart two_points(double x0, double y0, double x1, double y1) {
    Chart chart{"title", "about", "x", "y", true, true, {}};
    chart.series = {{"s", {{x0, y0, "a", "first"}, {x1, y1, "b", "second"}}, true, true, false}};
    return chart;
}

std::vector<std::pair<double, double>> circles(const std::string& svg) {
    std::vector<std::pair<double, double>> found;
    const std::regex circle("<circle cx=\"([-0-9.]+)\" cy=\"([-0-9.]+)\"");
    for (auto it = std::sregex_iterator(svg.begin(), svg.end(), circle);
         it != std::sregex_iterator(); ++it) {
        found.emplace_back(std::stod((*it)[1]), std::stod((*it)[2]));
    }
    return found;
}

// The middle of 1 and 100 on a logarithmic axis is 10.
TEST(Chart, IsLogarithmicWhereAsked) {
    Chart chart = two_points(1, 0.01, 100, 1);
    chart.series[0].points.push_back({10, 0.1, "", ""});
    const auto at = circles(draw_chart_svg(chart));
    ASSERT_EQ(at.size(), 4u);  // and one in the key
    EXPECT_NEAR(at[2].first, 0.5 * (at[0].first + at[1].first), 0.11);
    EXPECT_NEAR(at[2].second, 0.5 * (at[0].second + at[1].second), 0.11);
    EXPECT_LT(at[0].first, at[1].first);
    EXPECT_GT(at[0].second, at[1].second);  // up is more
}

TEST(Chart, SaysWhatItShowsInWords) {
    const std::string svg = draw_chart_svg(two_points(1, 1, 20, 30));
    EXPECT_EQ(xml_fault(svg), "");
    EXPECT_THAT(svg, HasSubstr("<title>title</title>"));
    EXPECT_THAT(svg, HasSubstr("<desc>about</desc>"));
    EXPECT_THAT(svg, HasSubstr("<title>first</title>"));
    EXPECT_THAT(svg, HasSubstr(">a</text>"));
}

TEST(Chart, LeavesOutWhatHasNoPlace) {
    Chart chart = two_points(1, 1, 0, 3);
    chart.series[0].points.push_back({std::nan(""), 1, "c", "third"});
    chart.series[0].points.push_back({1, -1, "d", "fourth"});
    const std::string svg = draw_chart_svg(chart);
    EXPECT_EQ(circles(svg).size(), 2u);
    EXPECT_THAT(svg, Not(HasSubstr("second")));
    EXPECT_EQ(xml_fault(svg), "");
    EXPECT_EQ(draw_chart_svg({}), "");
    EXPECT_EQ(draw_chart_svg(two_points(-1, 1, 1, std::nan(""))), "");
}

// One point, equal points, a narrow and a very wide range: some ticks, not thousands.
TEST(Chart, HasAFewTicksAtAnyRange) {
    for (const auto& [low, high] :
         {std::pair(3.0, 3.0), std::pair(1.0, 1.001), std::pair(98., 212.), std::pair(1e-12, 1e12),
          std::pair(0.12, 0.25)}) {
        for (const bool logarithmic : {true, false}) {
            Chart chart = two_points(low, low, high, high);
            chart.log_x = chart.log_y = logarithmic;
            const std::string svg = draw_chart_svg(chart);
            EXPECT_EQ(xml_fault(svg), "") << low << " " << high;
            const int ticks = count_of(svg, "text-anchor=\"end\"");
            EXPECT_GE(ticks, 2) << low << " " << high << " " << logarithmic;
            EXPECT_LE(ticks, 40) << low << " " << high << " " << logarithmic;
            EXPECT_THAT(svg, Not(HasSubstr("nan")));
        }
    }
}

TEST(Chart, SeriesWithoutANameGoWithTheOneBefore) {
    Chart chart;
    chart.series = {{"exact", {{1, 1, {}, {}}, {2, 2, {}, {}}}, true, false, false},
                    {"", {{1, 2, {}, {}}, {2, 3, {}, {}}}, true, false, true},
                    {"other", {{1, 3, {}, {}}, {2, 4, {}, {}}}, true, false, false}};
    const std::string svg = draw_chart_svg(chart);
    // Its line in the chart has no entry in the key, and the next name gets the next colour.
    EXPECT_EQ(count_of(svg, "stroke-dasharray"), 1u);
    EXPECT_NE(svg.find("#d55e00"), std::string::npos);
    EXPECT_EQ(svg.find("#009e73"), std::string::npos);
}

TEST(Chart, ALongKeyHasTwoLines) {
    Chart chart;
    for (const char* name : {"a rather long name", "another rather long name", "a third long name",
                             "the fourth of the names"})
        chart.series.push_back({name, {{1, 1, {}, {}}, {2, 2, {}, {}}}, true, true, false});
    const std::string svg = draw_chart_svg(chart);
    EXPECT_NE(svg.find("y=\"21\""), std::string::npos);
    EXPECT_NE(svg.find("y=\"43\""), std::string::npos);
}

TEST(Chart, EscapesHostileWords) {
    const std::string hostile = "<script>&\"\xff";
    Chart chart = two_points(1, 1, 2, 2);
    chart.title = chart.about = chart.x_label = chart.series[0].name =
        chart.series[0].points[0].label = chart.series[0].points[0].about = hostile;
    EXPECT_EQ(xml_fault(draw_chart_svg(chart)), "");
}

}  // namespace
}  // namespace culet
