// culet spin on simulated frames. Expectations: the outlines with which the frames were drawn.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "stone/solid_input.h"
#include "stone/text/output_file.h"
#include "tests/app/program_test.h"
#include "tests/refine/spin_frames.h"

namespace culet {
namespace {

using test::ProgramRun;
using test::run_culet;

class SpinCommand : public test::ProgramTest {
protected:
    std::string drawn(const SpinFrame& frame, const std::string& name) const {
        cv::Mat picture(frame.picture.height, frame.picture.width, CV_8UC3,
                        const_cast<std::uint8_t*>(frame.picture.rgb.data()));
        EXPECT_TRUE(cv::imwrite(file(name), picture));
        return file(name);
    }
    std::vector<std::string> written(const std::vector<SpinFrame>& frames) const {
        std::vector<std::string> files;
        for (const SpinFrame& frame : frames) files.push_back(drawn(frame, frame.name));
        return files;
    }
};

// The written mesh, by the written matrices of a frame that was used and of one that was left out,
// is as wide in the picture as the stone that was drawn, within two pixels: a small facet that is
// not found may cut off a corner.
TEST_F(SpinCommand, WritesAStoneAndItsProjections) {
    const synthetic::SpinTruth truth = synthetic::lying_step_cut(32);
    std::vector<std::string> arguments{"spin"};
    const std::vector<std::string> files = written(synthetic::frames_of(truth));
    arguments.insert(arguments.end(), files.begin(), files.end());
    arguments.insert(arguments.end(),
                     {"--hold-out", files[9], "--width", "5", "--material", "diamond", "-o",
                      file("stone.obj"), "--json", file("spin.json"), "--report", file("report")});
    const ProgramRun run = run_culet(arguments);
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(run.out, "");
    const std::string page = read_text(file("report") + "/report.html");
    for (const char* part :
         {"frame-010.png", "data:image/png;base64,", "length to width", "5.000 mm"})
        EXPECT_NE(page.find(part), std::string::npos) << part;
    const nlohmann::json found = json("spin.json");
    EXPECT_EQ(found["unit"], "mm");
    ASSERT_EQ(found["frames"].size(), 32u);
    const Solid stone = load_solid(file("stone.obj")).solid;
    EXPECT_NEAR(width_along(stone, {1, 0, 0}), 5, 1e-6);
    for (const std::size_t f : {std::size_t{4}, std::size_t{9}}) {
        const nlohmann::json& frame = found["frames"][f];
        EXPECT_EQ(frame["used"], f != 9);
        double left = 1e300, right = -1e300, least = 1e300, most = -1e300;
        for (const Vec3& v : stone.vertices) {
            const auto row = [&](int i) {
                const auto r = frame["projection"][i].get<std::vector<double>>();
                return r[0] * v.x + r[1] * v.y + r[2] * v.z + r[3];
            };
            left = std::min(left, row(0) / row(2));
            right = std::max(right, row(0) / row(2));
        }
        for (const glm::dvec2& c :
             outline_in_picture(truth.solid.vertices, truth.series.camera, truth.series.turns[f])) {
            least = std::min(least, truth.size / 2.0 + c.x);
            most = std::max(most, truth.size / 2.0 + c.x);
        }
        EXPECT_NEAR(left, least, 2) << f;
        EXPECT_NEAR(right, most, 2) << f;
    }
    // Facets of any brightness are no refracting stone's: only that it is judged is asked here.
    EXPECT_EQ(found["light"]["zones"].size(), 15u);
    ASSERT_EQ(found["comparison"]["frames"].size(), 1u);
    EXPECT_EQ(found["comparison"]["frames"][0]["file"], files[9]);
    EXPECT_THAT(run.err, testing::HasSubstr(found["comparison"]["verdict"].get<std::string>()));
}

TEST_F(SpinCommand, RefusesWhatIsNoTurnOfAStone) {
    const std::vector<SpinFrame> frames = synthetic::frames_of(synthetic::lying_step_cut(10));
    std::vector<std::string> files = written(frames);
    const auto spin = [&](std::vector<std::string> names) {
        names.insert(names.begin(), "spin");
        names.insert(names.end(), {"-o", file("stone.obj")});
        return refusal(names);
    };
    EXPECT_THAT(spin({files.begin(), files.begin() + 4}), testing::HasSubstr("8 frames at least"));
    SpinFrame small = frames[0];
    small.picture.height -= 20;
    small.picture.rgb.resize(std::size_t(3 * small.picture.width * small.picture.height));
    std::vector<std::string> names = files;
    names[5] = drawn(small, "small.png");
    EXPECT_THAT(spin(names), testing::HasSubstr("small.png"));
    names[5] = file("missing.png");
    EXPECT_THAT(spin(names), testing::HasSubstr("missing.png"));
    names[5] = write("text.png", "no picture");
    EXPECT_THAT(spin(names), testing::HasSubstr("text.png"));
    names[5] = names[4];
    EXPECT_THAT(spin(names), testing::HasSubstr("twice"));
    std::vector<std::string> empty;
    for (int i = 0; i < 10; ++i) {
        SpinFrame ground = frames[0];
        std::fill(ground.picture.rgb.begin(), ground.picture.rgb.end(), std::uint8_t{190});
        empty.push_back(drawn(ground, "ground" + std::to_string(i) + ".png"));
    }
    EXPECT_THAT(spin(empty), testing::HasSubstr("ground0.png"));
    EXPECT_FALSE(std::filesystem::exists(file("stone.obj")));
}

}  // namespace
}  // namespace culet
