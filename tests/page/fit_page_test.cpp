// Reports as `culet fit --report` writes them (docs/fit-report.md), shortened by hand; the page's
// content is worked out by hand.

#include "page/fit_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "page/parts.h"
#include "stone/text/errors.h"
#include "tests/page/kept_pages.h"
#include "tests/says.h"

namespace culet {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using Json = nlohmann::json;
using test::says;

Json reading(const std::string& id, double value) {
    return {{"id", id},         {"kind", "inclination"}, {"of", {"C5"}},        {"value", value},
            {"sigma", 0.1},     {"exact", false},        {"fitted", 33.8},      {"residual", -4.5},
            {"normalized", -9}, {"redundancy", 0.5},     {"detectable", 214336}};
}

Json converged() {
    return {{"status", "converged"},
            {"message", "the readings agree (chi-square 12.6, 165 expected)"},
            {"unit", "mm"},
            {"chi2", 12.6},
            {"dof", 165.0},
            {"readings", {reading("r0", 33.8), reading("r1", 33.9)}},
            {"facets",
             {{{"name", "T"},
               {"inclination", 1e-27},
               {"sigma_inclination", 4.8e-21},
               {"sigma_azimuth", nullptr},
               {"from_readings", {{"inclination", 1.0}}}},
              {{"name", "C5"},
               {"inclination", 33.78684},
               {"sigma_inclination", 0.098784},
               {"azimuth", 180.0},
               {"sigma_azimuth", 0.2},
               {"from_readings", {{"inclination", 0.2}}}}}},
            {"prior", {{"source", "catalogue"}}},
            {"suspects", Json::array()}};
}

Json slipped() {
    Json fit = converged();
    fit["status"] = "contradictory";
    fit["doubts"] = {"readings.csv line 10: inclination of C5 38.3 degrees is 4.5 degrees away"};
    fit["summary"] = {"The doubt.", "It is left out; the other readings agree with this stone."};
    fit["suspects"] = {"r0"};
    fit["readings"][0]["left_out"] = "far off";
    fit["proposals"] = {{{"id", "r0"},
                         {"estimate", 33.8},
                         {"sigma", 0.3},
                         {"slip", "two digits swapped"},
                         {"corrected", 33.8}}};
    return fit;
}

FitView view(const Json& fit) {
    return {fit.dump(), std::nullopt, "mm"};
}

TEST(FitPage, CardIsInPlainWordsWithoutStatistics) {
    const std::string card = fit_card(view(converged())), tiles = fit_tiles(view(converged()));
    EXPECT_THAT(card, Not(HasSubstr("C5")));
    EXPECT_THAT(card + tiles, Not(HasSubstr("chi")));
    EXPECT_THAT(card + tiles, Not(HasSubstr("χ")));
    EXPECT_THAT(tiles, HasSubstr("<b>2</b><span>"));
    EXPECT_THAT(tiles, HasSubstr("<b>1 of 2</b><span>"));
}

TEST(FitPage, CountsRowsBesideReadings) {
    Json fit = converged();
    fit["readings"] = {reading("r0.C1", 1), reading("r0.C2.1", 1), reading("mine.1", 1),
                       reading("mine.2", 1)};
    EXPECT_THAT(fit_tiles(view(fit)), says("<b>4</b><span>", "3 rows"));
}

TEST(FitPage, CardTellsWhatStandsOut) {
    Json fit = converged();
    fit["tier_angles"] = {{{"what", {"P3 is 0.6 degrees (+- 0.1) steeper", "P5 is flatter"}}}};
    EXPECT_THAT(fit_card(view(fit)), says("P3 is 0.6° (± 0.1) steeper", "1 more"));
    EXPECT_THAT(fit_look_section(view(fit)), HasSubstr("<li>P5 is flatter.</li>"));
}

TEST(FitPage, TakesForeignTextForText) {
    Json fit = slipped();
    const std::string name = test::hostile_name();
    fit["doubts"] = {name};
    fit["facets"][1]["name"] = name;
    fit["readings"][1]["of"] = {name};
    fit["readings"][1]["id"] = name;
    const FitView shown = view(fit);
    const std::string page =
        html_page(name, fit_card(shown) + "<dl class=\"tiles\">" + fit_tiles(shown) + "</dl>" +
                            fit_look_section(shown) + fit_section(shown));
    EXPECT_THAT(page, Not(HasSubstr("<img")));
    test::keep_page("fit", page);
}

TEST(FitPage, NamesTheSlipAndWhatToDo) {
    // As in the fit's report, with the right value.
    const std::string doubt = "readings.csv line 10: inclination of C5 38.3° is 4.5° away";
    EXPECT_THAT(fit_card(view(slipped())),
                says(doubt, "It is left out; the other readings agree with this stone."));
    EXPECT_THAT(fit_look_section(view(slipped())), says(doubt, "33.8°"));
}

TEST(FitPage, TellsOfASuspectThatTheFitStillHeeds) {
    Json fit = slipped();
    fit["doubts"] = Json::array();
    fit["readings"][0].erase("left_out");
    fit["readings"][0]["value"] = 38.3;
    EXPECT_THAT(fit_look_section(view(fit)),
                says("r0", "inclination of C5", "38.3°", "33.80 ± 0.30°", "4.50°", "33.8°",
                     "two digits swapped"));
}

TEST(FitPage, CardOfEveryStatus) {
    Json fit = converged();
    fit["message"] = "too little was read";
    std::set<std::string> cards{fit_card(view(fit))};
    for (const char* status : {"undetermined", "not_converged", "contradictory"}) {
        fit["status"] = status;
        EXPECT_THAT(fit_card(view(fit)), HasSubstr("<p>Too little was read.</p>")) << status;
        EXPECT_TRUE(cards.insert(fit_card(view(fit))).second) << status << " as another";
    }
    fit["status"] = "no such status";
    EXPECT_TRUE(cards.insert(fit_card(view(fit))).second);
}

TEST(FitPage, SaysWhatIsOpenAFacetALineAndFoldsLongLists) {
    Json fit = converged();
    for (int f = 0; f < 12; ++f) {
        for (const char* freedom : {"inclination", "offset"}) {
            fit["undetermined"].push_back(
                {{"facet", "P" + std::to_string(f)}, {"freedom", freedom}});
        }
    }
    const std::string section = fit_look_section(view(fit));
    EXPECT_THAT(section, HasSubstr("inclination and offset of P0"));
    EXPECT_THAT(section, HasSubstr("<summary>4 more</summary>"));
}

TEST(FitPage, SaysWhatToReadNextOnlyWhereItIsWorthIt) {
    Json fit = converged();
    fit["help"] = {{{"kind", "azimuth"}, {"of", {"G29"}}, {"reduces", 0.36}},
                   {{"kind", "dihedral"}, {"of", {"P5", "P4"}}, {"closes", true}},
                   {{"kind", "depth"}, {"of", Json::array()}, {"reduces", 0.01}}};
    const std::string section = fit_look_section(view(fit));
    // sqrt(1 - 0.36) = 0.8
    EXPECT_THAT(section, says("azimuth", "G29", "20 %"));
    EXPECT_THAT(section, says("P5", "P4"));
    EXPECT_THAT(section, Not(HasSubstr("depth")));
}

TEST(FitPage, HasNothingToLookAtWhereThereIsNothing) {
    EXPECT_THAT(fit_look_section(view(converged())), IsEmpty());
    for (const FitView& none : {FitView{}, view(Json::object())}) {
        EXPECT_EQ(fit_card(none) + fit_tiles(none) + fit_look_section(none) +
                      fit_drawing_section(none, false) + fit_proportions_section(none) +
                      fit_section(none),
                  "");
    }
}

TEST(FitPage, ShowsCalipersBesideTheDiameter) {
    Json fit = converged();
    const auto add = [&](const char* name, double value, double sigma, const char* unit) {
        fit["proportions"].push_back(
            {{"name", name}, {"value", value}, {"sigma", sigma}, {"unit", unit}});
    };
    add("diameter", 6.4787, 0.0081, "mm");
    add("caliper min", 6.394, 0.015, "mm");
    add("caliper max", 6.521, 0.011, "mm");
    add("caliper mean", 6.4787, 0.0081, "mm");
    add("volume", 58.43847, 0.25538, "mm3");
    const std::string section = fit_proportions_section(view(fit));
    const std::size_t diameter = section.find("diameter"), caliper = section.find("caliper");
    EXPECT_LT(diameter, caliper);
    EXPECT_THAT(section,
                says("6.394 ± 0.015\u00a0mm", "6.521 ± 0.011\u00a0mm", "6.4787 ± 0.0081\u00a0mm"));
    EXPECT_THAT(section, HasSubstr("<summary>1 more"));
    EXPECT_THAT(section, HasSubstr("58.44 ± 0.26\u00a0mm³"));
}

TEST(FitPage, TablesAreFoldedWithTheirCountsAndHaveSensibleDigits) {
    const std::string section = fit_section(view(converged()));
    EXPECT_THAT(section, HasSubstr("<summary>2 facets"));
    EXPECT_THAT(section, HasSubstr("<summary>2 readings"));
    EXPECT_THAT(section, HasSubstr("33.787 ± 0.099°"));
    EXPECT_THAT(section, HasSubstr("0° ("));
    for (const char* noise : {"e-21", "e-27", "214336", "Redundancy", "Detectable", "Normalized"}) {
        EXPECT_THAT(section, Not(HasSubstr(noise)));
    }
}

TEST(FitPage, EscapesNamesInEverySentence) {
    const std::string evil = "<script>alert(1)</script>";
    Json fit = slipped();
    fit["doubts"] = {evil};
    fit["summary"] = {evil, evil};
    fit["suspects"] = {"r0", "r1", evil};
    fit["readings"][1]["of"] = {evil};
    fit["readings"][1]["kind"] = evil;
    fit["proposals"].push_back({{"id", "r1"}, {"estimate", 1.0}, {"alternatives", {evil}}});
    fit["tier_angles"] = {{{"what", {evil}}}};
    fit["undetermined"] = {{{"facet", evil}, {"freedom", evil}}};
    fit["help"] = {{{"kind", evil}, {"of", {evil}}, {"closes", true}}};
    fit["changes"] = {evil};
    fit["unit"] = evil;
    fit["proportions"] = {{{"name", evil}, {"value", 1.0}, {"sigma", 0.1}, {"unit", evil}}};
    fit["facets"][1]["name"] = evil;
    const FitView shown = {fit.dump(), std::nullopt, evil};
    const std::string page = fit_card(shown) + fit_tiles(shown) + fit_look_section(shown) +
                             fit_proportions_section(shown) + fit_section(shown);
    EXPECT_THAT(page, HasSubstr("&lt;"));
    EXPECT_THAT(page, Not(HasSubstr("<script")));
}

TEST(FitPage, RefusesWhatIsNoReport) {
    EXPECT_THROW(fit_card({"[1]", std::nullopt, "mm"}), InputError);
}

}  // namespace
}  // namespace culet
