// culet register as a user runs it: a photograph drawn by culet from another camera than the
// scene's.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/app/program_test.h"

namespace culet {
namespace {

namespace fs = std::filesystem;
using test::ProgramRun;
using test::run_culet;

class Register : public test::ProgramTest {
protected:
    Register() {
        cut("round-brilliant", "stone.obj");
        write("truth.toml", scene("[6.8, 3.1, 39.3]", "[0.1, 1, 0]"));
        write("start.toml", scene("[-2, 9, 44]", "[-0.15, 1, 0]"));
        EXPECT_EQ(
            run_culet({"render", file("truth.toml"), "-o", file("photo.png"), "-q"}).exit_code, 0);
    }
    static std::string scene(const std::string& position, const std::string& up) {
        return "# where the camera is about\nmesh = \"stone.obj\"\nmaterial = "
               "\"diamond\"\n[camera]\n"
               "position = " +
               position + "\nlook_at = [0, 0, -0.5]\nup = " + up +
               "\nfov = 13\nsize = [300, 300]\n"
               "[[light.hemisphere]]\ndirection = [0, 0, 1]\nradiance = 0.6\n"
               "[[light.hemisphere]]\ndirection = [0, 0, -1]\nradiance = 0.15\n"
               "[[light.lobe]]\ndirection = [0.4, 0.2, 1]\nexponent = 3\nradiance = 0.8\n"
               "[render]\nengine = \"beams\"\ntolerance = 0.05\n";
    }
};

TEST_F(Register, WritesASceneThatRendersAtOnce) {
    fs::create_directory(folder_ / "out");
    const ProgramRun run = run_culet({"register", file("photo.png"), file("start.toml"), "-o",
                                      file("out/posed.toml"), "--overlay", file("out/overlay.png"),
                                      "--json", "-", "--within-deg", "2", "--within-px", "2"});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    const auto pose = nlohmann::json::parse(run.out);
    EXPECT_EQ(pose.at("schema"), 1);
    EXPECT_EQ(pose.at("status"), "found");
    EXPECT_EQ(pose.at("mirrored"), false);
    // The position of the stone's middle and its size follow from the true camera: both look at a
    // point of the axis from 40 away.
    const auto position = pose.at("camera").at("position").get<std::vector<double>>();
    const double tilt = std::atan2(std::hypot(position[0], position[1]), position[2] + 0.5);
    EXPECT_NEAR(tilt, std::atan2(std::hypot(6.8, 3.1), 39.8), 0.01);
    EXPECT_EQ(text(file("out/overlay.png")).substr(1, 3), "PNG");
    // The mesh's path is relative to the new folder; the rest of the scene stays.
    EXPECT_NE(text(file("out/posed.toml")).find("../stone.obj"), std::string::npos);
    EXPECT_EQ(
        run_culet({"render", file("out/posed.toml"), "-o", file("out/again.png"), "-q"}).exit_code,
        0);
    const ProgramRun compared = run_culet({"compare", file("photo.png"), file("out/again.png"),
                                           "-o", file("out/report"), "--json", "-", "-q"});
    EXPECT_EQ(compared.exit_code, 0) << compared.err;
    EXPECT_GT(nlohmann::json::parse(compared.out).at("registration").at("iou"), 0.99);
}

TEST_F(Register, RefusesWithItsOutputsWritten) {
    cut("trillion", "stone.obj");
    const ProgramRun run =
        run_culet({"register", file("photo.png"), file("start.toml"), "-o", file("posed.toml"),
                   "--overlay", file("overlay.png"), "--json", file("pose.json")});
    EXPECT_EQ(run.exit_code, 1);
    EXPECT_NE(run.err.find("refused: "), std::string::npos) << run.err;
    const auto pose = json("pose.json");
    EXPECT_EQ(pose.at("status"), "refused");
    const std::string remedy = pose.at("remedy").get<std::string>() + ".\n";
    ASSERT_GT(remedy.size(), 20u);
    EXPECT_EQ(run.err.substr(run.err.size() - remedy.size()), remedy) << run.err;
    EXPECT_TRUE(fs::exists(file("posed.toml")) && fs::exists(file("overlay.png")));
}

TEST_F(Register, LeavesNothingBehindWhenItCannot) {
    const std::vector<std::vector<std::string>> calls{
        {"register", file("none.png"), file("start.toml"), "-o", file("posed.toml")},
        {"register", file("photo.png"), file("none.toml"), "-o", file("posed.toml")},
        {"register", file("photo.png"), file("start.toml"), "-o", file("posed.toml"), "--overlay",
         file("no/such/folder.png")},
        {"register", file("photo.png"), file("start.toml"), "-o", file("posed.toml"), "--set",
         "camera.principal_point=[1]"},
        {"register", file("photo.png"), file("start.toml"), "-o", file("posed.toml"),
         "--within-deg", "0"}};
    for (const auto& call : calls) {
        refusal(call);
        EXPECT_FALSE(fs::exists(file("posed.toml")));
    }
}

}  // namespace
}  // namespace culet
