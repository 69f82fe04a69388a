// Expectations: zeros of the table of effects (docs/plan.md), pictures drawn with all effects, and
// the scenes of samples/effects, in each of which one effect matters.

#include "render/planner/explain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <ostream>
#include <random>
#include <set>

#include "render/colour/colour_error.h"
#include "render/planner/error_estimate.h"
#include "render/planner/planner.h"
#include "render/planner/verify.h"
#include "render/planner/wavelengths.h"
#include "render/render.h"
#include "render/scene/scene_io.h"
#include "stone/cuts/cuts.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

Scene small_scene(const std::string& material) {
    Scene scene;
    scene.stone.name = "brilliant";
    scene.stone.solid = make_cut("round-brilliant", {{"diameter", 2.0}});
    scene.stone.material = catalogue_material(material);
    scene.stone.crystal.axes[0] = {1, 0, 0};
    scene.stone.crystal.axes[1] = {0, 1, 0};
    scene.stone.crystal.axes[2] = {0, 0, 1};
    scene.camera.position = {1, 2, 12};
    scene.camera.fov = 0.18;
    scene.camera.width = scene.camera.height = 32;
    scene.lights.constant = 1;
    scene.settings.tolerance = 0.05;
    scene.settings.threads = 2;
    return scene;
}

void add_lobes(Scene& scene) {
    scene.lights.constant = 0.2;
    scene.lights.sources.push_back(CosinePowerLight{{0.6, 0, 0.8}, 8, {2.0}});
    scene.lights.sources.push_back(CosinePowerLight{{-0.8, 0, 0.6}, 8, {1.0}});
}

std::set<std::string> effects_on(const ScenePlan& plan) {
    std::set<std::string> on;
    for (std::size_t e = 0; e < k_effect_count; ++e) {
        if (plan.items[e].on) on.insert(plan.items[e].name);
    }
    return on;
}

TEST(ColourError, IsZeroForEqualPixelsAndRelativeToTheMean) {
    const std::vector<Rgb> truth{{1, 1, 1}, {3, 3, 3}};
    EXPECT_EQ(colour_error(truth, truth).radiance, 0);
    EXPECT_EQ(colour_error(truth, truth).delta_e, 0);
    // Off by 0.3 in one channel of one pixel of two: 0.1 / 2 pixels / mean 2.
    const ColourError error = colour_error({{1.3, 1, 1}, {3, 3, 3}}, truth);
    EXPECT_NEAR(error.radiance, 0.025, 1e-15);
    EXPECT_NEAR(error.radiance_spread, 0.025, 1e-15) << "of 0.05 and 0";
    EXPECT_GT(error.delta_e, 0);
    const ColourError twice = colour_error({{2.6, 2, 2}, {6, 6, 6}}, {{2, 2, 2}, {6, 6, 6}});
    EXPECT_NEAR(twice.radiance, error.radiance, 1e-15);
    EXPECT_NEAR(twice.delta_e, error.delta_e, 1e-12);
    EXPECT_EQ(colour_error({{0, 0, 0}}, {{0, 0, 0}}).radiance, 0) << "a dark picture";
}

// Closed form: differences that both drawings show remain, others vanish.
TEST(ColourError, InCommonIsWhatTwoDrawingsBothShow) {
    std::mt19937 random(5);
    std::normal_distribution<double> noise(0, 0.3);
    const std::size_t pixels = 4096;
    const std::vector<Rgb> truth(pixels, Rgb{1, 1, 1});
    std::array<std::vector<Rgb>, 2> brighter, apart, noisy{truth, truth};
    brighter.fill(std::vector<Rgb>(pixels, Rgb{1.25, 1.25, 1.25}));
    apart = {brighter[0], std::vector<Rgb>(pixels, Rgb{0.75, 0.75, 0.75})};
    for (auto& drawing : noisy) {
        for (Rgb& pixel : drawing) pixel[1] += noise(random);
    }
    const std::array<std::vector<Rgb>, 2> both{truth, truth};
    EXPECT_NEAR(noise_corrected_error(brighter, both).radiance, 0.25, 1e-12);
    EXPECT_EQ(noise_corrected_error(apart, both).radiance, 0);
    std::vector<Rgb> mean = truth;
    for (std::size_t i = 0; i < pixels; ++i) mean[i][1] = 0.5 * (noisy[0][i][1] + noisy[1][i][1]);
    // Products of P independent pairs sum to 0 within 3 sqrt(P) of one drawing's variance. The
    // mean's squares are half a variance each; 1/sqrt(P) of them is also allowed: (6 + 1) / 64.
    EXPECT_LE(noise_corrected_error(noisy, both).radiance,
              std::sqrt(7.0 / 64) * colour_error(mean, truth).radiance);
}

TEST(OpticalSetup, InTheSameLightFromEverywhereNothingButDepthMatters) {
    for (const char* material : {"diamond", "zircon_high", "peridot"}) {
        Scene scene = small_scene(material);
        if (material == std::string("peridot")) {
            scene.stone.material.absorption_per_mm = {};
        }
        const ScenePlan plan = plan_scene(scene);
        EXPECT_TRUE(effects_on(plan).empty()) << material << "\n" << explain(plan);
        for (std::size_t e = 0; e < k_effect_count; ++e) {
            if (plan.items[e].name != "coherence") {
                EXPECT_EQ(plan.items[e].bound, 0) << material << " " << plan.items[e].name;
            }
        }
        EXPECT_EQ(plan.settings.wavelengths_nm.size(), 1u);
        const RenderResult result = render(scene);
        EXPECT_LE(result.stats.error_bound, scene.settings.tolerance);
        // All effects: 1 less what paths were cut.
        EXPECT_NEAR(result.stats.mean_radiance, 1, result.stats.error_bound) << material;
    }
}

TEST(OpticalSetup, KeepsItsWord) {
    int on = 0, off = 0;
    for (const char* material : {"diamond", "fluorite", "zircon_high"}) {
        for (const double tolerance : {0.2, 0.1, 0.05, 0.02}) {
            Scene scene = small_scene(material);
            scene.camera.width = scene.camera.height = 16;
            add_lobes(scene);
            scene.settings.tolerance = tolerance;
            const RenderResult result = render(scene);
            const Verification found = verify(scene, result, 24);
            SCOPED_TRACE(std::string(material) + "\n" + explain(*result.stats.plan));
            EXPECT_LE(found.measured, tolerance + found.noise);
            EXPECT_LE(found.measured, result.stats.error_bound + found.noise);
            EXPECT_LE(result.stats.error_bound, tolerance);
            EXPECT_TRUE(found.holds());
            for (const PlanItem& line : result.stats.plan->items) {
                if (std::isfinite(line.matters) && line.matters > 0) (line.on ? on : off) += 1;
            }
        }
    }
    EXPECT_GE(on, 2) << "some effects are worth their price at these tolerances";
    EXPECT_GT(off, 2) << "and some are not";
}

TEST(OpticalSetup, ABoundThatIsTooLowIsFoundOut) {
    Scene scene = small_scene("diamond");
    add_lobes(scene);
    RenderResult result = render(scene);
    for (float& v : result.picture.rgb) v *= 1.5f;
    EXPECT_FALSE(verify(scene, result, 24).holds());
}

TEST(OpticalSetup, ItsSettingsDrawTheSamePicture) {
    for (const char* material : {"garnet_almandine", "corundum"}) {
        Scene scene = small_scene(material);
        add_lobes(scene);
        scene.camera.width = scene.camera.height = 16;
        const RenderResult automatic = render(scene);
        Scene by_hand = scene;
        by_hand.settings = automatic.stats.plan->settings;
        EXPECT_EQ(render(by_hand).picture.rgb, automatic.picture.rgb) << material;
    }
}

TEST(OpticalSetup, IsTheSameOnAnyNumberOfThreads) {
    Scene scene = small_scene("diamond");
    add_lobes(scene);
    scene.settings.threads = 1;
    const ScenePlan one = plan_scene(scene);
    scene.settings.threads = 3;
    const ScenePlan three = plan_scene(scene);
    EXPECT_EQ(one.settings.engine, three.settings.engine);
    EXPECT_EQ(one.settings.samples, three.settings.samples);
    EXPECT_EQ(one.settings.wavelengths_nm, three.settings.wavelengths_nm);
    EXPECT_EQ(one.bound, three.bound);
    EXPECT_EQ(one.bound_delta_e, three.bound_delta_e);
}

TEST(OpticalSetup, RespectsWhatTheSceneSays) {
    Scene scene = small_scene("diamond");
    add_lobes(scene);
    scene.settings.effects_auto = false;
    scene.settings.effects.fill(true);
    scene.settings.wavelengths_nm = {500, 600};
    scene.settings.samples = 4;
    const ScenePlan plan = plan_scene(scene);
    EXPECT_TRUE(plan.item("dispersion").on);
    EXPECT_TRUE(plan.item("polarization").on);
    EXPECT_EQ(plan.settings.wavelengths_nm, (std::vector<double>{500, 600}));
    EXPECT_EQ(plan.settings.samples, 4);
    scene.settings.effects.fill(false);
    const ScenePlan none = plan_scene(scene);
    EXPECT_TRUE(effects_on(none).empty());
}

TEST(OpticalSetup, WithTolerance0LeavesNothingOut) {
    Scene scene = small_scene("diamond");
    add_lobes(scene);
    scene.settings.tolerance = 0;
    scene.settings.depth = 5;
    const ScenePlan plan = plan_scene(scene);
    EXPECT_EQ(plan.pilot_pixels, 0);
    EXPECT_EQ(plan.settings.engine, "reference");
    EXPECT_EQ(effects_on(plan), (std::set<std::string>{"dispersion", "polarization"}));
    EXPECT_FALSE(render(scene).stats.plan.has_value());
}

TEST(OpticalSetup, OfAPictureWithoutTheStoneSaysSo) {
    Scene scene = small_scene("diamond");
    scene.camera.look_at = {100, 0, 12};
    const ScenePlan plan = plan_scene(scene);
    EXPECT_EQ(plan.pilot_pixels, 0);
    EXPECT_NE(plan.engine_why.find("stone"), std::string::npos);
    EXPECT_NO_THROW(render(scene));
}

TEST(OpticalSetup, BlackScenesHaveNoError) {
    Scene scene = small_scene("diamond");
    scene.lights.constant = 0;
    const RenderResult result = render(scene);
    for (float v : result.picture.rgb) EXPECT_EQ(v, 0);
    EXPECT_FALSE(std::isnan(result.stats.error_bound));
}

TEST(OpticalSetup, StopsWhenItIsToldTo) {
    Scene scene = small_scene("diamond");
    add_lobes(scene);
    int told = 0;
    const Progress third_time = [&](double) { return ++told < 3; };
    EXPECT_THROW(plan_scene(scene, third_time), Interrupted);
    EXPECT_EQ(told, 3);
    told = 0;
    EXPECT_THROW(render(scene, third_time), Interrupted);
    EXPECT_EQ(told, 3);
}

// In even light a path carries all that it has not lost, so a depth leaves out exactly 1 less the
// mean radiance.
TEST(OpticalSetup, HasADepthThatTheSceneNamesInItsBound) {
    Scene scene = small_scene("diamond");
    scene.settings.depth = 3;
    const RenderResult result = render(scene);
    const double missing = 1 - result.stats.mean_radiance;
    EXPECT_GT(missing, scene.settings.tolerance) << "three faces are few for a diamond";
    EXPECT_GE(result.stats.plan->bound_of_depth, 0.95 * missing);
    EXPECT_GE(result.stats.error_bound, missing);
    EXPECT_LE(result.stats.error_bound, 1.5 * missing);
    EXPECT_TRUE(std::any_of(result.stats.notes.begin(), result.stats.notes.end(),
                            [](const std::string& note) {
                                return note.find("over the tolerance") != std::string::npos;
                            }));
}

TEST(OpticalSetup, DrawsCrystalsAsOneWaveWhereThatIsNearEnough) {
    Scene scene = small_scene("quartz");
    add_lobes(scene);
    scene.settings.tolerance = 0.1;
    const RenderResult result = render(scene);
    ASSERT_TRUE(result.stats.plan);
    const ScenePlan& plan = *result.stats.plan;
    SCOPED_TRACE(explain(plan));
    EXPECT_FALSE(plan.item("birefringence").on);
    EXPECT_EQ(plan.item("birefringence").bound, result.stats.error_bound)
        << "nothing but the finished picture shows it";
    EXPECT_LE(result.stats.error_bound, 0.1);
    const Verification found = verify(scene, result, 48);
    EXPECT_LE(found.measured, result.stats.error_bound + found.noise);
    // Counter-example: zircon's two images are far apart.
    scene.stone.material = catalogue_material("zircon_high");
    scene.settings.tolerance = 0.05;
    scene.camera.width = scene.camera.height = 16;
    EXPECT_TRUE(render(scene).stats.plan->item("birefringence").on);
}

// A spinel in smooth light: previews are far better than a tenth of the mean, and cost less than
// pilots of the effects.
TEST(OpticalSetup, WeighsNoEffectsWhereThatWouldCostMoreThanThePicture) {
    Scene scene = small_scene("spinel");
    add_lobes(scene);
    scene.camera.width = scene.camera.height = 64;
    scene.settings.tolerance = 0.1;
    const RenderResult result = render(scene);
    ASSERT_TRUE(result.stats.plan);
    const ScenePlan& plan = *result.stats.plan;
    SCOPED_TRACE(explain(plan));
    EXPECT_LE(result.stats.error_bound, 0.1);
    EXPECT_TRUE(std::isnan(plan.item("polarization").matters)) << "nobody looked";
    EXPECT_TRUE(plan.item("polarization").on);
    const Verification found = verify(scene, result, 48);
    EXPECT_LE(found.measured, result.stats.error_bound + found.noise);
    Scene by_hand = scene;
    by_hand.settings = plan.settings;
    EXPECT_EQ(render(by_hand).picture.rgb, result.picture.rgb);
    // The answer about a plan is that of the closer look.
    EXPECT_FALSE(std::isnan(plan_scene(scene).item("polarization").matters));
}

TEST(OpticalSetup, PicturesAndChecksAreTheSameOnAnyNumberOfThreads) {
    for (const char* material : {"diamond", "quartz"}) {
        Scene scene = small_scene(material);
        add_lobes(scene);
        scene.camera.width = scene.camera.height = 16;
        scene.settings.tolerance = 0.1;
        scene.settings.threads = 1;
        const RenderResult one = render(scene);
        scene.settings.threads = 3;
        const RenderResult three = render(scene);
        EXPECT_EQ(one.picture.rgb, three.picture.rgb) << material;
        EXPECT_EQ(one.stats.error_bound, three.stats.error_bound) << material;
        EXPECT_EQ(one.stats.checked_pixels, three.stats.checked_pixels) << material;
    }
}

// In even light every true pixel is 1.
TEST(ErrorEstimate, FindsWhatAPictureIsOffBy) {
    const Scene scene = small_scene("diamond");
    Picture picture;
    picture.width = scene.camera.width;
    picture.height = scene.camera.height;
    picture.rgb.assign(3 * picture.pixels(), 1.1f);
    const Progress progress;
    ErrorEstimator estimator(scene, stone_pixels(scene, 64), 0.05, progress);
    const ErrorEstimate off = estimator.estimate(picture, 0.05, 1e9);
    // The truth leaves out less than a hundredth of the tolerance per path.
    EXPECT_NEAR(off.difference, 0.1, 0.005);
    EXPECT_GE(off.bound, 0.1);
    EXPECT_LE(off.bound, 0.11);
    for (float& v : picture.rgb) v = 1;
    const ErrorEstimate right = estimator.estimate(picture, 0.05, 1e9);
    EXPECT_LE(right.bound, 0.01);
    picture.rgb.assign(3 * picture.pixels(), std::nanf(""));
    EXPECT_GT(estimator.estimate(picture, 0.05, 1e9).bound, 1e6);
}

// Where every other pixel is black, pixels next to changes are chosen more often; the mean must
// weight them accordingly.
TEST(ErrorEstimate, CountsPixelsThatItChoosesMoreOftenForLess) {
    Scene scene = small_scene("diamond");
    scene.settings.tolerance = 0;
    scene.settings.depth = 8;
    scene.settings.engine = "reference";
    scene.camera.width = scene.camera.height = 64;
    Picture picture = render(scene).picture;
    const Progress progress;
    double sum = 0, count = 0;
    for (std::size_t p = 0; p < picture.pixels(); ++p) {
        const bool left = p % 64 < 24;
        for (std::size_t c = 0; c < 3; ++c) picture.rgb[3 * p + c] = left ? 2.0f : 1.0f;
        if (picture.coverage[p] < 0.5f) continue;
        sum += left;
        ++count;
    }
    ErrorEstimator estimator(scene, stone_pixels(scene, 64), 0.05, progress);
    const ErrorEstimate estimate = estimator.estimate(picture, 0, 1e12);
    EXPECT_NEAR(estimate.difference, sum / count, 3 * estimate.standard_error + 0.05);
    EXPECT_LT(estimate.standard_error, 0.2);
    EXPECT_GE(estimate.bound, sum / count);
}

// The response to a spectrum that is 0 up to a wavelength and 1 beyond it, against wavelengths 1 nm
// apart: mean over the positions of the step, and over R, G and B.
double off_at_steps(const std::vector<double>& nm) {
    std::vector<double> fine;
    for (int i = 390; i <= 710; ++i) fine.push_back(i);
    const WavelengthSet few(nm), all(fine);
    const auto seen = [](const WavelengthSet& set, double step) {
        std::vector<double> radiance;
        for (double at : set.wavelengths_nm()) radiance.push_back(at > step ? 1 : 0);
        return set.rgb_of(radiance.data());
    };
    double sum = 0;
    int count = 0;
    for (double step = 392.5; step < 710; step += 5, ++count) {
        const Rgb a = seen(few, step), b = seen(all, step);
        for (std::size_t c = 0; c < 3; ++c) sum += std::abs(a[c] - b[c]) / 3;
    }
    return sum / count;
}

// Dispersion moves the edges of lights and facets over a pixel: steps of its spectrum.
TEST(Wavelengths, ThatAreFewShowStepsOfASpectrumBetterThanEvenOnes) {
    EXPECT_LT(off_at_steps(even_wavelengths(3)), off_at_steps({410, 550, 690}));
    EXPECT_LT(off_at_steps(even_wavelengths(5)), 0.75 * off_at_steps({410, 480, 550, 620, 690}));
    double before = 1;
    for (const int count : {3, 5, 8, 15, 29, 57}) {
        const double here = off_at_steps(even_wavelengths(count));
        EXPECT_LT(here, before) << count;
        before = here;
    }
}

// Pilots use a subset of the wavelengths.
TEST(Wavelengths, OfFiveAreAmongThoseOf29) {
    const std::vector<double> many = even_wavelengths(29);
    for (const double nm : even_wavelengths(5))
        EXPECT_NE(std::find(many.begin(), many.end(), nm), many.end()) << nm;
}

// In even light every wavelength contributes the same, however few rays it has.
TEST(Turns, BringEachWavelengthItsShare) {
    Scene scene = small_scene("diamond");
    scene.settings.tolerance = 0;
    scene.settings.depth = 6;
    scene.settings.samples = 16;
    scene.settings.wavelengths_nm = {450, 500, 550, 600, 650};
    scene.settings.engine = "reference";
    const RenderResult all = render(scene);
    scene.settings.wavelength_turns = 5;
    const RenderResult turns = render(scene);
    EXPECT_EQ(all.stats.rays, 5 * turns.stats.rays);
    double apart = 0;
    for (std::size_t i = 0; i < all.picture.rgb.size(); ++i)
        apart += std::abs(static_cast<double>(all.picture.rgb[i] - turns.picture.rgb[i]));
    // The remainder differs slightly from ray to ray.
    EXPECT_LT(apart / static_cast<double>(all.picture.rgb.size()), 0.02);
    EXPECT_NEAR(all.stats.mean_radiance, turns.stats.mean_radiance, 2e-3);
}

struct GalleryScene {
    const char* file;
    std::set<std::string> on;  // all items but samples, which the engine decides
    friend void PrintTo(const GalleryScene& one, std::ostream* out) { *out << one.file; }
};
class Gallery : public testing::TestWithParam<GalleryScene> {};

Scene gallery_scene(const std::string& file) {
    return read_scene(std::string(CULET_SOURCE_DIR "/samples/effects/") + file);
}

std::set<std::string> verdict(const ScenePlan& plan) {
    std::set<std::string> on;
    for (const PlanItem& line : plan.items) {
        if (line.on && line.name != "samples") on.insert(line.name);
    }
    return on;
}

TEST_P(Gallery, CallsForItsEffect) {
    const Scene scene = gallery_scene(GetParam().file);
    const ScenePlan plan = plan_scene(scene);
    EXPECT_EQ(verdict(plan), GetParam().on) << explain(plan);
    EXPECT_LE(plan.bound, scene.settings.tolerance);
}

// Beside its effect every scene has light paths of some depth. Polarisation and pleochroism need
// the waves of a crystal, pleochroism needs absorption, and colours need wavelengths.
const std::set<std::string> k_pleochroic{"birefringence", "polarization", "absorption",
                                         "pleochroism",   "depth",        "wavelengths"};
INSTANTIATE_TEST_SUITE_P(
    Samples, Gallery,
    testing::Values(GalleryScene{"zircon-doubling.toml",
                                 {"birefringence", "polarization", "depth"}},
                    GalleryScene{"tourmaline-across.toml", k_pleochroic},
                    GalleryScene{"tourmaline-along.toml", k_pleochroic},
                    GalleryScene{"andalusite-across.toml", k_pleochroic},
                    GalleryScene{"andalusite-along.toml", k_pleochroic},
                    GalleryScene{"diamond-fire.toml", {"dispersion", "depth", "wavelengths"}},
                    GalleryScene{"garnet-depth.toml", {"depth"}},
                    GalleryScene{"brewster.toml", {"polarization", "depth"}},
                    GalleryScene{"brewster-glare.toml", {"polarization", "depth"}},
                    GalleryScene{"depth-of-field.toml", {"aperture", "depth"}},
                    GalleryScene{"light-edges.toml", {"light_edges", "depth"}},
                    GalleryScene{"environment-map.toml", {"environment_filter", "depth"}},
                    GalleryScene{"ruby-absorption.toml", {"absorption", "depth", "wavelengths"}}),
    [](const testing::TestParamInfo<GalleryScene>& which) {
        std::string name = which.param.file;
        name = name.substr(0, name.find('.'));
        for (char& c : name) {
            if (c == '-') c = '_';
        }
        return name;
    });

// Without pleochroism the two waves of these stones change less than the tolerance.
TEST(GalleryOfPleochroism, TheSplitItselfDoesNotShow) {
    for (const char* file : {"tourmaline-across.toml", "tourmaline-along.toml",
                             "andalusite-across.toml", "andalusite-along.toml"}) {
        Scene scene = gallery_scene(file);
        EXPECT_GT(plan_scene(scene).item("birefringence").matters, scene.settings.tolerance);
        auto& absorption = scene.stone.material.absorption_per_mm;
        absorption[1] = absorption[2] = absorption[0];
        const ScenePlan plan = plan_scene(scene);
        EXPECT_LT(plan.item("birefringence").matters, scene.settings.tolerance) << file << "\n"
                                                                                << explain(plan);
        EXPECT_FALSE(plan.item("pleochroism").on) << file;
        EXPECT_TRUE(plan.item("absorption").on) << file;
    }
}

// Fresnel's equations: at Brewster's angle light that vibrates in the plane of incidence is not
// reflected; light across it is by ((n^2 - 1) / (n^2 + 1))^2, 15.5 % for n = 1.5168.
TEST(GalleryOfBrewster, TheTableShinesInOneVibrationOnly) {
    const auto table_of = [](const char* file) {
        Scene scene = gallery_scene(file);
        const RenderResult result = render(scene);
        // Above the middle, where only the lamp's mirror image and the dim room are visible.
        const float* rgb = result.picture.at(80, 83);
        return static_cast<double>(rgb[1]);
    };
    const double dark = table_of("brewster.toml"), shining = table_of("brewster-glare.toml");
    EXPECT_NEAR(shining - dark, 0.155 * 3.0, 0.08) << "the lamp's radiance is 3 in its middle";
    EXPECT_LT(dark, 0.15) << "the room's is 0.1";
}

TEST(Explain, HasALineForEveryEffectOfTheCatalogue) {
    Scene scene = small_scene("garnet_almandine");
    scene.stone.material.absorption_per_mm = {};
    const ScenePlan plan = plan_scene(scene);
    std::vector<std::string> names;
    for (const PlanItem& line : plan.items) {
        names.push_back(line.name);
        EXPECT_FALSE(line.why.empty()) << line.name;
        EXPECT_GT(line.seconds_with, 0) << line.name;
        EXPECT_GT(line.seconds_without, 0) << line.name;
    }
    EXPECT_EQ(names, (std::vector<std::string>{"dispersion", "birefringence", "polarization",
                                               "absorption", "pleochroism", "aperture", "coherence",
                                               "depth", "wavelengths", "samples", "light_edges",
                                               "environment_filter", "objects"}));
    EXPECT_EQ(plan.item("birefringence").why, "garnet is isotropic");
    EXPECT_EQ(plan.item("absorption").why, "garnet is clear");
    EXPECT_EQ(plan.item("aperture").why, "pinhole camera");
    EXPECT_EQ(plan.item("environment_filter").why, "there is no environment map");
    EXPECT_EQ(plan.item("light_edges").why, "no light has an edge");
}

TEST(Explain, MeasuresWhatTheSceneSwitchesOff) {
    Scene scene = gallery_scene("zircon-doubling.toml");
    scene.settings.effects_auto = false;
    scene.settings.effects.fill(false);
    const ScenePlan plan = plan_scene(scene), told = plan_to_explain(scene);
    const PlanItem& split = told.item("birefringence");
    EXPECT_FALSE(split.on);
    EXPECT_GT(split.bound, 0.05) << "the scene is made for it";
    EXPECT_GT(split.seconds_with, 5 * split.seconds_without) << "trees double";
    EXPECT_GE(told.bound, split.matters);
    EXPECT_LT(plan.bound, 0.05) << "a picture is drawn as it was asked for";
    EXPECT_EQ(told.item("absorption").bound, 0) << "zircon is clear";
    EXPECT_EQ(told.settings.samples, plan.settings.samples);
}

// Adding powers is exact where light comes equally from all directions and nothing absorbs;
// elsewhere interference near the optic axis changes the picture.
TEST(Explain, BoundsWhatInterferenceWouldChange) {
    Scene even = gallery_scene("zircon-doubling.toml");
    even.lights.sources.clear();
    EXPECT_EQ(plan_scene(even).item("coherence").bound, 0);
    const ScenePlan plan = plan_scene(gallery_scene("zircon-doubling.toml"));
    const PlanItem& line = plan.item("coherence");
    EXPECT_FALSE(line.on);
    EXPECT_GT(line.bound, 0);
    EXPECT_GE(line.bound, line.matters);
    EXPECT_NE(line.why.find("waves behind"), std::string::npos) << line.why;
    EXPECT_LT(plan.bound, line.bound) << "it is the light's matter, beside the sum";
}

}  // namespace

}  // namespace culet
