// A newcomer's three commands: cut, fill in, fit. And a design scaled to millimetres.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>

#include "stone/text/output_file.h"
#include "tests/app/program_test.h"

namespace culet {
namespace {

using test::ProgramRun;
using test::run_culet;
using ::testing::HasSubstr;

const std::string k_form_design = CULET_SOURCE_DIR "/tests/stone/designs/own_oval_135.asc";

class BenchForm : public test::ProgramTest {
protected:
    // Some rows with the value that their note expects, in the words of a bench; the rest empty.
    void fill_in(const std::string& form, const std::string& rows) const {
        const std::regex row("(" + rows + ")(,.*expected ([0-9.]+).*)");
        std::istringstream lines(read_text(form));
        std::string line, text;
        std::smatch found;
        while (std::getline(lines, line)) {
            if (std::regex_match(line, found, row))
                line = found.str(1) + found.str(3) + found.str(2);
            text += line + "\n";
        }
        std::ofstream(form) << text;
    }
};

TEST_F(BenchForm, CutFillInFit) {
    const ProgramRun cut =
        run_culet({"cut", "round-brilliant", "--diameter", "6.52mm", "--table", "58%",
                   "--crown-angle", "33,8", "--material", "diamond", "-o", file("stone.obj"),
                   "--readings", file("form.csv"), "--stone", file("stone.toml")});
    ASSERT_EQ(cut.exit_code, 0) << cut.err;
    EXPECT_THAT(cut.err, HasSubstr("28 rows to fill in"));
    EXPECT_THAT(cut.err, HasSubstr("culet fit " + file("stone.toml")));

    const ProgramRun early = run_culet({"fit", file("stone.toml"), "-o", file("fitted.obj")});
    EXPECT_EQ(early.exit_code, 2);
    EXPECT_THAT(early.err, HasSubstr(".csv"));

    fill_in(file("form.csv"), "inclination,[CP]@[0-9]+,|width,[0-9]*,|depth,,");
    const ProgramRun fit = run_culet(
        {"fit", file("stone.toml"), "-o", file("fitted.obj"), "--report", file("fit.json")});
    EXPECT_LE(fit.exit_code, 1) << fit.err;
    // Of 28 rows 4 tiers, 2 tables and the weight stay empty.
    EXPECT_THAT(fit.err, HasSubstr("7 rows"));
    const auto report = nlohmann::json::parse(read_text(file("fit.json")));
    EXPECT_EQ(report.at("readings").size(), 21u);
    EXPECT_THAT(report.at("notes").dump(), HasSubstr("7 rows"));
    // The fitted stone keeps its design: main C2 is at azimuth 45, tooth 12 of 96 (docs: 90 - 360 x
    // 12/96), and the sheet lists the tiers of a brilliant.
    for (const auto& facet : report.at("facets")) {
        if (facet.at("name") != "C2") continue;
        EXPECT_EQ(facet.at("tier"), "C");
        EXPECT_NEAR(facet.at("index").get<double>(), 12, 1e-9);
    }
    const ProgramRun sheet = run_culet({"info", file("fitted.obj"), "--cutting-sheet", "-"});
    EXPECT_EQ(sheet.exit_code, 0) << sheet.err;
    for (const char* line :
         {"57 \\+ 96 facets; 8-fold", "PAVILION\n  1  L ", "CROWN\n", " 5  C [^\n]+ 96-12-24"})
        EXPECT_THAT(sheet.out, ::testing::ContainsRegex(line));
    EXPECT_TRUE(report.at("suspects").empty());
}

TEST_F(BenchForm, OfADesignInMillimetres) {
    ASSERT_EQ(
        run_culet({"convert", "--width", "6.5mm", k_form_design, file("oval.obj"), "-q"}).exit_code,
        0);
    const auto size = [&](const std::vector<std::string>& arguments) {
        const ProgramRun run = run_culet(arguments);
        EXPECT_EQ(run.exit_code, 0) << run.err;
        return nlohmann::json::parse(run.out);
    };
    const auto scaled = size({"info", file("oval.obj"), "--json", "-"}),
               told = size({"info", k_form_design, "--width", "0.65 cm", "--json", "-"}),
               design = size({"info", k_form_design, "--json", "-"});
    EXPECT_NEAR(scaled.at("w").get<double>(), 6.5, 1e-12);
    EXPECT_NEAR(told.at("w").get<double>(), 6.5, 1e-12);
    EXPECT_NEAR(scaled.at("l_w").get<double>(), design.at("l_w").get<double>(), 1e-12);
    EXPECT_NEAR(scaled.at("caliper").at("max").get<double>(),
                6.5 / design.at("w").get<double>() * design.at("caliper").at("max").get<double>(),
                1e-9);
    EXPECT_NE(read_text(file("oval.obj")).find("g A1.3\n"), std::string::npos);

    const ProgramRun form =
        run_culet({"info", file("oval.obj"), "--material", "sapphire_blue", "--readings",
                   file("form.csv"), "--stone", file("stone.toml")});
    EXPECT_EQ(form.exit_code, 0) << form.err;
    EXPECT_THAT(read_text(file("form.csv")), HasSubstr("inclination,A1*,"));
    fill_in(file("form.csv"), "inclination,[^,]*,|width,[0-9]*,|depth,,|weight,,");
    const ProgramRun fit = run_culet(
        {"fit", file("stone.toml"), "-o", file("fitted.obj"), "--report", file("fit.json")});
    EXPECT_LE(fit.exit_code, 1) << fit.err;
    EXPECT_TRUE(nlohmann::json::parse(read_text(file("fit.json"))).at("suspects").empty());
}

// STL keeps no names, and a heart is not convex: the form must still fit the mesh.
TEST_F(BenchForm, FitsTheMeshAsItIsRead) {
    for (const auto& [cut, mesh] : {std::pair("step", "step.stl"), std::pair("heart", "heart.obj"),
                                    std::pair("oval", "oval.asc")}) {
        const ProgramRun made =
            run_culet({"cut", cut, "-o", file(mesh), "--readings", file("form.csv"), "--stone",
                       file("stone.toml"), "--material", "diamond"});
        ASSERT_EQ(made.exit_code, 0) << made.err;
        fill_in(file("form.csv"), "[a-z_]+,(?:\"[^\"]*\"|[^,]*),");
        const ProgramRun fit = run_culet(
            {"fit", file("stone.toml"), "-o", file("fitted.obj"), "--report", file("fit.json")});
        EXPECT_LE(fit.exit_code, 1) << fit.err;
        const auto report = nlohmann::json::parse(read_text(file("fit.json")));
        EXPECT_TRUE(report.at("suspects").empty()) << cut;
        EXPECT_GT(report.at("readings").size(), 20u) << cut;
    }
}

// The design's own settings: mains 23 of its oval are at indices 48 and 96.
TEST_F(BenchForm, CuttingListOfADesign) {
    const ProgramRun run = run_culet({"info", k_form_design, "--cutting-list"});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_THAT(run.out, ::testing::ContainsRegex("23 +pavilion +33.24 +48 96\n"));
    const ProgramRun other = run_culet({"info", k_form_design, "--gear", "64", "--json", "-"});
    const auto list = nlohmann::json::parse(other.out).at("cutting_list");
    EXPECT_EQ(list.size(), 21u);  // lines of the file that begin with `a`
}

TEST_F(BenchForm, CuttingSheetIsAPageOrText) {
    const ProgramRun text =
        run_culet({"info", k_form_design, "--width", "8mm", "--cutting-sheet", "-"});
    EXPECT_EQ(text.exit_code, 0) << text.err;
    EXPECT_THAT(text.out, ::testing::ContainsRegex("width W +8 mm\n"));
    EXPECT_THAT(text.out, ::testing::ContainsRegex("23 +33.24 +96-48 +[A-Z]"));
    const ProgramRun page = run_culet({"info", k_form_design, "--cutting-sheet", file("s.html")});
    EXPECT_EQ(page.exit_code, 0) << page.err;
    EXPECT_THAT(read_text(file("s.html")), ::testing::HasSubstr("<svg"));
    for (const char* out : {"s.pdf", "s"}) {
        const ProgramRun run = run_culet({"info", k_form_design, "--cutting-sheet", file(out)});
        EXPECT_EQ(run.exit_code, 2);
        EXPECT_THAT(run.err, ::testing::HasSubstr(".html"));
        EXPECT_FALSE(std::filesystem::exists(file(out)));
    }
}

TEST_F(BenchForm, WhatCannotBeDoneIsOneLine) {
    EXPECT_THAT(refusal({"cut", "oval", "-o", file("a.obj"), "--stone", file("a.toml")}),
                HasSubstr("--readings"));
    EXPECT_THAT(refusal({"cut", "oval", "--readings", file("a.csv")}), HasSubstr("-o MESH"));
    EXPECT_THAT(refusal({"cut", "oval", "--width", "6.5 deg", "-o", file("a.obj")}),
                HasSubstr("--width"));
    EXPECT_THAT(refusal({"cut", "oval", "--width", "wide", "-o", file("a.obj")}),
                HasSubstr("--width"));
    EXPECT_THAT(refusal({"convert", "--width", "0mm", k_form_design, file("a.obj")}),
                HasSubstr("--width"));
    EXPECT_THAT(refusal({"info", CULET_SOURCE_DIR "/samples/dravite-step/scene.toml", "--readings",
                         file("a.csv")}),
                HasSubstr("stone file"));
    EXPECT_FALSE(std::filesystem::exists(file("a.obj")));
    EXPECT_FALSE(std::filesystem::exists(file("a.csv")));
}

}  // namespace
}  // namespace culet
