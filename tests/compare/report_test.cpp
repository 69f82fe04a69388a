#include "compare/report/report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>

#include "compare/calibration/picture_comparison.h"
#include "compare/report/report_parts.h"
#include "compare/report/scores_json.h"
#include "stone/text/errors.h"
#include "tests/compare/synthetic_pictures.h"
#include "tests/page/kept_pages.h"

namespace culet {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

const char* const k_hostile = "<script>alert('x')</script>&\"\xff";

Solid cube(const std::string& top = "T") {
    const NamedPlane planes[] = {{top, {Vec3(0, 0, 1), 1}},      {"B", {Vec3(0, 0, -1), 1}},
                                 {"E", {Vec3(1, 0, 0), 1}},      {"W", {Vec3(-1, 0, 0), 1}},
                                 {"N", {Vec3(0, 1, 0), 1}},      {"S", {Vec3(0, -1, 0), 1}},
                                 {"C", {Vec3(0.6, 0, 0.8), 1.2}}};
    return intersect_half_spaces(planes).solid;
}

std::string fit_json(const std::string& name) {
    nlohmann::json fit = {{"schema", 1},
                          {"status", "contradictory"},
                          {"facets",
                           {{{"name", name}, {"inclination", 0.0}, {"sigma_inclination", 0.01}},
                            {{"name", "C"}, {"inclination", 36.87}, {"azimuth", 0.0}}}},
                          {"readings",
                           {{{"id", "r0"},
                             {"kind", "inclination"},
                             {"of", {"C"}},
                             {"value", 37.1},
                             {"sigma", 0.1},
                             {"fitted", 36.87},
                             {"residual", -0.23},
                             {"normalized", -2.3},
                             {"redundancy", 0.4},
                             {"detectable", 0.7},
                             {"suspect", true}},
                            {{"id", "r1"},
                             {"kind", "depth"},
                             {"of", nlohmann::json::array()},
                             {"value", 2},
                             {"normalized", nullptr}}}},
                          {"undetermined", {{{"facet", "B"}, {"freedom", "offset"}}}},
                          {"suspects", {"r0"}},
                          {"chi2", 5.3},
                          {"dof", 2},
                          {"closed", true},
                          {"convex", true}};
    return fit.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

synthetic::StonePicture small_stone() {
    synthetic::StonePicture picture;
    picture.width = 120;
    picture.height = 110;
    picture.centre_x = 60;
    picture.centre_y = 55;
    picture.diameter = 80;
    picture.samples = 2;
    return picture;
}

Report full_report(const std::string& name = "T") {
    Report report;
    report.title = "Stone " + name;
    report.version = "1.2.3";
    report.command = "culet run " + name;
    report.files = {{"photograph", name}};
    CompareOptions options;
    options.simulated = true;
    auto moved = small_stone();
    moved.cell_shift = 0.05;
    report.comparison = compare(draw(moved), draw(small_stone()), options);
    report.scores_json = scores_json(*report.comparison, {name, name, ""});
    report.fit_json = fit_json(name);
    report.fitted = cube(name);
    report.starting = cube(name);
    report.starting_render = draw(small_stone());
    report.fitted_render = draw(moved);
    report.stats_json =
        R"({"engine": "reference", "depth": 12, "effects": [{"name": "dispersion", "on": true,
            "why": "large", "error_bound": 0.01}], "seconds": {"total": 1.5}})";
    report.settings = "name = \"" + name + "\"";
    return report;
}

/// Tags that stay open or close in the wrong order, except void elements and the inside of script
/// and style. Empty when the page is well formed.
std::string nesting_fault(const std::string& page) {
    static const std::set<std::string> void_elements{"meta", "link", "img", "input", "br"};
    std::vector<std::string> open;
    for (std::size_t at = page.find('<'); at != std::string::npos; at = page.find('<', at)) {
        if (page.compare(at, 2, "<!") == 0) {
            ++at;
            continue;
        }
        const std::size_t end = page.find('>', at);
        if (end == std::string::npos) return "a tag that never ends";
        std::string tag = page.substr(at + 1, end - at - 1);
        at = end;
        const bool closes = tag.starts_with('/'), self_closed = tag.ends_with('/');
        tag = tag.substr(closes ? 1 : 0);
        tag = tag.substr(0, tag.find_first_of(" \n/"));
        if (void_elements.contains(tag) || self_closed) continue;
        if (closes) {
            if (open.empty() || open.back() != tag) return "</" + tag + "> closes nothing";
            open.pop_back();
        } else {
            open.push_back(tag);
            if (tag == "script" || tag == "style") at = page.find("</" + tag, at);
        }
    }
    return open.empty() ? "" : "<" + open.back() + "> is never closed";
}

TEST(Report, HasEverySectionWhenAllDataIsThere) {
    const std::string page = report_page(full_report());
    for (const char* id :
         {"pictures", "maps", "scores", "registration", "changes", "fit", "plan", "provenance"}) {
        EXPECT_THAT(page, HasSubstr(std::string("<section id=\"") + id + "\"")) << id;
    }
    EXPECT_EQ(nesting_fault(page), "");
}

TEST(Report, OpensTheStoneWhereItHasAViewer) {
    Report report = full_report();
    EXPECT_EQ(report_page(report).find("wasm-unsafe-eval"), std::string::npos);
    report.viewer_html = "<!doctype html><script>1 < 2</script>";
    const std::string page = report_page(report);
    EXPECT_NE(page.find("class=\"turn-stone\""), std::string::npos);
    EXPECT_NE(page.find("wasm-unsafe-eval"), std::string::npos);
    // As JSON in which no tag begins or ends.
    EXPECT_NE(page.find("\\u003cscript>1 \\u003c 2\\u003c/script>"), std::string::npos);
    EXPECT_EQ(page.find("1 < 2"), std::string::npos);
}

TEST(Report, HasOnlyTheSectionsWhoseDataIsThere) {
    Report report;
    report.fit_json = fit_json("T");
    const std::string page = report_page(report);
    EXPECT_THAT(page, HasSubstr("<section id=\"fit\""));
    for (const char* id : {"pictures", "maps", "scores", "registration", "changes", "plan"}) {
        EXPECT_THAT(page, Not(HasSubstr(std::string("<section id=\"") + id + "\""))) << id;
    }
    EXPECT_EQ(nesting_fault(page), "");
}

void expect_order(const std::string& page, const std::vector<std::string>& parts) {
    std::size_t last = 0;
    for (const std::string& part : parts) {
        const std::size_t at = page.find(part);
        ASSERT_NE(at, std::string::npos) << part;
        EXPECT_LT(last, at) << part;
        last = at;
    }
}

TEST(Report, BeginsWithTheVerdictsThenWhatToLookAtThenThePicture) {
    Report report = full_report();
    expect_order(
        report_page(report),
        {"class=\"verdict", "<section id=\"look\"", "<section id=\"pictures\"",
         "<section id=\"scores\" class=\"folded\"", "<section id=\"drawing\" class=\"folded\"",
         "<section id=\"fit\"", "<section id=\"plan\" class=\"folded\"",
         "<section id=\"provenance\" class=\"folded\""});
    report.comparison.reset();
    report.scores_json.clear();
    expect_order(report_page(report),
                 {"class=\"verdict", "<section id=\"look\"", "<section id=\"changes\"",
                  "<section id=\"drawing\" class=\"folded\""});
    report.fitted_render.reset();
    report.starting_render.reset();
    // Nothing was rendered: the drawing is the picture.
    expect_order(report_page(report),
                 {"class=\"verdict", "<section id=\"look\"", "<section id=\"drawing\" aria"});
}

TEST(Report, ShowsTheStoneWellExposed) {
    // Of a hundred values nine in ten are dull and the rest are glints. White is chosen so that the
    // median is shown at 0.4, but with at most 7 and at least 2 values over white.
    std::vector<float> dull(90, 0.1f), glints{0.3f, 0.4f, 0.5f, 0.6f, 0.7f, 0.8f, 0.9f, 1, 2, 3};
    dull.insert(dull.end(), glints.begin(), glints.end());
    EXPECT_NEAR(white_for_stone(dull).value(), 0.5, 1e-6);
    EXPECT_NEAR(white_for_stone(std::vector<float>(100, 0.2f)).value(), 0.2, 1e-6);
    EXPECT_FALSE(white_for_stone({0, 0, std::numeric_limits<float>::quiet_NaN()}));
}

TEST(Report, OfNothingIsStillAPage) {
    EXPECT_EQ(nesting_fault(report_page({})), "");
}

TEST(Report, LoadsNothing) {
    const std::string page = report_page(full_report());
    EXPECT_THAT(page, Not(HasSubstr("http:")));
    EXPECT_THAT(page, Not(HasSubstr("https:")));
    EXPECT_THAT(page, Not(HasSubstr("@import")));
    EXPECT_THAT(page, HasSubstr("default-src 'none'"));
    // Every source is inline.
    const std::regex source("(src|href)=\"([^\"]{0,5})");
    for (auto it = std::sregex_iterator(page.begin(), page.end(), source);
         it != std::sregex_iterator(); ++it) {
        EXPECT_EQ((*it)[2].str(), "data:");
    }
}

TEST(Report, EscapesHostileNamesEverywhere) {
    const std::string page = report_page(full_report(k_hostile));
    EXPECT_THAT(page, Not(HasSubstr("<script>alert")));
    EXPECT_THAT(page, HasSubstr("&lt;script&gt;alert(&#39;x&#39;)"));
    EXPECT_THAT(page, Not(HasSubstr("\xff")));
    EXPECT_EQ(nesting_fault(page), "");
    test::keep_page("report", report_page(full_report(test::hostile_name())));
}

TEST(Report, HoldsTheJsonThatJsonWrites) {
    const Report report = full_report(k_hostile);
    const std::string page = report_page(report);
    const std::string mark = "<script type=\"application/json\" id=\"culet-data\">";
    const std::size_t from = page.find(mark) + mark.size();
    const auto data = nlohmann::json::parse(page.substr(from, page.find("</script>", from) - from));
    EXPECT_EQ(data["scores"], nlohmann::json::parse(report.scores_json));
    EXPECT_EQ(data["fit"], nlohmann::json::parse(report.fit_json));
}

TEST(Report, SaysThatAPhotographIsSimulatedWhereverItAppears) {
    Report report = full_report();
    const auto count = [](const std::string& page, const std::string& what) {
        int found = 0;
        for (std::size_t at = page.find(what); at != std::string::npos;
             at = page.find(what, at + 1)) {
            ++found;
        }
        return found;
    };
    const std::string page = report_page(report);
    EXPECT_THAT(page, HasSubstr("<h2 id=\"pictures-heading\">Simulated photograph"));
    EXPECT_GE(count(page, "simulated photograph"), 5);
    EXPECT_EQ(count(page, "The stone in the photograph"), 0);
    report.comparison->simulated = false;
    report.scores_json.clear();
    EXPECT_EQ(count(report_page(report), "imulated photograph"), 0);
}

TEST(Report, MarksSuspectsInWords) {
    EXPECT_THAT(report_page(full_report()), HasSubstr("<span class=\"badge\">suspect</span>"));
}

TEST(Report, OfARefusedComparisonShowsBothOutlinesAndTheReason) {
    auto narrow = small_stone();
    narrow.flatness = 0.45;
    Report report;
    report.comparison = compare(draw(narrow), draw(small_stone()));
    ASSERT_EQ(report.comparison->verdict, Verdict::refused);
    const std::string page = report_page(report);
    EXPECT_THAT(page, HasSubstr("Comparison refused"));
    EXPECT_THAT(page, HasSubstr("outline-photo\" d=\"M"));
    EXPECT_THAT(page, HasSubstr("outline-render\" d=\"M"));
    EXPECT_THAT(page, Not(HasSubstr("<section id=\"maps\"")));
    test::keep_page("report-refused", page);
    EXPECT_EQ(nesting_fault(page), "");
}

TEST(Report, OfABlackPhotographIsAPage) {
    Report report;
    report.comparison = compare(synthetic::flat(64, 64, 0), draw(small_stone()));
    EXPECT_EQ(nesting_fault(report_page(report)), "");
}

TEST(Report, RefusesTextThatIsNoJson) {
    Report report;
    report.fit_json = "{\"status\": ";
    EXPECT_THROW(report_page(report), InputError);
    report.fit_json = "[1, 2]";
    EXPECT_THROW(report_page(report), InputError);
}

TEST(Report, SurvivesJsonOfUnexpectedShape) {
    Report report;
    report.fit_json =
        R"({"status": 7, "facets": {"a": 1}, "readings": [1, null, {"of": 3}, {"id": []}],
            "suspects": [{}, 4], "closed": "yes", "undetermined": [7]})";
    report.stats_json = R"({"effects": [1, {"on": 3}], "seconds": [1], "depth": "x"})";
    EXPECT_EQ(nesting_fault(report_page(report)), "");
}

TEST(Report, IsTheSameBytesEachTime) {
    EXPECT_EQ(report_page(full_report()), report_page(full_report()));
}

}  // namespace
}  // namespace culet
