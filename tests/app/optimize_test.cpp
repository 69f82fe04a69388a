// culet optimize, as a cutter runs it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/app/program_test.h"

namespace culet {
namespace {

using test::ProgramRun;
using test::run_culet;
using ::testing::HasSubstr;

class OptimizeCommand : public test::ProgramTest {
protected:
    void SetUp() override { cut("round-brilliant", "round.obj"); }
};

TEST_F(OptimizeCommand, WritesADesignThatGradesAsItSays) {
    const ProgramRun run =
        run_culet({"optimize", file("round.obj"), "--index", "1.62", "--evaluations", "40", "-o",
                   file("better.asc"), "--json", file("better.json")});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_THAT(run.out, HasSubstr("degrees"));
    std::ifstream stream(file("better.json"));
    const nlohmann::json json = nlohmann::json::parse(stream);
    const double merit = json["merit"]["better"]["total"].get<double>();
    EXPECT_GT(merit, json["merit"]["start"]["total"].get<double>());
    // The file's own index, and the merit's tilts.
    const ProgramRun graded =
        run_culet({"grade", file("better.asc"), "--tilts", "-30:30:10", "--json", "-", "-q"});
    ASSERT_EQ(graded.exit_code, 0) << graded.err;
    const nlohmann::json grade = nlohmann::json::parse(graded.out);
    double mean = 0;
    for (const auto& model : grade["models"]) {
        if (model["name"] != "cos" || model["tilt_azimuth_deg"] != 0.0) continue;
        for (const auto& one : model["whole"]) mean += one.get<double>() / 7;
    }
    // The design is written to 1e-12 of its planes.
    EXPECT_NEAR(mean, merit, 1e-6);
}

TEST_F(OptimizeCommand, KeepsTheDesignsWords) {
    const ProgramRun first = run_culet({"convert", file("round.obj"), file("round.asc")});
    ASSERT_EQ(first.exit_code, 0) << first.err;
    std::string design = text("round.asc");
    const std::size_t fold = design.find("\ny ");
    ASSERT_NE(fold, std::string::npos);
    design.replace(fold, design.find('\n', fold + 1) - fold, "\ny 8 y");
    design.insert(design.find("\na "), "\nH Old Faithful\nH by A. Cutter");
    write("round.asc", design + "F Cut the girdle first\n");
    const ProgramRun run = run_culet({"optimize", file("round.asc"), "--index", "1.62",
                                      "--evaluations", "40", "-o", file("better.asc")});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const std::string better = text("better.asc");
    for (const char* kept : {"\ny 8 y\n", "\nH Old Faithful\nH by A. Cutter\n",
                             "\nF Cut the girdle first\nF Angles by culet optimize"})
        EXPECT_THAT(better, HasSubstr(kept));
    const auto tiers = [](const std::string& words) {
        std::size_t count = 0;
        for (std::size_t at = words.find("\na "); at != std::string::npos;
             at = words.find("\na ", at + 1))
            ++count;
        return count;
    };
    EXPECT_EQ(tiers(better), tiers(design));
    // The cutting sheet calls the upper mains C (Design.OfAStandardCutHasItsTiers).
    EXPECT_THAT(run.out, testing::ContainsRegex("\n  C  .* degrees"));
}

TEST_F(OptimizeCommand, RefusesInOneLine) {
    const auto refused = [&](std::vector<std::string> words, const char* why) {
        words.insert(words.begin(), {"optimize", file("round.obj")});
        const ProgramRun run = run_culet(words);
        EXPECT_EQ(run.exit_code, 2) << why;
        EXPECT_THAT(run.err, HasSubstr(why));
        EXPECT_FALSE(std::filesystem::exists(file("x.asc")));
    };
    refused({"--index", "1.5", "-o", file("x.obj")}, ".asc");
    refused({"-o", file("x.asc")}, "--material");
    refused({"--index", "0.9", "-o", file("x.asc")}, "above 1");
    refused({"--index", "1.5", "--objective", "glitter", "-o", file("x.asc")}, "--objective");
    refused({"--index", "1.5", "--objective", "fire", "-o", file("x.asc")}, "dispersion");
    refused({"--index", "1.5", "--gain", "2", "-o", file("x.asc")}, "--recut");
    refused({"--index", "1.5", "--model", "sun", "-o", file("x.asc")}, "--model");
}

}  // namespace
}  // namespace culet
