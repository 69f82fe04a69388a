// SIGTERM while culet works: how soon it ends, its exit code, and what it leaves behind.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "compare/photo/photo.h"
#include "render/image/image_io.h"
#include "tests/app/program_test.h"
#include "tests/compare/light_probe/simulated_ball.h"

namespace culet {
namespace {

namespace fs = std::filesystem;
using test::ProgramRun;
using test::run_culet;
using ::testing::HasSubstr;

// A loop checks at least every 0.1 s of its processor time. Two threads may both just have checked
// when the signal comes, and the shutdown itself (freeing memory, the last lines) takes as long
// again.
constexpr double k_soon = 3 * 0.1;
// Exact beams of a large picture are sorted and freed without checks: 0.34 s was measured.
constexpr double k_soon_beams = 0.3 + k_soon;

class Interrupt : public test::ProgramTest {
protected:
    void SetUp() override {
        cut("round-brilliant", "stone.obj");
        // Flat (not run-length) scanlines of red, green, blue and an exponent: grey 1 (128 x 2^-7)
        // with a lamp of 2^14 in one texel.
        constexpr int k_width = 2048, k_height = 1024;
        std::string texels;
        for (int i = 0; i < k_width * k_height; ++i)
            texels += i == k_width * 300 + 700 ? "\x80\x80\x80\x8f" : "\x80\x80\x80\x81";
        write("map.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1024 +X 2048\n" + texels);
        write("scene.toml", scene("preset = \"jeweller\"", "diamond"));
        write("map.toml", scene("environment = \"map.hdr\"", "diamond"));
        write("crystal.toml", scene("preset = \"jeweller\"", "zircon_blue"));
    }
    static std::string scene(const std::string& light, const std::string& material) {
        return "mesh = \"stone.obj\"\nmaterial = \"" + material +
               "\"\n[camera]\nposition = [0, 0, 40]\nlook_at = [0, 0, 0]\nfov = 12\n"
               "size = [1600, 1600]\n[light]\n" +
               light + "\n";
    }
    std::size_t files() const {
        return static_cast<std::size_t>(std::distance(
            fs::recursive_directory_iterator(folder_.path()), fs::recursive_directory_iterator()));
    }
    void expect_soon(std::vector<std::string> arguments, double stop_at,
                     double soon = k_soon) const {
        SCOPED_TRACE(testing::PrintToString(arguments));
        arguments.insert(arguments.end(), {"--threads", "2"});
        const std::size_t before = files();
        const ProgramRun run = run_culet(arguments, stop_at);
        EXPECT_EQ(run.exit_code, 130) << run.err;
        EXPECT_THAT(run.err, HasSubstr("interrupted; nothing was written"));
        EXPECT_LT(run.cpu_after_stop, soon);
        EXPECT_EQ(files(), before);
    }
};

TEST_F(Interrupt, EveryEngineEndsSoon) {
    for (const std::string engine :
         {"reference", "beams", "preview", "flat", "gouraud", "phong", "whitted"}) {
        const std::string samples = engine == "reference" || engine == "beams" ? "16" : "400";
        expect_soon(
            {"render", file("scene.toml"), "-o", file("picture.exr"), "--engine", engine,
             "--tolerance", "1e-5", "--check", "none", "--set", "render.samples=" + samples},
            0.6, engine == "beams" ? k_soon_beams : k_soon);
    }
    expect_soon({"render", file("scene.toml"), "-o", file("picture.exr"), "--engine", "raytable",
                 "--table", file("table.rays")},
                0.6);
}

TEST_F(Interrupt, WhatIsPlannedEndsSoon) {
    for (const std::string scene : {"scene.toml", "map.toml", "crystal.toml"}) {
        for (const double stop_at : {0.4, 1.0, 3.0}) {
            // Takes half a minute: no picture is finished before the last stop.
            expect_soon({"render", file(scene), "-o", file("picture.exr"), "--set",
                         "camera.size=[400,400]", "--tolerance", "0.003"},
                        stop_at);
        }
    }
}

// 660 facets that all touch a sphere of radius 1, each tier's angle read once.
TEST_F(Interrupt, AFitOfManyFacetsEndsSoon) {
    constexpr int k_teeth = 60;
    std::string design = fmt::format("GemCad 5.0\ng {} 0.0\ny 1 n\nI 1.54\n", k_teeth);
    std::string readings = "kind,of,value,sigma\ndepth,,2.025,0.001\nwidth,0,2.003,0.001\n";
    char tier = 'A';
    for (const int angle : {-88, -80, -72, -64, -56, -48, -40, 90, 75, 60, 45}) {
        design += fmt::format("a {} 1.0", angle);
        for (int i = 0; i < k_teeth; ++i)
            design += fmt::format(" {:g}", i + 1 - 0.5 * ((tier - 'A') % 2));
        design += fmt::format(" n {}\n", tier);
        readings += fmt::format("inclination,{}*,{},0.1\n", tier++, std::abs(angle));
    }
    write("ball.asc", design + "a 0.0 0.72 1 n T\n");
    write("ball.csv", readings);
    write("ball.toml",
          "[stone]\nmesh = \"ball.asc\"\nmaterial = \"quartz\"\nup = \"T\"\n"
          "readings = \"ball.csv\"\n");
    for (const double stop_at : {0.1, 0.5, 1.0, 2.0})
        expect_soon({"fit", file("ball.toml"), "-o", file("fitted.obj")}, stop_at);
    for (const double stop_at : {0.2, 1.0, 2.0})
        expect_soon({"grade", file("ball.asc"), "--json", file("grade.json")}, stop_at);
}

TEST_F(Interrupt, AGradeOfManyTiltsEndsSoon) {
    for (const double stop_at : {0.2, 1.0})
        expect_soon({"grade", file("stone.obj"), "--material", "diamond", "--tilts", "-30:30:0.2",
                     "--json", file("grade.json")},
                    stop_at);
}

// The best design so far is written.
TEST_F(Interrupt, AnOptimisationEndsSoon) {
    for (const double stop_at : {0.3, 1.0}) {
        const ProgramRun run = run_culet({"optimize", file("stone.obj"), "--material", "diamond",
                                          "-o", file("better.asc"), "--threads", "2"},
                                         stop_at);
        EXPECT_EQ(run.exit_code, 130) << run.err;
        EXPECT_LT(run.cpu_after_stop, k_soon);
    }
}

TEST_F(Interrupt, TheLightOfALargeBallEndsSoon) {
    simulated::BallShot shot;
    shot.width = shot.height = 1200;
    shot.centre_x = shot.centre_y = 599.5;
    shot.radius = 560;
    shot.samples = 1;
    const Photo photo = simulated::take(shot, simulated::room(5)).photo;
    Picture picture;
    picture.width = photo.width;
    picture.height = photo.height;
    picture.rgb = photo.rgb;
    write_picture(picture, folder_ / "ball.exr");
    for (const double stop_at : {0.4, 1.0, 3.0})
        expect_soon({"light", file("ball.exr"), "-o", file("room.exr")}, stop_at);
}

TEST_F(Interrupt, ACrystalsPreviewEndsSoon) {
    expect_soon({"render", file("crystal.toml"), "-o", file("picture.exr"), "--engine", "preview"},
                0.6);
}

}  // namespace
}  // namespace culet
