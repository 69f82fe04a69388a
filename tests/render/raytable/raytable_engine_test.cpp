// The engine "raytable": which scenes it refuses, and how it stores its tables.

#include <gtest/gtest.h>

#include <fstream>

#include "render/render.h"
#include "stone/text/errors.h"
#include "stone/text/output_file.h"
#include "tests/folder_test.h"
#include "tests/render/raytable/table_scenes.h"

namespace culet {
namespace {

using test::brilliant;

class RayTableEngine : public test::FolderTest {
protected:
    RayTableEngine() : file_(folder_ / "stone.rays") {}

    Scene scene(int pixels = 16) const {
        Scene scene = brilliant(pixels);
        scene.settings.engine = k_raytable_engine;
        scene.settings.ray_table = file_;
        return scene;
    }
    static std::string refusal(const Scene& scene) {
        try {
            (void)render(scene);
        } catch (const InputError& error) {
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
            return error.what();
        }
        return "";
    }

    std::filesystem::path file_;
};

TEST_F(RayTableEngine, WritesItsTableWhereThereIsNoneAndReadsItAfterwards) {
    const RenderResult first = render(scene());
    EXPECT_EQ(first.stats.engine, k_raytable_engine);
    EXPECT_GT(first.stats.seconds_build, 0);
    const std::string bytes = read_text(file_);
    const RenderResult again = render(scene());
    EXPECT_EQ(again.picture.rgb, first.picture.rgb);
    EXPECT_EQ(again.stats.seconds_build, 0);
    EXPECT_EQ(read_text(file_), bytes);
    Scene other = scene();
    other.lights.sources.pop_back();
    other.stone.material.absorption_per_mm[0] = Spectrum(0.3);
    const RenderResult relit = render(other);
    EXPECT_EQ(relit.stats.seconds_build, 0);
    EXPECT_NE(relit.picture.rgb, first.picture.rgb);
    EXPECT_EQ(read_text(file_), bytes);
    other.settings.ray_table.clear();
    EXPECT_EQ(render(other).picture.rgb, relit.picture.rgb);
}

TEST_F(RayTableEngine, SaysWhatOfAnotherSceneDoesNotFit) {
    (void)render(scene());
    const auto expect = [&](const Scene& other, const std::string& words) {
        const std::string found = refusal(other);
        EXPECT_NE(found.find(words), std::string::npos) << found;
        EXPECT_NE(found.find("stone.rays"), std::string::npos) << found;
    };
    Scene other = scene();
    other.stone.solid.facets[3].plane.offset *= 1.001;
    other.stone.solid = bench_stones()[0].solid;
    expect(other, "another stone");
    expect(scene(17), "16 x 16 pixels, this one has 17 x 17");
    other = scene();
    other.camera.position.x += 0.01;
    expect(other, "another view");
    expect(test::in_material(scene(), "spinel"), "other refractive indices");
    other = scene();
    other.settings.depth = 7;
    expect(other, "paths of depth 6, this scene asks for 7");
    other = scene();
    other.settings.samples = 4;
    expect(other, "samples = 1, this scene asks for 4");
    other = scene();
    other.settings.tolerance = 0.01;
    other.settings.cut_weight = 0.1;
    expect(other, "cut_weight");
    other = scene();
    other.settings.wavelengths_nm = {450, 550, 650};
    expect(other, "one refractive index for all wavelengths");
    // None of these changed the table.
    EXPECT_EQ(refusal(scene()), "");
}

TEST_F(RayTableEngine, TakesTheWavelengthsOfATableWithDispersion) {
    Scene scene = this->scene(12);
    scene.settings.wavelengths_nm.clear();
    const RenderResult first = render(scene);
    EXPECT_EQ(first.stats.wavelengths_nm.size(), 15u);
    EXPECT_EQ(render(scene).picture.rgb, first.picture.rgb);
}

TEST_F(RayTableEngine, LeavesADamagedTableAloneAndSaysSo) {
    std::ofstream(file_) << "not a table";
    EXPECT_NE(refusal(scene()).find("not a ray table"), std::string::npos);
    EXPECT_EQ(read_text(file_), "not a table");
    Scene nowhere = scene();
    nowhere.settings.ray_table = folder_ / "no-folder" / "stone.rays";
    EXPECT_NE(refusal(nowhere).find("no folder"), std::string::npos);
}

TEST_F(RayTableEngine, RefusesInOneLine) {
    const auto expect = [](const Scene& refused, const std::string& words) {
        const std::string found = refusal(refused);
        EXPECT_NE(found.find(words), std::string::npos) << found;
        EXPECT_NE(found.find("say engine"), std::string::npos) << found;
    };
    Scene other = scene();
    other.camera.optics.two_windows = true;
    expect(other, "two");
    other = scene();
    other.camera.optics.analyzer = 0.0;
    expect(other, "analyser");
    other = scene();
    colour_of(other.lights.sources.front()).polarisation = LinearPolarisation{};
    expect(other, "polarised lights");
    other = test::in_material(scene(), "zircon_high");
    other.settings.coherence = true;
    expect(other, "interfere");
    other = test::in_material(scene(), "zircon_high");
    other.settings.reflection_factor = 0.2;
    expect(other, "branch");
    other = scene();
    other.settings.samples = 65535;
    other.camera.width = other.camera.height = 4096;
    expect(other, "4294967295 rays");
    EXPECT_FALSE(std::filesystem::exists(file_));
}

TEST_F(RayTableEngine, RefusesTablesBeyondItsLimitBeforeMemoryRunsOut) {
    Scene large = scene(3000);
    large.settings.samples = 16;
    large.settings.wavelengths_nm = {450, 500, 550, 600, 650};
    EXPECT_NE(refusal(large).find("more than 1 GB"), std::string::npos);
    EXPECT_FALSE(std::filesystem::exists(file_));
}

TEST_F(RayTableEngine, StopsWhenItIsTold) {
    EXPECT_THROW((void)render(scene(), [](double) { return false; }), Interrupted);
    EXPECT_FALSE(std::filesystem::exists(file_));
}

}  // namespace
}  // namespace culet
