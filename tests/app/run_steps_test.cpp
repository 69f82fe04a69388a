// `culet run` with every subset of its three steps: the page shows what was made, and impossible
// requests are refused before anything is made.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "tests/app/program_test.h"

namespace culet {
namespace {

namespace fs = std::filesystem;
using test::ProgramRun;
using test::run_culet;

class RunSteps : public test::ProgramTest {
protected:
    RunSteps() {
        // Small and quick: the test is about which steps appear.
        write("scene.toml",
              "stone = \"" + k_sample + "/stone.toml\"\n[camera]\nposition = [0, 0, 120]\n" +
                  "look_at = [0, 0, 0]\nup = [0, 1, 0]\nfov = 5.6\nsize = [120, 100]\n" +
                  "[[light.lobe]]\ndirection = [0, 0, 1]\nexponent = 2\nradiance = 0.5\n" +
                  "[render]\nsamples = 1\ntolerance = 0.1\n");
    }

    static inline const std::string k_sample =
        std::string(CULET_SOURCE_DIR) + "/samples/dravite-step";
    const std::string fit_ =
        "[fit]\nstone = \"" + k_sample + "/stone.toml\"\n[certificate]\npdf = false\n";
    const std::string render_ = "[render]\nscene = \"scene.toml\"\n";
    const std::string compare_ =
        "[compare]\nphoto = \"" + k_sample + "/simulated-photo.png\"\nsimulated = true\n";

    ProgramRun run(const std::string& job) const {
        write("job.toml", job);
        return run_culet({"run", file("job.toml"), "-o", file("out"), "-q"});
    }
    std::string page() const {
        std::ifstream stream(file("out/report.html"), std::ios::binary);
        return {std::istreambuf_iterator<char>(stream), {}};
    }
    bool shows(const std::string& what) const { return page().find(what) != std::string::npos; }
    bool made(const std::string& name) const { return fs::exists(file("out/" + name)); }

    /// Fitted, rendered, compared: what the page shows and which files exist.
    void expect_steps(bool fitted, bool rendered, bool compared) const {
        EXPECT_EQ(shows("<section id=\"fit\""), fitted);
        EXPECT_EQ(made("fitted.obj"), fitted);
        EXPECT_EQ(shows("<section id=\"plan\""), rendered);
        EXPECT_EQ(made("render.png"), rendered);
        EXPECT_EQ(shows("<section id=\"pictures\""), compared);
        EXPECT_EQ(made("scores.json"), compared);
        // There is always a picture: of the comparison, of the render, or the drawing, not
        // collapsed.
        EXPECT_EQ(shows("<section id=\"changes\""), rendered && !compared);
        EXPECT_EQ(shows("<section id=\"drawing\" aria"), fitted && !rendered && !compared);
    }
};

TEST_F(RunSteps, FitAlone) {
    EXPECT_EQ(run(fit_).exit_code, 0);
    expect_steps(true, false, false);
}

TEST_F(RunSteps, RenderAlone) {
    EXPECT_EQ(run(render_).exit_code, 0);
    expect_steps(false, true, false);
}

TEST_F(RunSteps, FitAndRender) {
    EXPECT_EQ(run(fit_ + render_).exit_code, 0);
    expect_steps(true, true, false);
}

TEST_F(RunSteps, RenderAndCompare) {
    // Another light than the photograph's: it is shown whatever the verdict.
    EXPECT_LE(run(render_ + compare_).exit_code, 1);
    expect_steps(false, true, true);
}

TEST_F(RunSteps, AllThree) {
    EXPECT_LE(run(fit_ + render_ + compare_).exit_code, 1);
    expect_steps(true, true, true);
}

TEST_F(RunSteps, CompareWithARenderThatIsThere) {
    ASSERT_EQ(run(render_).exit_code, 0);
    fs::rename(file("out/render.exr"), file("there.exr"));
    const std::string with = compare_ + "render = \"there.exr\"\n";
    fs::remove_all(file("out"));
    EXPECT_LE(run(with).exit_code, 1);
    expect_steps(false, false, true);
    fs::remove_all(file("out"));
    EXPECT_LE(run(fit_ + with).exit_code, 1);
    expect_steps(true, false, true);
    EXPECT_EQ(run(render_ + with).exit_code, 2) << "two renders for one photograph";
}

TEST_F(RunSteps, CompareWithoutARenderIsRefusedInOneLine) {
    for (const std::string& job :
         {compare_, fit_ + compare_, std::string("[compare]\nstart = true\n")}) {
        const std::string said = refusal_of(run(job));
        EXPECT_NE(said.find("[compare]"), std::string::npos) << said;
        EXPECT_FALSE(fs::exists(file("out")));
    }
}

}  // namespace
}  // namespace culet
