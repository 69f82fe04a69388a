#include "compare/study/scene_study.h"
#include "compare/report/study_pictures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "stone/text/errors.h"
#include "tests/compare/study_scene.h"

namespace culet {
namespace {

SceneStudyOptions quick(double tolerance) {
    SceneStudyOptions options;
    options.size = 24;
    options.tolerances = {tolerance};
    options.budget_seconds = 4;
    options.runs = 2;
    return options;
}

Scene scene_within(double tolerance) {
    Scene scene = test::cube_scene();
    scene.settings.tolerance = tolerance;
    scene.settings.threads = 1;
    return scene;
}

// One study, shared by the tests that only read it.
const SceneStudy& studied() {
    static const SceneStudy study = study_scene(scene_within(0.1), quick(0.1));
    return study;
}

TEST(SceneStudy, FrontFallsAsTimeGrowsAndNothingBeatsIt) {
    const SceneStudy& study = studied();
    ASSERT_FALSE(study.front.empty());
    EXPECT_EQ(study.width, 24);
    EXPECT_EQ(study.scene_width, 48);
    for (std::size_t i = 1; i < study.front.size(); ++i) {
        const StudiedRender &before = study.render(study.front[i - 1]),
                            &after = study.render(study.front[i]);
        EXPECT_GE(after.cpu.median, before.cpu.median);
        EXPECT_LT(after.claimed_error, before.claimed_error);
        EXPECT_FALSE(after.picture.rgb.empty());
    }
    // Except for the 2 % gain that a place on the front requires.
    for (const StudiedRender& render : study.renders) {
        EXPECT_TRUE(std::any_of(study.front.begin(), study.front.end(), [&](int id) {
            return study.render(id).cpu.median <= render.cpu.median &&
                   0.97 * study.render(id).claimed_error <= render.claimed_error;
        })) << render.words;
    }
}

TEST(SceneStudy, ClaimsNoErrorBelowThatOfTheReference) {
    const SceneStudy& study = studied();
    EXPECT_GT(study.reference.noise.mean, 0);
    for (const StudiedRender& render : study.renders) {
        EXPECT_GE(render.claimed_error, study.reference.noise.mean) << render.words;
        EXPECT_GE(render.claimed_error, render.error.mean) << render.words;
    }
}

TEST(SceneStudy, AdvisesTheCheapestThatMeetsTheTolerance) {
    const SceneStudy& study = studied();
    ASSERT_EQ(study.advice.size(), 1u);
    const StudyAdvice& advice = study.advice.front();
    ASSERT_TRUE(advice.cheapest && advice.automatic && advice.ratio) << advice.words;
    const StudiedRender& best = study.render(*advice.cheapest);
    EXPECT_LE(best.claimed_error, 0.1);
    for (const StudiedRender& render : study.renders) {
        if (render.claimed_error > 0.1) continue;
        EXPECT_GE(render.cpu.median, best.cpu.median) << render.words;
    }
    EXPECT_TRUE(study.usable());
    EXPECT_NEAR(*advice.ratio, study.render(*advice.automatic).cpu.median / best.cpu.median, 1e-9);
}

// In a constant light without absorption every path ends at the same radiance: what is not pruned
// is exactly 1, whatever the setting (conservation of energy).
TEST(SceneStudy, OfAFurnaceFindsNoErrorButWhatIsCut) {
    Scene scene = scene_within(0.03);
    scene.lights = {};
    scene.lights.constant = 1;
    const SceneStudy study = study_scene(scene, quick(0.03));
    EXPECT_LT(study.reference.noise.mean, 0.003);
    for (const StudiedRender& render : study.renders) {
        // A pruned path leaves out less than its small weight.
        const double cut =
            std::max(render.settled.tolerance, render.settled.cut_weight.value_or(0));
        if (render.settled.depth > 0 || cut > 0.5) continue;
        EXPECT_LT(render.error.mean, cut) << render.words;
        if (cut > 0.1) continue;
        EXPECT_LT(render.error.delta_e_mean, 3) << render.words;
    }
}

TEST(SceneStudy, MeasuresTheSameErrorsAgain) {
    const SceneStudy &one = studied(), two = study_scene(scene_within(0.1), quick(0.1));
    // The number of rays within the time depends on the machine.
    if (one.reference.samples != two.reference.samples) GTEST_SKIP() << "another reference";
    std::map<std::string, double> errors;
    for (const StudiedRender& render : one.renders) errors[render.words] = render.error.mean;
    int both = 0;
    for (const StudiedRender& render : two.renders) {
        const auto found = errors.find(render.words);
        if (found == errors.end()) continue;
        EXPECT_EQ(found->second, render.error.mean) << render.words;
        ++both;
    }
    EXPECT_GT(both, 3);
}

TEST(SceneStudy, WritesRowsAsJsonAndCsv) {
    const SceneStudy& study = studied();
    const auto json = nlohmann::json::parse(scene_study_json(study));
    EXPECT_EQ(json["schema"], 1);
    EXPECT_EQ(json["kind"], "scene");
    ASSERT_EQ(json["settings"].size(), study.renders.size());
    EXPECT_EQ(json["settings"][0]["error"], study.renders[0].error.mean);
    EXPECT_TRUE(json["settings"][0].contains("plan")) << "the automatic settings come first";
    EXPECT_EQ(json["front"].size(), study.front.size());
    const std::string csv = scene_study_csv(study);
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'),
              static_cast<std::ptrdiff_t>(study.renders.size() + 1));
    const auto pictures = study_pictures(study);
    EXPECT_EQ(pictures.size(), study.front.size() + 1);
    for (const SceneStudyPicture& picture : pictures)
        EXPECT_TRUE(picture.picture.starts_with("data:image/png;base64,"));
}

TEST(SceneStudy, OfASceneWhoseStoneIsNotSeenSaysSo) {
    Scene scene = scene_within(0.1);
    scene.camera.look_at = {12, 10, 18};
    EXPECT_THROW(study_scene(scene, quick(0.1)), InputError);
}

TEST(SceneStudy, StopsWhenAsked) {
    EXPECT_THROW(study_scene(scene_within(0.1), quick(0.1), [](double) { return false; }),
                 Interrupted);
}

}  // namespace
}  // namespace culet
