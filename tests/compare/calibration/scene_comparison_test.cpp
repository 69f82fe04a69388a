#include "compare/calibration/scene_comparison.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <set>

#include "compare/calibration/calibrate.h"
#include "compare/calibration/cropped_camera.h"
#include "compare/calibration/facet_error.h"
#include "compare/report/scores_json.h"
#include "render/scene/fingerprint.h"
#include "stone/cuts/cuts.h"
#include "stone/numbers/units.h"
#include "stone/solid/checks.h"
#include "stone/text/errors.h"

namespace culet {
namespace {

namespace fs = std::filesystem;

// A princess cut of glass under three lobes has few facets and little dispersion: a picture of 100
// pixels takes milliseconds.
Scene small_scene() {
    Scene scene;
    scene.stone.solid = *with_facet_error(make_cut("princess"), radians(0.5), 4);
    scene.stone.material = catalogue_material("glass_bk7");
    scene.camera.position = {4, -3, 200};
    scene.camera.up = {0, 1, 0};
    scene.camera.orthographic_width = 9;
    scene.camera.width = scene.camera.height = 120;
    scene.lights.constant = 0.1;
    scene.lights.sources.push_back(CosinePowerLight{Vec3{0.3, 0.1, 1}, 8, {Rgb{1.2, 1.1, 1.0}}});
    scene.lights.sources.push_back(CosinePowerLight{Vec3{1, 0.3, 0.5}, 30, {Rgb{3.0, 2.8, 2.9}}});
    scene.lights.sources.push_back(
        CosinePowerLight{Vec3{-0.5, 0.9, 0.4}, 20, {Rgb{1.0, 1.2, 0.8}}});
    scene.settings.wavelengths_nm = {550};
    scene.settings.effects_auto = false;
    return scene;
}

SceneCompareOptions quick() {
    SceneCompareOptions options;
    options.find_pose = false;
    options.calibrate = true;
    options.draws = 2;
    options.largest = 80;
    options.budget_seconds = 0;
    return options;
}

Photo photograph_of(Scene scene, double facet_error_deg) {
    if (facet_error_deg > 0) {
        scene.stone.solid = *with_facet_error(scene.stone.solid, radians(facet_error_deg), 21);
    }
    CameraModel camera;
    camera.gain = {0.6, 0.6, 0.6};
    camera.ground = {0.02f, 0.02f, 0.02f};
    RenderResult result = render(scene);
    return photographed(photo_of(result.picture), camera, 5);
}

// Facets known to half a degree: a photograph of a stone drawn that way is within two sigma of them
// nearly everywhere, one of facets two degrees off is not. The shares for one stone scatter,
// because facets are few: 95 and 68 in 100 hold for many stones.
TEST(SceneComparison, TellsWhatTheReadingsLeaveOpen) {
    const Scene scene = small_scene();
    SceneCompareOptions options = quick();
    options.calibrate = false;
    EXPECT_FALSE(compare_with_scene(photograph_of(scene, 0), scene, options).comparison.within);
    StoneUncertainty& known = options.uncertainty.emplace();
    known.facets.assign(scene.stone.solid.facets.size(), {radians(0.5), radians(0.5), 0});
    options.drawn_stones = 20;
    const auto near = compare_with_scene(photograph_of(scene, 0.3), scene, options),
               far = compare_with_scene(photograph_of(scene, 3), scene, options);
    ASSERT_TRUE(near.comparison.within && far.comparison.within);
    EXPECT_GT(near.comparison.within->within_two, 0.8);
    EXPECT_LT(far.comparison.within->within_two, near.comparison.within->within_two - 0.1);
}

TEST(SceneComparison, OfTheRightStoneIsNearerThanOfAWrongOne) {
    const Scene scene = small_scene();
    const SceneComparison right = compare_with_scene(photograph_of(scene, 0), scene, quick());
    const SceneComparison wrong = compare_with_scene(photograph_of(scene, 1.5), scene, quick());
    ASSERT_TRUE(right.calibrated && wrong.calibrated);
    ASSERT_TRUE(right.calibrated->equivalent.deg.has_value());
    EXPECT_LT(*right.calibrated->equivalent.deg, 0.15);
    EXPECT_GT(*wrong.calibrated->equivalent.deg, 0.7);
    EXPECT_EQ(right.comparison.verdict, Verdict::match);
    EXPECT_NE(wrong.comparison.verdict, Verdict::match);
    const std::string json = scores_json(right.comparison, {}, right.calibrated);
    EXPECT_NE(json.find("\"sensitivity\": [\n"), std::string::npos);
    EXPECT_NE(json.find("\"headline\""), std::string::npos);
}

// One number per key: in the table of scores, on its curve and in the verdict.
TEST(SceneComparison, HasOneValueForEachScore) {
    const Scene scene = small_scene();
    const SceneComparison compared = compare_with_scene(photograph_of(scene, 0.2), scene, quick());
    ASSERT_TRUE(compared.calibrated);
    const std::vector<Score>& scores = compared.comparison.scores;
    EXPECT_EQ(scores.size(), compared.calibrated->calibration.keys.size());
    EXPECT_GT(compared.comparison.render_blur_px, 0);
    ASSERT_FALSE(compared.calibrated->curves.empty());
    for (const SensitivityCurve& curve : compared.calibrated->curves) {
        const auto score = std::find_if(scores.begin(), scores.end(),
                                        [&](const Score& s) { return s.key == curve.key; });
        ASSERT_NE(score, scores.end()) << curve.key;
        EXPECT_EQ(score->value, curve.value) << curve.key;
    }
}

// The corners of a hand-made mesh are only roughly in their planes. This is reported, not skipped
// silently.
TEST(SceneComparison, OfAStoneThatIsNotConvexSaysThatNoPoseWasSought) {
    Scene scene = small_scene();
    const Photo photo = photograph_of(scene, 0);
    for (std::size_t v = 0; v < scene.stone.solid.vertices.size(); v += 3)
        scene.stone.solid.vertices[v] *= 1.03;
    ASSERT_FALSE(is_convex(scene.stone.solid));
    SceneCompareOptions options;
    options.find_pose = true;
    const SceneComparison found = compare_with_scene(photo, scene, options);
    EXPECT_FALSE(found.pose_used);
    EXPECT_NE(found.comparison.pose_note.find("not convex"), std::string::npos);
}

TEST(SceneComparison, IsTheSameWhateverTheThreads) {
    const Scene scene = small_scene();
    const Photo photo = photograph_of(scene, 0.2);
    SceneCompareOptions options = quick();
    options.compare.threads = 1;
    const SceneComparison one = compare_with_scene(photo, scene, options);
    options.compare.threads = 2;
    const SceneComparison two = compare_with_scene(photo, scene, options);
    EXPECT_EQ(scores_json(one.comparison, {}, one.calibrated),
              scores_json(two.comparison, {}, two.calibrated));
}

TEST(SceneComparison, KeepsItsCalibrationForTheNextPhotograph) {
    const fs::path cache = fs::path(testing::TempDir()) / "culet-calibrations";
    fs::remove_all(cache);
    const Scene scene = small_scene();
    const Photo photo = photograph_of(scene, 0.2);
    SceneCompareOptions options = quick();
    options.cache = cache;
    const SceneComparison first = compare_with_scene(photo, scene, options);
    EXPECT_FALSE(first.calibrated->calibration.from_cache);
    const SceneComparison second = compare_with_scene(photo, scene, options);
    EXPECT_TRUE(second.calibrated->calibration.from_cache);
    EXPECT_EQ(first.calibrated->headline, second.calibrated->headline);
    // No score depends on whether it was stored.
    const auto meant = [](const SceneComparison& compared) {
        const std::string json = scores_json(compared.comparison, {}, compared.calibrated);
        const std::size_t from = json.find("\"sensitivity\": ["),
                          to = json.find("\"calibration\": {");
        return json.substr(from, to - from);
    };
    EXPECT_TRUE(meant(first) == meant(second));
    options.compare.seed = 2;
    EXPECT_FALSE(compare_with_scene(photo, scene, options).calibrated->calibration.from_cache);
    fs::remove_all(cache);
}

// The work is counted beforehand: a small budget draws the two rounds that a verdict needs, a
// larger one more. Without facets' tilts the report says so.
TEST(SceneComparison, DrawsWhatItsBudgetAllows) {
    const Scene scene = small_scene();
    const Photo photo = photograph_of(scene, 0.2);
    SceneCompareOptions options = quick();
    options.draws = 3;
    options.budget_seconds = 0.01;
    const SceneComparison little = compare_with_scene(photo, scene, options);
    const Calibration& calibration = little.calibrated->calibration;
    ASSERT_FALSE(calibration.notes.empty());
    EXPECT_NE(calibration.notes.back().find("--budget"), std::string::npos);
    EXPECT_EQ(std::count_if(calibration.draws.begin(), calibration.draws.end(),
                            [](const CalibrationDraw& d) { return d.facet_error_deg == 0.1; }),
              2);
    options.budget_seconds = 60;
    const SceneComparison more = compare_with_scene(photo, scene, options);
    EXPECT_GT(more.calibrated->calibration.draws.size(), calibration.draws.size());
    EXPECT_EQ(more.comparison.verdict, Verdict::match);
}

TEST(SceneComparison, OfACameraThatDoesNotSeeTheStoneIsTheUsersMistake) {
    Scene scene = small_scene();
    const Photo photo = photograph_of(scene, 0);
    scene.camera.orthographic_width.reset();
    scene.camera.look_at = {0, 0, 400};  // away from it
    EXPECT_THROW(compare_with_scene(photo, scene, quick()), InputError);
}

TEST(SceneComparison, StopsWhenAsked) {
    const Scene scene = small_scene();
    const Photo photo = photograph_of(scene, 0);
    EXPECT_THROW(compare_with_scene(photo, scene, quick(), [](double f) { return f < 0.5; }),
                 Interrupted);
}

TEST(Calibrate, UnderTheSameLightFromEverywhereHasNoWrongLight) {
    Scene scene = small_scene();
    scene.lights = {};
    scene.lights.constant = 1;
    scene.camera = cropped_to_stone(scene.camera, scene.stone.solid, 60, 0.2);
    const DraftRenderer renderer(scene, 0.05);
    CalibrateOptions options;
    options.draws = 2;
    options.null_draws = 2;
    options.largest = 60;
    const Calibration calibration = calibrate(scene, renderer.picture(), renderer, options);
    for (const CalibrationDraw& draw : calibration.draws) {
        EXPECT_NE(draw.alternative, Alternative::light);
        EXPECT_NE(draw.alternative, Alternative::both);
    }
    EXPECT_FALSE(calibration.notes.empty());
}

TEST(Calibrate, ForSeveralCamerasIsThatForEach) {
    Scene scene = small_scene();
    scene.camera = cropped_to_stone(scene.camera, scene.stone.solid, 60, 0.2);
    const DraftRenderer renderer(scene, 0.05);
    CalibrateOptions options;
    options.draws = 2;
    options.null_draws = 2;
    options.largest = 60;
    CameraModel noisy;
    noisy.electrons = 500;
    CameraModel blurred;
    blurred.psf_px = 1.5;
    const auto both = calibrate(scene, renderer.picture(), renderer, options, {noisy, blurred});
    ASSERT_EQ(both.size(), 2u);
    for (const auto& [camera, calibration] : {std::pair(noisy, both[0]), {blurred, both[1]}}) {
        options.camera = camera;
        const Calibration one = calibrate(scene, renderer.picture(), renderer, options);
        EXPECT_EQ(calibration_json(one), calibration_json(calibration));
    }
    EXPECT_NE(both[0].draws[0].scores, both[1].draws[0].scores);
}

struct ChangePart {
    int n;
    bool changed = false;
    void point(Vec3& p) {
        change([&] { p.x += 1; });
    }
    void direction(Vec3& d) {
        change([&] { d.y += 1; });
    }
    void extent(std::optional<Vec3>& e) {
        change([&] { e = e.value_or(Vec3(0)) + Vec3(1); });
    }
    void number(double& v) {
        change([&] { v += 1; });
    }
    template <class Change>
    void change(Change&& make) {
        if (n-- != 0) return;
        make();
        changed = true;
    }
};

// Covers every type in the list, including future ones: a part missing from `each_part` would let
// the calibration of another light pass for its own.
TEST(Fingerprint, TellsLightsApartByEveryPartOfEveryType) {
    const auto print = [](const Light& light) {
        Scene scene = small_scene();
        scene.lights.sources = {light};
        Fingerprint fingerprint;
        fingerprint.add(scene);
        return fingerprint.hex();
    };
    for_each_light_type([&]<class L>() {
        SCOPED_TRACE(L::k_name);
        const L light{};
        std::set<std::string> prints{print(light)};
        std::size_t parts = 1;
        for (;; ++parts) {
            L other = light;
            ChangePart change{int(parts) - 1};
            other.each_part(other, change);
            if (!change.changed) break;
            prints.insert(print(other));
        }
        EXPECT_GT(parts, 1u);
        EXPECT_EQ(prints.size(), parts);
        L coloured = light;
        coloured.radiance.value = 7.0;
        EXPECT_TRUE(prints.insert(print(coloured)).second);
    });
}

TEST(Fingerprint, TellsScenesApartByEachOfTheirParts) {
    const auto print = [](const Scene& scene) {
        Fingerprint fingerprint;
        fingerprint.add(scene);
        return fingerprint.hex();
    };
    const Scene scene = small_scene();
    EXPECT_EQ(print(scene), print(small_scene()));
    const std::vector<std::function<void(Scene&)>> changes{
        [](Scene& s) { s.camera.position.x += 1e-9; },
        [](Scene& s) { nth_light<CosinePowerLight>(s.lights, 1).exponent = 31; },
        [](Scene& s) { s.lights.sources.pop_back(); },
        [](Scene& s) { nth_light<CosinePowerLight>(s.lights, 0).radiance.value = 1.0; },
        [](Scene& s) { s.stone.solid.facets[3].plane.offset *= 1 + 1e-12; },
        [](Scene& s) { s.stone.material = catalogue_material("quartz"); },
        [](Scene& s) { s.stone.convex = false; },
        [](Scene& s) {
            s.camera.principal_point = {60, 61};
        },
        [](Scene& s) { s.settings.depth = 9; },
        [](Scene& s) { s.settings.samples = 9; },
        [](Scene& s) { s.settings.cut_weight = 1e-3; },
        [](Scene& s) { s.settings.split_weight = 0.1; },
        [](Scene& s) { s.settings.wavelength_turns = 2; },
        [](Scene& s) { s.settings.most_beams = 1000; },
        [](Scene& s) { s.settings.checked_pixels = 100; },
        [](Scene& s) { s.settings.checked_samples = 4; },
        [](Scene& s) { s.settings.coherence = false; },
        [](Scene& s) { s.settings.bandwidth_nm = 1; },
        [](Scene& s) { s.immersion = 1.33; }};
    for (std::size_t i = 0; i < changes.size(); ++i) {
        Scene other = scene;
        changes[i](other);
        EXPECT_NE(print(scene), print(other)) << i;
    }
    Scene threads = scene;
    threads.settings.threads = 3;
    EXPECT_EQ(print(scene), print(threads));
}

}  // namespace
}  // namespace culet
