// culet render --explain and --verify as a user runs them, on the scenes of samples/effects.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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
using ::testing::Not;

// The catalogue of effects, in the plan's order.
const std::vector<std::string> k_lines{
    "dispersion",  "birefringence",      "polarization", "absorption",  "pleochroism",
    "aperture",    "coherence",          "depth",        "wavelengths", "samples",
    "light_edges", "environment_filter", "objects"};

class RenderPlan : public test::ProgramTest {
protected:
    bool nothing_was_written() const { return fs::is_empty(folder_.path()); }

    static ProgramRun render(const std::string& scene, std::vector<std::string> more) {
        std::vector<std::string> arguments{
            "render", std::string(CULET_SOURCE_DIR "/samples/effects/") + scene, "--set",
            "camera.size=[48,48]"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run_culet(arguments);
    }
};

nlohmann::json item_of(const nlohmann::json& plan, const std::string& name) {
    for (const auto& item : plan["items"]) {
        if (item["name"] == name) return item;
    }
    ADD_FAILURE() << "no line for " << name;
    return {};
}

TEST_F(RenderPlan, ExplainsEveryEffectInALine) {
    const ProgramRun run = render("zircon-doubling.toml", {"--explain"});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(run.err, "");
    std::istringstream lines(run.out);
    std::string line;
    std::getline(lines, line);
    EXPECT_TRUE(line.starts_with("engine")) << line;
    for (const std::string& name : k_lines) {
        std::getline(lines, line);
        EXPECT_TRUE(line.starts_with(name + " ")) << line;
        EXPECT_TRUE(line.find(" on: ") != std::string::npos ||
                    line.find(" off: ") != std::string::npos)
            << line;
    }
    std::getline(lines, line);
    EXPECT_TRUE(line.starts_with("error bound")) << line;
    std::getline(lines, line);
    EXPECT_TRUE(line.starts_with("time")) << line;
    EXPECT_FALSE(std::getline(lines, line)) << line;
    EXPECT_THAT(run.out, HasSubstr("off: pinhole camera"));
    EXPECT_THAT(run.out, HasSubstr("environment map"));
    EXPECT_TRUE(nothing_was_written());
}

TEST_F(RenderPlan, ExplainsWithoutDrawing) {
    const ProgramRun run =
        render("garnet-depth.toml", {"--explain", "-o", file("picture.png"), "--tolerance", "0.1"});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_TRUE(nothing_was_written());
}

TEST_F(RenderPlan, ExplainsAsJson) {
    const ProgramRun run =
        render("tourmaline-across.toml", {"--explain", "--json", file("plan.json")});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_THAT(run.out, HasSubstr("pleochroism        on:"));
    const nlohmann::json plan = json("plan.json");
    EXPECT_EQ(plan["schema"], 1);
    EXPECT_EQ(plan["tolerance"], 0.05);
    ASSERT_EQ(plan["items"].size(), k_lines.size());
    for (std::size_t i = 0; i < k_lines.size(); ++i) {
        const nlohmann::json& item = plan["items"][i];
        EXPECT_EQ(item["name"], k_lines[i]);
        EXPECT_TRUE(item["on"].is_boolean());
        EXPECT_FALSE(item["why"].get<std::string>().empty()) << item;
        EXPECT_TRUE(item["error_bound"].is_number()) << item;
        EXPECT_TRUE(item["error_bound_deltaE00"].is_number()) << item;
        EXPECT_GT(item["seconds_with"], 0) << item;
        EXPECT_GT(item["seconds_without"], 0) << item;
    }
    EXPECT_TRUE(item_of(plan, "pleochroism")["on"]);
    EXPECT_GT(item_of(plan, "pleochroism")["matters"], 0);
    for (const char* key : {"engine", "engine_why", "error_bound", "error_bound_deltaE00",
                            "seconds", "seconds_everything", "seconds_planning", "samples"})
        EXPECT_TRUE(plan.contains(key)) << key;
    const ProgramRun alone = render("tourmaline-across.toml", {"--explain", "--json", "-"});
    EXPECT_EQ(alone.exit_code, 0);
    ASSERT_TRUE(nlohmann::json::accept(alone.out)) << alone.out;
    EXPECT_EQ(nlohmann::json::parse(alone.out)["items"].size(), k_lines.size());
}

TEST_F(RenderPlan, ExplainsWhatIsSwitchedOffByHand) {
    const ProgramRun run =
        render("zircon-doubling.toml", {"--explain", "--effects", "none", "--json", "-"});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    const nlohmann::json plan = nlohmann::json::parse(run.out);
    const nlohmann::json split = item_of(plan, "birefringence");
    EXPECT_FALSE(split["on"]);
    EXPECT_THAT(split["why"].get<std::string>(), HasSubstr("switched off by the scene"));
    EXPECT_GT(split["error_bound"], 0.05);
    EXPECT_GE(plan["error_bound"], split["matters"]);
    EXPECT_THAT(item_of(plan, "absorption")["why"].get<std::string>(), HasSubstr("clear"));
}

TEST_F(RenderPlan, VerifiesAPicture) {
    const ProgramRun run = render("garnet-depth.toml", {"-o", file("picture.png"), "--verify",
                                                        "--stats", file("stats.json")});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(run.out, "");
    EXPECT_THAT(run.err, HasSubstr("measured error"));
    EXPECT_THAT(run.err, HasSubstr("error bound"));
    EXPECT_TRUE(fs::exists(folder_ / "picture.png"));
    const nlohmann::json found = json("stats.json")["verification"];
    EXPECT_TRUE(found["holds"]);
    EXPECT_GT(found["pixels"], 0);
    EXPECT_GE(found["measured"], 0);
    // As far as 128 pixels can tell (Verification::holds).
    EXPECT_LE(found["measured"].get<double>() - 3 * found["spread"].get<double>() -
                  found["noise"].get<double>(),
              found["error_bound"]);
    EXPECT_GT(found["deltaE00"], 0);
    EXPECT_EQ(json("stats.json")["plan"]["items"].size(), k_lines.size());
}

TEST_F(RenderPlan, AVerificationThatFailsIsToldByTheExitCode) {
    // Without the split, on which this scene depends: the picture is written, but not to be
    // trusted. It is larger than the others so that noise cannot change the verdict.
    const ProgramRun run = render(
        "zircon-doubling.toml", {"-o", file("picture.png"), "--verify", "--effects", "none",
                                 "--stats", file("stats.json"), "--set", "camera.size=[128,128]"});
    EXPECT_EQ(run.exit_code, 1) << run.err;
    EXPECT_THAT(run.err, HasSubstr("error bound"));
    EXPECT_TRUE(fs::exists(folder_ / "picture.png"));
    EXPECT_FALSE(json("stats.json")["verification"]["holds"]);
}

TEST_F(RenderPlan, StatsHaveNoVerificationUnlessAsked) {
    const ProgramRun run = render("garnet-depth.toml", {"-o", file("picture.png"), "--stats", "-"});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_THAT(run.err, Not(HasSubstr("measured error")));
    EXPECT_FALSE(nlohmann::json::parse(run.out).contains("verification"));
}

// The plan in STATS.json is complete: it gives the same picture, byte for byte.
TEST_F(RenderPlan, APlanThatWasKeptDrawsTheSamePicture) {
    for (const std::string scene : {"garnet-depth.toml", "tourmaline-across.toml"}) {
        ASSERT_EQ(render(scene, {"-o", file("first.exr"), "--stats", file("first.json"),
                                 "--tolerance", "0.2"})
                      .exit_code,
                  0);
        const ProgramRun again = render(scene, {"-o", file("again.exr"), "--stats",
                                                file("again.json"), "--plan", file("first.json")});
        EXPECT_EQ(again.exit_code, 0) << again.err;
        EXPECT_EQ(text("again.exr"), text("first.exr"));
        EXPECT_EQ(json("again.json")["error_bound"], json("first.json")["error_bound"]);
        EXPECT_EQ(json("again.json")["checked_pixels"], 0);
    }
}

TEST_F(RenderPlan, APlanOfAnotherStoneIsRefused) {
    ASSERT_EQ(
        render("garnet-depth.toml", {"--stats", file("plan.json"), "--tolerance", "0.2"}).exit_code,
        0);
    const auto refused = [&](const std::string& scene, std::vector<std::string> more,
                             const std::string& why) {
        more.insert(more.end(), {"-o", file("picture.png")});
        const ProgramRun run = render(scene, std::move(more));
        EXPECT_EQ(run.exit_code, 2) << why;
        EXPECT_THAT(run.err, HasSubstr(why));
        EXPECT_FALSE(fs::exists(folder_ / "picture.png"));
    };
    refused("zircon-doubling.toml", {"--plan", file("plan.json")}, "of another stone");
    refused("garnet-depth.toml", {"--plan", file("nowhere.json")}, "no such file");
    refused("garnet-depth.toml", {"--plan", file("plan.json"), "--tolerance", "0.1"}, "excludes");
    refused("garnet-depth.toml", {"--plan", file("plan.json"), "--set", "render.samples=3"},
            "leave out --set render");
    write("text.json", "{\"plan\": ");
    refused("garnet-depth.toml", {"--plan", file("text.json")}, "is not JSON");
    write("empty.json", "{\"plan\": {\"settings\": 3}}");
    refused("garnet-depth.toml", {"--plan", file("empty.json")}, "has no plan");
}

TEST_F(RenderPlan, ATurntableIsPlannedAndCheckedOnce) {
    const ProgramRun run =
        render("garnet-depth.toml", {"-o", file("frame-###.png"), "--frames", "3", "--turn", "90",
                                     "--tolerance", "0.2", "--stats", file("stats.json")});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_THAT(run.err, HasSubstr("first of 3 frames"));
    EXPECT_NE(text("frame-001.png"), text("frame-002.png"));
    EXPECT_NE(text("frame-002.png"), text("frame-003.png"));
    EXPECT_FALSE(fs::exists(folder_ / "frame-004.png"));
    EXPECT_GT(json("stats.json")["checked_pixels"], 0);
    const ProgramRun unnumbered =
        render("garnet-depth.toml", {"-o", file("frame.png"), "--frames", "3"});
    EXPECT_EQ(unnumbered.exit_code, 2);
    EXPECT_THAT(unnumbered.err, HasSubstr("frame-####.png"));
}

// A stand-in for ffmpeg records its arguments.
TEST_F(RenderPlan, AFilmIsMadeByFfmpegOrRefused) {
    const std::string before = std::getenv("PATH");
    const auto film = [&](const std::string& path) {
        setenv("PATH", path.c_str(), 1);
        const ProgramRun run = render(
            "garnet-depth.toml", {"-o", file("turn.mp4"), "--frames", "2", "--tolerance", "0.2"});
        setenv("PATH", before.c_str(), 1);
        return run;
    };
    const ProgramRun without = film("/nowhere");
    EXPECT_EQ(without.exit_code, 2);
    EXPECT_THAT(without.err, HasSubstr("ffmpeg"));
    EXPECT_TRUE(nothing_was_written());

    fs::create_directory(folder_ / "bin");
    const auto pretend = [&](const std::string& script) {
        std::ofstream(folder_ / "bin/ffmpeg") << "#!/bin/sh\n" << script;
        fs::permissions(folder_ / "bin/ffmpeg", fs::perms::owner_all);
        return film(file("bin") + ":" + before);
    };
    // The last word is the film's path; the word after -i names the pictures.
    const ProgramRun with = pretend(
        "for word; do last=$word; done\n"
        "while [ \"$1\" != -i ]; do shift; done\n"
        "ls $(dirname \"$2\") > \"$last\"\n");
    EXPECT_EQ(with.exit_code, 0) << with.err;
    EXPECT_EQ(text("turn.mp4"), "ffmpeg.txt\nframe-00001.png\nframe-00002.png\n");
    fs::remove(folder_ / "turn.mp4");
    const ProgramRun failing = pretend("echo no encoder >&2; exit 1\n");
    EXPECT_EQ(failing.exit_code, 2);
    EXPECT_THAT(failing.err, HasSubstr("no encoder"));
    EXPECT_FALSE(fs::exists(folder_ / "turn.mp4"));
}

TEST_F(RenderPlan, RefusesInOneLineAndWritesNothing) {
    const auto refused = [&](const std::string& scene, std::vector<std::string> more,
                             const std::string& why) {
        EXPECT_THAT(refusal_of(render(scene, std::move(more))), HasSubstr(why));
        EXPECT_TRUE(nothing_was_written()) << why;
    };
    const std::string scene = "garnet-depth.toml";
    const std::string picture = file("picture.png"), stats = file("stats.json");
    refused("none.toml", {"--explain"}, "none.toml");
    refused(scene, {"--explain", "--effects", "fire"}, "no effect \"fire\"");
    refused(scene, {"--explain", "--tolerance", "-0.1"}, "tolerance");
    refused(scene, {"--explain", "--tolerance", "nan"}, "tolerance");
    refused(scene, {"--explain", "--depth", "-1"}, "depth");
    refused(scene, {"--explain", "--engine", "warp"}, "no engine \"warp\"");
    refused(scene, {"--explain", "--json", file("nowhere/plan.json")}, "nowhere");
    refused(scene, {"--verify"}, "-o IMAGE");
    refused(scene, {"--verify", "-o", file("picture.bmp")}, ".exr, .png or .hdr");
    refused(scene, {"--verify", "-o", file("nowhere/picture.png")}, "nowhere");
    refused(scene, {"--verify", "-o", picture, "--stats", file("nowhere/s.json")}, "nowhere");
    refused(scene, {"--verify", "-o", picture, "--stats", stats, "--set", "camera.size=[0,0]"},
            "size");
    refused(scene, {"--verify", "-o", picture, "--stats", stats, "--effects", "all,fire"},
            "no effect");
    refused("zircon-doubling.toml",
            {"--verify", "-o", picture, "--stats", stats, "--set", "camera.position=[0.1,0,0.5]"},
            "inside the stone");
}

}  // namespace
}  // namespace culet
