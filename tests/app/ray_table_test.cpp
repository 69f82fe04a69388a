// culet render --engine raytable --table as a user runs it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "render/image/image_io.h"
#include "tests/app/program_test.h"

namespace culet {
namespace {

namespace fs = std::filesystem;
using test::ProgramRun;
using test::run_culet;
using ::testing::HasSubstr;

class RayTables : public test::ProgramTest {
protected:
    ProgramRun render(std::vector<std::string> more) const {
        std::vector<std::string> arguments{
            "render",      CULET_SOURCE_DIR "/samples/effects/garnet-depth.toml",
            "--size",      "32",
            "--depth",     "5",
            "--effects",   "polarization,absorption",
            "--tolerance", "0"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run_culet(arguments);
    }
    ProgramRun by_table(std::vector<std::string> more) const {
        more.insert(more.end(), {"--engine", "raytable", "--table", file("stone.rays")});
        return render(std::move(more));
    }
    static void expect_refusal(const ProgramRun& run, const std::string& words) {
        EXPECT_EQ(run.exit_code, 2) << run.err;
        EXPECT_EQ(run.out, "");
        const std::size_t at = run.err.find("culet: error: ");
        ASSERT_NE(at, std::string::npos) << run.err;
        EXPECT_EQ(std::count(run.err.begin() + std::ptrdiff_t(at), run.err.end(), '\n'), 1)
            << run.err;
        EXPECT_THAT(run.err, HasSubstr(words));
    }
};

TEST_F(RayTables, ArePutIntoAFileAndLitAnew) {
    const ProgramRun first = by_table({"-o", file("a.png"), "--stats", file("a.json")});
    EXPECT_EQ(first.exit_code, 0) << first.err;
    const std::string table = text("stone.rays");
    EXPECT_EQ(table.substr(0, 8), "culetray");
    std::ifstream stats(folder_ / "a.json");
    EXPECT_EQ(nlohmann::json::parse(stats)["engine"], "raytable");
    const ProgramRun info = run_culet({"info", file("stone.rays")});
    EXPECT_EQ(info.exit_code, 0) << info.err;
    EXPECT_THAT(info.out, testing::AllOf(HasSubstr("32 x 32"), HasSubstr("depth 5")));
    const ProgramRun again = by_table({"-o", file("b.png")});
    EXPECT_EQ(again.exit_code, 0) << again.err;
    EXPECT_EQ(text("a.png"), text("b.png"));
    const ProgramRun aset = by_table({"-o", file("c.exr"), "--light", "aset"});
    EXPECT_EQ(aset.exit_code, 0) << aset.err;
    EXPECT_EQ(text("stone.rays"), table);
    // The same drawn again along the same rays: they differ only by single precision.
    const ProgramRun anew = render({"-o", file("d.exr"), "--light", "aset", "--engine", "reference",
                                    "--set", "render.samples=1"});
    EXPECT_EQ(anew.exit_code, 0) << anew.err;
    const Picture lit = read_picture(folder_ / "c.exr").picture,
                  by_reference = read_picture(folder_ / "d.exr").picture;
    ASSERT_EQ(lit.rgb.size(), by_reference.rgb.size());
    for (std::size_t i = 0; i < lit.rgb.size(); ++i)
        EXPECT_NEAR(lit.rgb[i], by_reference.rgb[i], 1e-6);
}

TEST_F(RayTables, AreRefusedInALineAndLeaveNoPicture) {
    EXPECT_EQ(by_table({"-o", file("a.png")}).exit_code, 0);
    const std::string table = text("stone.rays");
    expect_refusal(by_table({"-o", file("b.png"), "--set", "camera.fov=11"}), "another view");
    expect_refusal(by_table({"-o", file("b.png"), "--material", "diamond"}), "refractive indices");
    expect_refusal(by_table({"-o", file("b-#.png"), "--frames", "3"}), "one view");
    expect_refusal(render({"-o", file("b.png"), "--table", file("stone.rays")}),
                   "add --engine raytable");
    std::ofstream(folder_ / "stone.rays", std::ios::binary) << table.substr(0, table.size() / 2);
    expect_refusal(by_table({"-o", file("b.png")}), "cut off");
    expect_refusal(run_culet({"info", file("stone.rays")}), "cut off");
    EXPECT_FALSE(fs::exists(folder_ / "b.png"));
    EXPECT_EQ(text("stone.rays"), table.substr(0, table.size() / 2));
}

}  // namespace
}  // namespace culet
