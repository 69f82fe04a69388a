// culet render of a stone alone, as a user runs it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "render/image/image_io.h"
#include "tests/app/program_test.h"

namespace culet {
namespace {

namespace fs = std::filesystem;
using test::ProgramRun;
using test::run_culet;
using ::testing::HasSubstr;
using ::testing::Not;

class RenderStone : public test::ProgramTest {
protected:
    void SetUp() override {
        cut("step", "stone.obj");
        cut("step", "stone.asc");
        write("stone.toml", "[stone]\nmesh = \"stone.obj\"\nmaterial = \"diamond\"\n");
    }
};

TEST_F(RenderStone, MeshesDesignsAndStoneFilesNeedNoScene) {
    for (const char* stone : {"stone.obj", "stone.asc", "stone.toml"}) {
        const std::string picture = file(std::string(stone) + ".png");
        const ProgramRun run = run_culet({"render", file(stone), "--material", "diamond", "--size",
                                          "48", "--tolerance", "0.1", "-o", picture});
        EXPECT_EQ(run.exit_code, 0) << run.err;
        EXPECT_EQ(run.out, "");
        const ReadPicture read = read_picture(picture);
        EXPECT_EQ(read.picture.width, 48);
        EXPECT_EQ(read.picture.height, 48);
        // Exposed: some of the stone is above 1, of which the film's curve makes 0.804.
        EXPECT_GT(*std::max_element(read.picture.rgb.begin(), read.picture.rgb.end()), 0.81f);
    }
}

TEST_F(RenderStone, SaysTheSizeThatItTakes) {
    const ProgramRun run = run_culet({"render", file("stone.asc"), "--material", "diamond",
                                      "--size", "32", "--tolerance", "0.2", "-o", file("a.png")});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_THAT(run.err, HasSubstr("6.5 mm wide"));
    EXPECT_THAT(run.err, HasSubstr("\nnext: open " + file("a.png")));
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 2) << run.err;
}

// Quartz, whose tolerance the time budget decides after a second.
TEST_F(RenderStone, SaysHowNearThePictureIsWhereNobodyAskedForATolerance) {
    const std::string stone = file("stone.obj");
    const ProgramRun run = run_culet({"render", stone, "--material", "quartz", "--size", "20", "-o",
                                      file("a.png"), "--stats", file("a.json")});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_THAT(run.err, HasSubstr("of the mean radiance"));
    const nlohmann::json stats = json("a.json");
    EXPECT_GT(stats["allowed_tolerance"], 0);
    EXPECT_LE(stats["error_bound"], 0.3);
    const ProgramRun asked = run_culet({"render", stone, "--material", "quartz", "--size", "20",
                                        "-o", file("b.png"), "--tolerance", "0.2"});
    EXPECT_EQ(asked.exit_code, 0) << asked.err;
    EXPECT_THAT(asked.err, Not(HasSubstr("of the mean radiance")));
}

TEST_F(RenderStone, GoesToStdoutAndStatsAlone) {
    const ProgramRun picture = run_culet(
        {"render", file("stone.toml"), "--size", "24", "--tolerance", "0.2", "-q", "-o", "-"});
    EXPECT_EQ(picture.exit_code, 0) << picture.err;
    EXPECT_EQ(picture.out.substr(0, 8), "\x89PNG\r\n\x1a\n");
    ASSERT_EQ(run_culet({"render", file("stone.toml"), "--size", "24", "--tolerance", "0.2", "-q",
                         "-o", file("same.png")})
                  .exit_code,
              0);
    EXPECT_EQ(picture.out, text("same.png"));
    const ProgramRun stats = run_culet(
        {"render", file("stone.toml"), "--size", "24", "--tolerance", "0.2", "-q", "--stats", "-"});
    EXPECT_EQ(stats.exit_code, 0) << stats.err;
    EXPECT_TRUE(nlohmann::json::parse(stats.out).contains("error_bound"));
}

// Work is counted: threads and load change nothing. Quartz, whose tolerance the work budget decides
// after a second.
TEST_F(RenderStone, WhatIsAllowedGivesTheSameBytesOnAnyNumberOfThreads) {
    for (const std::string threads : {"1", "3"}) {
        const ProgramRun run = run_culet(
            {"render", file("stone.obj"), "--material", "quartz", "--size", "20", "--threads",
             threads, "-q", "-o", file(threads + ".exr"), "--stats", file(threads + ".json")});
        ASSERT_EQ(run.exit_code, 0) << run.err;
        const auto stats = nlohmann::json::parse(text(threads + ".json"));
        EXPECT_GT(stats.at("allowed_tolerance").get<double>(), 0.01);
    }
    EXPECT_EQ(text("1.exr"), text("3.exr"));
    EXPECT_FALSE(text("1.exr").empty());
}

TEST_F(RenderStone, RefusesInOneLineAndWritesNothing) {
    const auto refused = [&](std::vector<std::string> arguments, const std::string& why) {
        arguments.insert(arguments.begin(), "render");
        EXPECT_THAT(refusal(arguments), HasSubstr(why));
        EXPECT_FALSE(fs::exists(folder_ / "x.png")) << why;
    };
    const std::string out = file("x.png"), stone = file("stone.obj");
    refused({stone, "-o", out}, "--material");
    refused({stone, "-o", out, "--material", "diamond", "--light", "daylihgt"}, "\"daylight\"");
    refused({stone, "-o", out, "--material", "diamond", "--light", "jewellery"}, "\"jeweller\"");
    refused({stone, "-o", out, "--material", "spinell"}, "spinel");
    refused({file("stone.toml"), "-o", out, "--exposure", "bright"}, "--exposure");
    refused({stone, "-o", out, "--material", "diamond", "--width", "0"}, "--width");
    refused({stone, "-o", out, "--material", "diamond", "--size", "12,34,56"}, "--size");
    refused({stone, "-o", "-", "--stats", "-", "--material", "diamond"}, "stdout");
    refused({stone, "--material", "diamond"}, "-o IMAGE");
}

// Plain shadings are never planned or verified: such requests are refused.
TEST_F(RenderStone, PlainShadingsAreDrawnAndSayWhatTheyAre) {
    for (const char* engine : {"flat", "gouraud", "phong", "whitted"}) {
        const ProgramRun run =
            run_culet({"render", file("stone.toml"), "--engine", engine, "--size", "32", "-o",
                       file("a.png"), "--stats", file("a.json")});
        EXPECT_EQ(run.exit_code, 0) << run.err;
        EXPECT_THAT(run.err, HasSubstr("plain shading"));
        EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 2) << run.err;
        const nlohmann::json stats = json("a.json");
        EXPECT_EQ(stats["engine"], engine);
        EXPECT_TRUE(stats["error_bound"].is_null());
    }
    for (const char* option : {"--explain", "--verify"}) {
        refusal({"render", file("stone.toml"), "--engine", "phong", option, "-o", file("b.png")});
        EXPECT_FALSE(fs::exists(file("b.png")));
    }
}

}  // namespace
}  // namespace culet
