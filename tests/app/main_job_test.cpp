// The commands of the main job as a user runs them: exit codes, files, streams, repeatability.

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

const fs::path k_samples = fs::path(CULET_SOURCE_DIR) / "samples";

class MainJob : public test::ProgramTest {
protected:
    std::string scene_with_objects() const {
        write("objects.toml",
              "[camera]\nposition = [0, -9, 5]\nlook_at = [0, 0, 0]\nsize = [16, 16]\n"
              "[light]\nconstant = 1\n[[object]]\nshape = \"sphere\"\nradius = 1\n"
              "material = { kind = \"diffuse\" }\n");
        return file("objects.toml");
    }
    std::string small_scene() const {
        std::string scene = text((k_samples / "dravite-step/scene.toml").string());
        const auto replace = [&scene](const std::string& from, const std::string& to) {
            const std::size_t at = scene.find(from);
            ASSERT_NE(at, std::string::npos) << from;
            scene.replace(at, from.size(), to);
        };
        replace("\"stone.toml\"", "\"" + (k_samples / "dravite-step/stone.toml").string() + "\"");
        replace("[480, 400]", "[120, 100]");
        replace("[render]", "[render]\nsamples = 1");
        std::ofstream(file("scene.toml")) << scene;
        return file("scene.toml");
    }
};

TEST_F(MainJob, FitRenderAndCompareEndInOneReport) {
    std::ofstream(file("job.toml"))
        << "[fit]\nstone = \"" << (k_samples / "dravite-step/stone.toml").string()
        << "\"\n[render]\nscene = \"" << small_scene() << "\"\n[compare]\nphoto = \""
        << (k_samples / "dravite-step/simulated-photo.png").string()
        << "\"\nsimulated = true\nstart = true\n";
    const ProgramRun run = run_culet({"run", file("job.toml"), "-o", file("out"), "-q"});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(run.out, file("out/report.html") + "\n");
    for (const char* name : {"fitted.obj", "fit.json", "render.exr", "render.png", "start.png",
                             "stats.json", "scores.json"}) {
        EXPECT_TRUE(fs::exists(folder_ / "out" / name)) << name;
    }
    const auto fit = json("out/fit.json");
    EXPECT_EQ(fit.at("status"), "converged");
    EXPECT_TRUE(fit.at("closed"));
    EXPECT_TRUE(fit.at("convex"));
    EXPECT_EQ(fit.at("facets").size(), 57u);
    const auto stats = json("out/stats.json");
    for (const char* key :
         {"engine", "depth", "effects", "error_bound", "remainder", "seconds", "beams", "rays"}) {
        EXPECT_TRUE(stats.contains(key)) << key;
    }
    const std::string page = text(file("out/report.html"));
    EXPECT_NE(page.find("imulated photograph"), std::string::npos);
    EXPECT_EQ(page.find("src=\"http"), std::string::npos);
    for (const auto& entry : fs::directory_iterator(folder_ / "out")) {
        EXPECT_NE(entry.path().filename().string()[0], '.') << entry.path();
    }
}

TEST_F(MainJob, ExactMeetsContradictTheReadingsOfARealStone) {
    // Its eight pavilion mains do not meet in a point: samples/real-brilliant/README.md.
    const ProgramRun run =
        run_culet({"fit", (k_samples / "real-brilliant/stone.toml").string(), "-o",
                   file("exact.obj"), "--report", file("exact.json"), "--set", "fit.meets=exact"});
    EXPECT_EQ(run.exit_code, 1);
    EXPECT_EQ(json("exact.json").at("status"), "contradictory");
    EXPECT_TRUE(fs::exists(file("exact.obj"))) << "the outputs are written and say why";
}

TEST_F(MainJob, SamePictureForAnyNumberOfThreads) {
    const std::string scene = small_scene();
    for (const char* threads : {"1", "2"}) {
        const ProgramRun run =
            run_culet({"render", scene, "-o", file(std::string("t").append(threads).append(".exr")),
                       "--threads", threads, "-q"});
        EXPECT_EQ(run.exit_code, 0) << run.err;
        EXPECT_TRUE(run.err.empty()) << run.err;
    }
    EXPECT_EQ(text(file("t1.exr")), text(file("t2.exr")));
}

TEST_F(MainJob, WhatCannotBeDoneIsOneLineAndLeavesNothing) {
    const std::string stone = (k_samples / "real-brilliant/stone.toml").string();
    write("old.obj", "kept");
    const std::vector<std::vector<std::string>> cases{
        {"bogus"},
        {"fit"},
        {"fit", file("missing.toml"), "-o", file("old.obj")},
        {"fit", stone, "-o", file("no/folder.obj")},
        {"fit", stone, "-o", file("old.obj"), "--report", file("no/folder.json")},
        {"fit", stone, "-o", file("old.obj"), "--set", "stone.unit=parsec"},
        {"render", small_scene(), "-o", file("a.gif")},
        {"render", small_scene(), "-o", file("a.png"), "--set", "camera.fov=-1"},
        {"render", small_scene(), "-o", file("a.png"), "--engine", "warp"},
        {"render", scene_with_objects(), "--explain"},
        {"render", scene_with_objects(), "-o", file("a.png"), "--verify"},
        {"render", scene_with_objects(), "-o", file("a.png"), "--engine", "beams"},
        {"run", file("missing.toml"), "-o", file("out")},
        {"cut", "round-brilliant"},
        {"cut", "round-brilliant", "-o", file("a.obj"), "--json", file("no/folder.json")},
        {"probe", small_scene()},
        {"probe", small_scene(), "--pixel", "1;2"},
        {"compare", file("missing.png"), file("missing.exr"), "-o", file("cmp")},
        {"compare", file("missing.png"), "-o", file("cmp")},
        {"compare", file("a.png"), file("b.png"), file("c.exr"), "-o", file("cmp")},
        {"compare", file("a.png"), file("c.exr"), "-o", file("cmp"), "--calibrate"},
        {"compare", file("missing.png"), small_scene(), "-o", file("cmp"), "--calibrate"},
        {"compare", file("missing.png"), small_scene(), "-o", file("cmp"), "--draws", "1"},
    };
    for (const auto& words : cases) refusal(words);
    EXPECT_EQ(text(file("old.obj")), "kept");
    for (const char* name : {"a.gif", "a.png", "a.obj", "out", "cmp"})
        EXPECT_FALSE(fs::exists(file(name))) << name;
}

TEST_F(MainJob, HelpAndVersionAreGood) {
    EXPECT_EQ(run_culet({"--version"}).exit_code, 0);
    for (const char* command :
         {"fit", "render", "compare", "run", "probe", "cut", "convert", "info"}) {
        const ProgramRun help = run_culet({command, "--help"});
        EXPECT_EQ(help.exit_code, 0) << command;
        EXPECT_NE(help.out.find("Examples:"), std::string::npos) << command;
    }
}

}  // namespace
}  // namespace culet
