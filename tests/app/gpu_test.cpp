// culet render --engine gpu as a user runs it, with a driver and without.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include <algorithm>
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

class GpuProgramRuns : public test::ProgramTest {
protected:
    ProgramRun render(std::vector<std::string> more) const {
        std::vector<std::string> arguments{
            "render",   CULET_SOURCE_DIR "/samples/effects/garnet-depth.toml",
            "--size",   "32",
            "--depth",  "5",
            "--engine", "gpu"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run_culet(arguments);
    }
};

TEST_F(GpuProgramRuns, DrawAndNameTheDriver) {
    const ProgramRun run = render({"-o", file("a.png"), "--stats", file("a.json")});
    if (run.exit_code == 2 && run.err.find("needs an OpenGL ES 3 driver") != std::string::npos)
        GTEST_SKIP() << run.err;
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_TRUE(fs::exists(file("a.png")));
    std::ifstream stream(file("a.json"));
    const nlohmann::json stats = nlohmann::json::parse(stream);
    EXPECT_EQ(stats["engine"], "gpu");
    EXPECT_EQ(stats["depth"], 5);
    EXPECT_THAT(stats.dump(), HasSubstr("drawn by "));
}

// GLVND and Mesa look for drivers in these places; there are none.
TEST_F(GpuProgramRuns, SayWhatToInstallWhereThereIsNoDriver) {
    for (const char* folder : {"__EGL_VENDOR_LIBRARY_DIRS", "LIBGL_DRIVERS_PATH"})
        ASSERT_EQ(setenv(folder, "/nonexistent", 1), 0);
    const ProgramRun run = render({"-o", file("b.png")});
    const ProgramRun help = run_culet({"render", "--help"});
    for (const char* folder : {"__EGL_VENDOR_LIBRARY_DIRS", "LIBGL_DRIVERS_PATH"})
        ASSERT_EQ(unsetenv(folder), 0);
    EXPECT_EQ(run.exit_code, 2) << run.err;
    EXPECT_THAT(run.err, HasSubstr("apt install libegl1 libgl1-mesa-dri"));
    const std::size_t at = run.err.find("culet: error: ");
    ASSERT_NE(at, std::string::npos) << run.err;
    EXPECT_EQ(std::count(run.err.begin() + std::ptrdiff_t(at), run.err.end(), '\n'), 1) << run.err;
    EXPECT_FALSE(fs::exists(file("b.png")));
    EXPECT_EQ(help.exit_code, 0) << "culet itself starts without a driver";
}

}  // namespace
}  // namespace culet
