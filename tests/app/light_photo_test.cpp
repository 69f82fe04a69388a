// culet photo, light and camera as a user runs them: files, exit codes, one line for bad input.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

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

class LightAndPhoto : public test::ProgramTest {
protected:
    using ProgramTest::write;
    std::string write(const Photo& photo, const std::string& name) const {
        Picture picture;
        picture.width = photo.width;
        picture.height = photo.height;
        picture.rgb = photo.rgb;
        write_picture(picture, folder_ / name);
        return file(name);
    }
    std::string ball(double azimuth, const std::string& name) const {
        simulated::BallShot shot;
        shot.width = 180;
        shot.height = 150;
        shot.radius = 60;
        shot.centre_x = 91;
        shot.centre_y = 74;
        shot.distance = 25;
        shot.samples = 2;
        shot.world_from_camera = simulated::camera_at(azimuth, 0);
        return write(simulated::take(shot, simulated::room(5)).photo, name);
    }
    std::string flat(const std::string& name, float value, int width = 180,
                     int height = 150) const {
        Photo photo;
        photo.width = width;
        photo.height = height;
        photo.rgb.assign(3 * static_cast<std::size_t>(width) * height, value);
        return write(photo, name);
    }
    static void expect_refused(const std::vector<std::string>& words, const std::string& about) {
        EXPECT_THAT(refusal(words), HasSubstr(about));
    }
};

TEST_F(LightAndPhoto, TwoBallsBecomeAnEnvironmentThatTheRendererReads) {
    const std::string first = ball(0, "a.exr"), second = ball(1.6, "b.exr");
    const ProgramRun run = run_culet({"light",
                                      first,
                                      second,
                                      "-o",
                                      file("env.exr"),
                                      "--cube",
                                      file("cube.exr"),
                                      "--picture",
                                      file("seen.png"),
                                      "--json",
                                      "-",
                                      "--distance",
                                      "25",
                                      "--reflectance",
                                      "0.6",
                                      "--width",
                                      "64",
                                      "--sharpen",
                                      "2",
                                      "-q"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_TRUE(run.err.empty()) << run.err;
    const auto json = nlohmann::json::parse(run.out);
    EXPECT_EQ(json.at("status"), "good");
    EXPECT_NEAR(json.at("views").at(1).at("turned_deg").get<double>(), 91.7, 1.5);
    const Photo environment = read_photo(file("env.exr")), cube = read_photo(file("cube.exr"));
    EXPECT_EQ(environment.width, 64);
    EXPECT_EQ(environment.height, 32);
    EXPECT_EQ(cube.width, 16);
    EXPECT_EQ(cube.height, 96);
    EXPECT_TRUE(fs::exists(folder_ / "seen.png"));
    for (const char* map : {"env.exr", "cube.exr"}) {
        std::ofstream(file("scene.toml"))
            << "material = \"diamond\"\nmesh = \"cut.obj\"\n[light]\nenvironment = \"" << map
            << "\"\n[camera]\nsize = [16, 16]\n";
        cut("round-brilliant", "cut.obj");
        const ProgramRun info = run_culet({"info", file("scene.toml")});
        EXPECT_EQ(info.exit_code, 0) << map << info.err;
    }
}

// A window 9 radii away from a ball of 10 mm radius; the camera's file replaces its distance.
TEST_F(LightAndPhoto, ANearWindowBecomesAPlaneOfTheScene) {
    const Vec3 middle{-9, 2, 1}, u{0, 1.5, 0}, v{0, 0, 1};
    simulated::BallShot shot;
    shot.width = 620;
    shot.height = 180;
    shot.radius = 60;
    shot.centre_x = 100;
    shot.centre_y = 90;
    shot.distance = 25;
    shot.samples = 2;
    shot.world_from_camera = simulated::camera_at(0, 0);
    shot.near = [&](const Vec3& from, const Vec3& direction) -> std::optional<Rgb> {
        const double t = (middle.x - from.x) / direction.x;
        const Vec3 at = from + t * direction - middle;
        if (!(t > 0) || std::abs(at.y) > u.y || std::abs(at.z) > v.z) return std::nullopt;
        return Rgb{7, 7, 7};
    };
    const auto dim = [](const Vec3& d) { return Rgb{0.3, 0.3, 0.3 + 0.1 * d.z}; };
    const double focal = 60 * std::sqrt(25.0 * 25 - 1);
    const simulated::Taken first = simulated::take(shot, dim);
    const std::string here = write(first.photo, "here.exr");
    // Moved to the right by 240 pixels, 4 radii: the same distance to a thousandth.
    simulated::BallShot beside = shot;
    beside.centre_x = 340;
    const Vec3 ray((100 - 309.5) / focal, 0, -1), other((340 - 309.5) / focal, 0, -1);
    const Vec3 moved = 25.0 * (glm::normalize(other) - glm::normalize(ray));
    beside.place = shot.world_from_camera * moved;
    const simulated::Taken second = simulated::take(beside, dim);
    const std::string there = write(second.photo, "there.exr");
    const auto outline = [](const simulated::Taken& t) {
        return std::to_string(t.x) + "," + std::to_string(t.y) + "," + std::to_string(t.radius);
    };
    std::ofstream(file("lens.toml"))
        << "[lens]\nsize = [620, 180]\nfocal_px = [" << focal << ", " << focal
        << "]\nprincipal_px = [309.5, 89.5]\ndistortion = [0, 0, 0, 0, 0]\n";
    const std::vector<std::string> words{"light",
                                         here,
                                         there,
                                         "--moved",
                                         "--camera",
                                         file("lens.toml"),
                                         "--ball-radius",
                                         "10",
                                         "--reflectance",
                                         "0.6",
                                         "--ball",
                                         outline(first),
                                         "--ball",
                                         outline(second),
                                         "--width",
                                         "64",
                                         "--sharpen",
                                         "2",
                                         "-o",
                                         file("room.exr"),
                                         "--table",
                                         file("light.toml"),
                                         "--json",
                                         "-",
                                         "-q"};
    std::vector<std::string> near = words;
    // From the ball the window is 20 degrees to the left of the camera and 6 above it: the sine of
    // half of that, times 60 pixels.
    near.insert(near.end(), {"--near", "89,87"});
    const ProgramRun run = run_culet(near);
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const auto json = nlohmann::json::parse(run.out);
    const auto& light = json.at("near_lights").at(0);
    EXPECT_EQ(light.at("from"), "parallax");
    // Outlines to 0.15 pixels of 60, doubled by the reflection, seen 4 radii apart.
    const double bound = 92.0 * 9.2 / 4 * std::sqrt(2.0) * 2 * 0.15 / 60;
    EXPECT_NEAR(light.at("distance").get<double>(), 10 * glm::length(middle), 3 * bound);
    EXPECT_NEAR(light.at("radiance").at(0).get<double>(), 7, 0.05);

    cut("round-brilliant", "cut.obj");
    std::ofstream(file("scene.toml"))
        << "material = \"diamond\"\nmesh = \"cut.obj\"\n"
        << std::ifstream(file("light.toml")).rdbuf() << "[camera]\nsize = [16, 16]\n";
    const ProgramRun info = run_culet({"info", file("scene.toml")});
    EXPECT_EQ(info.exit_code, 0) << info.err;

    const auto refused = [&](const std::vector<std::string>& more, const std::string& about) {
        std::vector<std::string> all = words;
        all.insert(all.end(), more.begin(), more.end());
        expect_refused(all, about);
    };
    refused({"--near", "95"}, "X,Y,X2,Y2");
    refused({"--near", "89,87,1"}, "X,Y,X2,Y2");
    refused({"--near", "89,87", "--near-distance", "5"}, "outside the ball");
    refused({"--near-distance", "50"}, "0 lights");
    refused({"--near-window", "1,2,3"}, "half its width");
    refused({"--near-window", "-90,0,0,0,1,0,0,1,0"}, "right angles");
    refused({"--near-window", "-90,0,0,1,0,0,0,0,1"}, "through the ball");
    refused({"--near", "100,50"}, "pixel 100,50 shows no light");
    refused({"--turned", "90"}, "stands still");
    const std::string env = file("none.exr");
    expect_refused({"light", here, "-o", env, "--near", "89,87"}, "--table");
    expect_refused({"light", here, "-o", env, "--near", "89,87", "--table", file("l.toml"),
                    "--ball", "100,90,60"},
                   "--ball-radius");
    expect_refused({"light", here, "-o", env, "--camera", file("missing.toml")}, "no such file");
    EXPECT_FALSE(fs::exists(env));
}

TEST_F(LightAndPhoto, BadBallsAreOneLine) {
    const std::string good = ball(0, "a.exr"), empty = flat("flat.exr", 0.3f);
    const std::string env = file("env.exr");
    expect_refused({"light", "-o", env}, "name the photographs");
    expect_refused({"light", file("missing.exr"), "-o", env}, "no such file");
    write("text.jpg", "not a picture");
    expect_refused({"light", file("text.jpg"), "-o", env}, "not a picture");
    expect_refused({"light", empty, "-o", env}, "--ball X,Y,RADIUS");
    expect_refused({"light", good, "-o", env, "--ball", "170,70,60"}, "outside the picture");
    expect_refused({"light", good, "-o", env, "--ball", "1,2"}, "X,Y,RADIUS");
    expect_refused({"light", good, flat("small.exr", 0.3f, 90, 75), "-o", env}, "one camera");
    expect_refused({"light", flat("black.exr", 0), "-o", env, "--ball", "90,75,60"}, "black");
    expect_refused({"light", flat("nan.exr", std::numeric_limits<float>::quiet_NaN()), "-o", env},
                   "NaN");
    expect_refused({"light", good, good, good, "-o", env}, "--view");
    expect_refused({"light", "--view", good, ball(1.6, "b.exr"), "-o", env, "--exposure", "1,1"},
                   "same exposure");
    expect_refused({"light", good, "-o", env, "--exposure", "1/10,1/40"}, "2 values for 1");
    expect_refused({"light", good, "-o", env, "--distance", "0.5"}, "outside the ball");
    expect_refused({"light", good, "-o", env, "--reflectance", "0"}, "chrome");
    expect_refused({"light", good, "-o", file("env.png")}, ".exr or .hdr");
    expect_refused({"light", good, "-o", file("no/env.exr")}, "no folder");
    EXPECT_FALSE(fs::exists(env));
}

TEST_F(LightAndPhoto, ExposuresAreMergedAndBadOnesRefused) {
    const std::string a = flat("a.exr", 0.4f), b = flat("b.exr", 0.1f);
    const ProgramRun run = run_culet(
        {"photo", a, b, "-o", file("out.exr"), "--exposure", "1/10,1/40", "--json", "-", "-q"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(nlohmann::json::parse(run.out).at("photometric"), true);
    EXPECT_NEAR(read_photo(file("out.exr")).rgb[0], 0.4, 1e-4);
    const std::string out = file("none.exr");
    expect_refused({"photo", a, b, "-o", out}, "--exposure");
    expect_refused({"photo", a, b, "-o", out, "--exposure", "1/10,1/10"}, "same exposure");
    expect_refused({"photo", a, "-o", out, "--exposure", "soon"}, "not an exposure");
    expect_refused({"photo", a, "-o", out, "--grey", "500,0,20,20"}, "grey card");
    expect_refused({"photo", a, "-o", out, "--grey", "x"}, "X,Y,WIDTH,HEIGHT");
    expect_refused({"photo", a, "-o", out, "--chart"}, "no colour chart");
    expect_refused({"photo", a, "-o", out, "--camera", file("missing.toml")}, "no such file");
    expect_refused({"photo", a, flat("other.exr", 0.2f, 90, 75), "-o", out, "--exposure", "1,2"},
                   "one size");
    write("broken.dng", "II*");
    expect_refused({"photo", file("broken.dng"), "-o", out}, "raw file");
    expect_refused({"photo", a, "-o", file("out.png")}, ".exr");
    EXPECT_FALSE(fs::exists(out));
}

TEST_F(LightAndPhoto, ABoardIsWrittenAndPicturesWithoutItAreRefused) {
    EXPECT_EQ(run_culet({"camera", "--board", file("board.svg"), "-q"}).exit_code, 0);
    EXPECT_TRUE(fs::exists(folder_ / "board.svg"));
    const std::string a = flat("a.exr", 0.4f);
    expect_refused({"camera"}, "--board");
    expect_refused({"camera", a}, "-o CAMERA.toml");
    expect_refused({"camera", a, "-o", file("camera.toml")}, "show the board");
    expect_refused({"camera", "--board", file("board.svg"), "--columns", "1"}, "3 to 22");
    EXPECT_FALSE(fs::exists(folder_ / "camera.toml"));
}

TEST_F(LightAndPhoto, HelpHasExamples) {
    for (const char* command : {"photo", "light", "camera"}) {
        const ProgramRun help = run_culet({command, "--help"});
        EXPECT_EQ(help.exit_code, 0) << command;
        EXPECT_THAT(help.out, HasSubstr("Examples:")) << command;
    }
}

}  // namespace
}  // namespace culet
