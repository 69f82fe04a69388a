#include "compare/study/study_design.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "compare/study/study_words.h"
#include "render/setup/optical_setup.h"
#include "tests/compare/study_scene.h"

namespace culet {
namespace {

StudiedScene studied_scene(const Scene& scene) {
    StudiedScene studied;
    studied.scene = scene;
    Scene exact = scene;
    exact.settings = exact_settings(scene, 0.001, k_node_counts.back());
    const OpticalSetup setup = make_optical_setup(exact);
    studied.exact.effects.assign(setup.effects.begin(), setup.effects.end());
    studied.exact.wavelengths_nm = setup.wavelengths_nm;
    studied.exact.depth = 30;
    studied.tolerances = {0.1, 0.01};
    return studied;
}

std::set<std::string> settings_of(const std::vector<StudyCandidate>& design,
                                  const std::string& sweep) {
    std::set<std::string> settings;
    for (const StudyCandidate& one : design) {
        if (one.sweep == sweep) settings.insert(one.setting);
    }
    return settings;
}

TEST(StudyDesign, LeavesNothingOpenInTheReference) {
    Scene scene = test::cube_scene();
    scene.settings.engine = "preview";
    scene.settings.depth = 3;
    scene.settings.effects_auto = true;
    scene.settings.wavelengths_nm = {450, 550, 650};
    scene.settings.cut_weight = 0.5;
    const RenderSettings exact = exact_settings(scene, 0.001, 57);
    EXPECT_EQ(exact.engine, "reference");
    EXPECT_EQ(exact.depth, 0);
    EXPECT_FALSE(exact.effects_auto);
    EXPECT_FALSE(exact.cut_weight);
    EXPECT_EQ(exact.wavelengths_nm.size(), 57u);
    // A single wavelength is part of the scene's intent.
    scene.settings.wavelengths_nm = {589.3};
    EXPECT_EQ(exact_settings(scene, 0.001, 57).wavelengths_nm, std::vector<double>{589.3});
}

TEST(StudyDesign, VariesWhatTheSceneCallsFor) {
    const StudiedScene studied = studied_scene(test::cube_scene());
    const auto design = study_design(studied);
    EXPECT_EQ(settings_of(design, "automatic").size(), 2u);
    EXPECT_EQ(settings_of(design, "effects"),
              (std::set<std::string>{"without dispersion", "without polarization", "none"}));
    EXPECT_EQ(settings_of(design, "wavelengths"),
              (std::set<std::string>{"1", "3", "8", "15", "29", "57"}));
    EXPECT_TRUE(settings_of(design, "depth").contains("8"));
    EXPECT_FALSE(settings_of(design, "pruning").empty());
    EXPECT_FALSE(settings_of(design, "samples").empty());
    EXPECT_TRUE(settings_of(design, "crystal beams").empty()) << "the stone is isotropic";
}

TEST(StudyDesign, OfACrystalHasItsWaves) {
    Scene scene = test::cube_scene();
    scene.stone.material = catalogue_material("zircon_high");
    const auto design = study_design(studied_scene(scene));
    EXPECT_EQ(settings_of(design, "crystal beams"), (std::set<std::string>{"merged", "split"}));
    EXPECT_TRUE(settings_of(design, "effects").contains("without birefringence"));
}

TEST(StudyDesign, IsDrawnByTheReferenceWhereBeamsCannot) {
    StudiedScene studied = studied_scene(test::cube_scene());
    studied.beams = false;
    for (const StudyCandidate& one : study_design(studied)) {
        EXPECT_TRUE(one.settings.engine == "reference" || one.automatic) << one.setting;
    }
}

TEST(StudyDesign, NeighboursDifferInOneThingEach) {
    const StudiedScene studied = studied_scene(test::cube_scene());
    RenderSettings settings = exact_settings(studied.scene, 0.01, 15);
    settings.engine = "beams";
    RenderStats drawn = studied.exact;
    drawn.wavelengths_nm = settings.wavelengths_nm;
    const auto neighbours = cheaper_neighbours(studied, settings, drawn);
    std::set<std::string> keys{key_of(studied, settings)};
    for (const StudyCandidate& one : neighbours) {
        EXPECT_TRUE(keys.insert(key_of(studied, one.settings)).second) << one.setting;
        EXPECT_GE(one.settings.tolerance, settings.tolerance);
        EXPECT_LE(one.settings.wavelengths_nm.size(), 15u);
    }
    EXPECT_GE(neighbours.size(), 6u);
}

TEST(StudyDesign, TellsSettingsThatDrawTheSame) {
    const StudiedScene studied = studied_scene(test::cube_scene());
    const RenderSettings settings = exact_settings(studied.scene, 0.01, 15);
    RenderSettings other = settings;
    // The stone is clear: absorption makes no difference.
    other.effects[static_cast<std::size_t>(Effects::absorption)] = false;
    EXPECT_EQ(key_of(studied, settings), key_of(studied, other));
    other.effects[static_cast<std::size_t>(Effects::polarization)] = false;
    EXPECT_NE(key_of(studied, settings), key_of(studied, other));
    EXPECT_EQ(words_of(studied, other),
              "reference, 15 wavelengths, tolerance 0.01, without polarization");
}

}  // namespace
}  // namespace culet
