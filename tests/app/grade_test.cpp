// culet grade, as a cutter runs it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/app/program_test.h"

namespace culet {
namespace {

namespace fs = std::filesystem;
using test::ProgramRun;
using test::run_culet;
using ::testing::HasSubstr;
using Json = nlohmann::json;

class GradeCommand : public test::ProgramTest {
protected:
    void SetUp() override { cut("round-brilliant", "round.obj"); }
};

TEST_F(GradeCommand, WritesWhatTheContractNames) {
    const ProgramRun run = run_culet({"grade", file("round.obj"), "--material", "diamond",
                                      "--tilts", "-30:30:10", "--json", "-"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const Json json = Json::parse(run.out);
    EXPECT_EQ(json.at("schema"), 1);
    EXPECT_EQ(json.at("material"), "diamond");
    EXPECT_NEAR(json.at("index").get<double>(), 2.417, 0.002);
    EXPECT_GT(json.at("silhouette_area").get<double>(), 0);
    std::vector<std::string> names;
    for (const Json& model : json.at("models")) {
        if (model.at("tilt_azimuth_deg") == 0) names.push_back(model.at("name"));
        EXPECT_EQ(model.at("tilt_deg"), Json({-30.0, -20.0, -10.0, 0.0, 10.0, 20.0, 30.0}));
        EXPECT_EQ(model.at("whole").size(), 7u);
        EXPECT_EQ(model.at("table").size(), 7u);
    }
    EXPECT_THAT(names, testing::ElementsAre("iso", "cos", "sc2", "random", "wlr"));
    double sum = 0;
    for (const auto& [key, value] : json.at("balance").items()) sum += value.get<double>();
    EXPECT_NEAR(sum, 1, 1e-9);
    for (const char* key : {"return", "head", "leak", "other", "entry_reflection", "residual"})
        EXPECT_TRUE(json.at("balance").contains(key)) << key;
    for (const char* key : {"red", "green", "blue", "dark"})
        EXPECT_TRUE(json.at("aset").at(key).is_number()) << key;
    EXPECT_EQ(json.at("hearts").at("count"), 8);
    EXPECT_GT(json.at("hearts").at("evenness").get<double>(), 0.99);
    EXPECT_TRUE(json.at("arrows").contains("count"));
    EXPECT_TRUE(json.at("fire").at("separated").is_number());
    EXPECT_TRUE(json.at("sigma").is_object());
}

TEST_F(GradeCommand, IndexOverridesTheMaterialAndDesignsHaveTheirOwn) {
    ASSERT_EQ(run_culet({"convert", file("round.obj"), file("round.asc"), "-q"}).exit_code, 0);
    const ProgramRun run =
        run_culet({"grade", file("round.asc"), "--index", "1.54", "--tilts", "0", "--json", "-"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const Json json = Json::parse(run.out);
    EXPECT_EQ(json.at("index"), 1.54);
    EXPECT_TRUE(json.at("material").is_null());
    EXPECT_TRUE(json.at("fire").is_null());
    const ProgramRun shifted = run_culet({"grade", file("round.asc"), "--material", "diamond",
                                          "--index", "2.5", "--tilts", "0", "--json", "-"});
    ASSERT_EQ(shifted.exit_code, 0) << shifted.err;
    EXPECT_EQ(Json::parse(shifted.out).at("index"), 2.5);
    EXPECT_TRUE(Json::parse(shifted.out).at("fire").is_object());
}

TEST_F(GradeCommand, PageHoldsSeveralDesignsAndLoadsNothing) {
    ASSERT_EQ(run_culet({"cut", "round-brilliant", "--pavilion-angle", "42.5", "-o",
                         file("deep.obj"), "-q"})
                  .exit_code,
              0);
    const ProgramRun run =
        run_culet({"grade", file("round.obj"), file("deep.obj"), "--material", "diamond", "--tilts",
                   "-20:20:10", "--size", "32", "-o", file("page"), "-q"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const std::string page = text("page/report.html");
    EXPECT_THAT(page, HasSubstr("data:image/png;base64,"));
    EXPECT_THAT(page, HasSubstr("round"));
    EXPECT_THAT(page, HasSubstr("deep"));
    EXPECT_THAT(page, HasSubstr("light-paths"));
    EXPECT_THAT(page, testing::Not(HasSubstr("src=\"http")));
    const Json json = this->json("page/grade.json");
    EXPECT_EQ(json.at("designs").size(), 2u);
    EXPECT_TRUE(fs::exists(folder_ / "page/1-aset.png"));
    EXPECT_TRUE(fs::exists(folder_ / "page/2-hearts.png"));
}

TEST_F(GradeCommand, TellsSigmasByAFitReport) {
    // Every facet known to 0.2 degrees, in a report as culet fit writes it.
    std::ifstream mesh(folder_ / "round.obj");
    Json facets = Json::array();
    for (std::string line; std::getline(mesh, line);) {
        if (line.rfind("g ", 0) == 0)
            facets.push_back({{"name", line.substr(2)},
                              {"sigma_inclination", 0.2},
                              {"sigma_azimuth", nullptr},
                              {"sigma_offset", 0.0}});
    }
    std::ofstream(folder_ / "fit.json") << Json{{"facets", facets}}.dump();
    const ProgramRun run =
        run_culet({"grade", file("round.obj"), "--material", "diamond", "--tilts", "0", "--draws",
                   "3", "--report", file("fit.json"), "--json", "-"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const Json json = Json::parse(run.out);
    EXPECT_EQ(json.at("sigma_draws"), 3);
    EXPECT_GT(json.at("sigma").at("iso").get<double>(), 0);
    EXPECT_GT(json.at("sigma").at("aset.red").get<double>(), 0);
    EXPECT_GT(json.at("sigma").at("hearts.evenness").get<double>(), 0);
    std::ofstream(folder_ / "other.json") << Json{{"facets", Json::array()}}.dump();
    const ProgramRun other = run_culet({"grade", file("round.obj"), "--material", "diamond",
                                        "--report", file("other.json"), "-q"});
    EXPECT_EQ(other.exit_code, 2);
    EXPECT_THAT(other.err, HasSubstr("other.json"));
}

TEST_F(GradeCommand, RefusesWithOneLineAndWritesNothing) {
    write("bad.asc", "GemCad 5.0\ng 96 0\nI 1.5\na 10 0.5 0\n");
    write("notes.txt", "no stone\n");
    write("no.json", "[1, 2");
    const auto refused = [&](std::vector<std::string> arguments, const std::string& words) {
        arguments.insert(arguments.begin(), "grade");
        for (const char* more : {"-o", "--json"}) {
            arguments.emplace_back(more);
            arguments.push_back(file(std::string(more) == "-o" ? "never" : "never.json"));
        }
        EXPECT_THAT(refusal(arguments), HasSubstr(words));
        EXPECT_FALSE(fs::exists(folder_ / "never.json"));
        EXPECT_FALSE(fs::exists(folder_ / "never/report.html"));
    };
    const std::string round = file("round.obj");
    refused({round}, "--material");
    refused({"round-brilliant"}, "--material");  // a cut that the catalogue knows
    refused({round, "--material", "diamnd"}, "diamond");
    refused({round, "--index", "0.9"}, "above 1");
    refused({round, "--index", "nan"}, "index");
    refused({round, "--material", "diamond", "--tilts", "-30:30:0"}, "--tilts");
    refused({round, "--material", "diamond", "--tilts", "-30:30:1e-9"}, "--tilts");
    refused({round, "--material", "diamond", "--tilts", "0:200:10"}, "--tilts");
    refused({round, "--material", "diamond", "--tilts", "x"}, "--tilts");
    refused({round, "--material", "diamond", "--head", "95"}, "--head");
    refused({round, "--material", "diamond", "--report", file("no.json")}, "no.json");
    refused({file("bad.asc")}, "bad.asc");
    refused({file("notes.txt")}, "notes.txt");
    refused({file("missing.asc")}, "missing.asc");
}

// The hand-drawn facets of the sample are not planar.
TEST_F(GradeCommand, LeavesOutAMeshAsDrawnThatIsNoStone) {
    const ProgramRun run =
        run_culet({"grade", CULET_SOURCE_DIR "/samples/dravite-step/stone.toml", "--tilts", "0",
                   "--draws", "2", "--size", "32", "-o", file("page")});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_THAT(run.err, HasSubstr("as drawn is left out"));
    EXPECT_TRUE(fs::exists(folder_ / "page/report.html"));
}

}  // namespace
}  // namespace culet
