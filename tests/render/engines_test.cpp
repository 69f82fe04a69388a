// Engines, the settings stored for redrawing a picture, and the stone's surroundings.

#include <gtest/gtest.h>

#include <numeric>
#include <set>

#include "render/engine/engine.h"
#include "render/reference/gather.h"
#include "render/reference/pixel_shader.h"
#include "render/render.h"
#include "render/scene/engine_name.h"
#include "render/scene/scene_io.h"
#include "render/scene/settings_io.h"
#include "render/scene/turntable.h"
#include "stone/design/design.h"
#include "stone/solid/checks.h"
#include "stone/text/errors.h"
#include "tests/render/bench_scenes.h"
#include "tests/render/gpu/gpu_scenes.h"

namespace culet {
namespace {

constexpr const char* k_scene = CULET_SOURCE_DIR "/samples/effects/garnet-depth.toml";

Scene small_scene(const std::vector<std::string>& more = {}) {
    std::vector<std::string> settings{"camera.size=[24,24]"};
    settings.insert(settings.end(), more.begin(), more.end());
    return read_scene(k_scene, settings);
}

TEST(Engines, CanBeNamedByScenes) {
    std::set<std::string> names;
    for (const Engine* engine : engines()) {
        EXPECT_TRUE(names.insert(engine->name()).second) << engine->name() << " is there twice";
        EXPECT_EQ(&engine_named(engine->name()), engine);
        const Scene scene = small_scene({"render.engine=\"" + engine->name() + "\""});
        EXPECT_EQ(scene.settings.engine, engine->name());
        EXPECT_EQ(&engine_of(scene.settings), engine);
    }
    EXPECT_EQ(engine_names().size(), engines().size() + 1);
    EXPECT_EQ(engine_names().front(), k_auto_engine);
}

// The price is a model of the work, not a clock: more of anything never costs less.
TEST(Engines, AskMoreForMoreWork) {
    DrawingWork work;
    work.pixels = 1000;
    for (const Engine* engine : engines()) {
        const double little = engine->cost_ns(work);
        EXPECT_GT(little, 0) << engine->name();
        for (double DrawingWork::*more : {&DrawingWork::pixels, &DrawingWork::views,
                                          &DrawingWork::bands, &DrawingWork::faces_per_ray}) {
            DrawingWork larger = work;
            larger.*more *= 4;
            EXPECT_GT(engine->cost_ns(larger), little) << engine->name();
        }
    }
}

TEST(Engines, DrawWhatTheyDoNotRefuseAndSayWhyTheyDo) {
    for (const Engine* engine : engines()) {
        Scene scene = small_scene();
        scene.settings.engine = engine->name();
        EXPECT_EQ(engine->refuses(scene, make_optical_setup(scene)), "");
        // It cannot draw without a driver; its own tests say so.
        if (engine->name() == k_gpu_engine && !missing_driver().empty()) continue;
        const RenderResult result = engine->draw(scene, {});
        EXPECT_EQ(result.stats.engine, engine->name());
        EXPECT_GT(result.stats.mean_radiance, 0);
        scene.camera.optics.two_windows = true;
        const std::string why = engine->refuses(scene, make_optical_setup(scene));
        if (engine->name() == k_reference_engine) {
            EXPECT_EQ(why, "");
        } else {
            EXPECT_NE(why.find("two"), std::string::npos) << why;
        }
    }
}

// In even light a stone is as bright as what surrounds it, however its facets scatter (a furnace).
TEST(Engines, DrawFrostedFacetsOrSayWhyNot) {
    Scene scene = small_scene();
    scene.lights = {};
    scene.lights.constant = 1;
    scene.settings.tolerance = 0;
    Design design = drawn_design(scene.stone.solid);
    for (DesignTier& tier : design.tiers) tier.frosting = tier.setting.pavilion ? 0.5 : 0;
    scene.stone.solid.design = std::make_shared<const Design>(design);
    scene.settings.samples = 16;
    scene.settings.effects_auto = false;
    scene.settings.effects = {};
    for (const Engine* engine : engines()) {
        scene.settings.engine = engine->name();
        const std::string why = engine->refuses(scene, make_optical_setup(scene));
        const bool scatters = engine->name() == k_reference_engine;
        if (!why.empty()) {
            EXPECT_FALSE(scatters) << why;
            EXPECT_NE(why.find(" frosted"), std::string::npos) << why;
            continue;
        }
        const RenderResult result = engine->draw(scene, {});
        const std::vector<std::string>& notes = result.stats.notes;
        const bool said = std::any_of(notes.begin(), notes.end(), [](const std::string& note) {
            return note.find("frosted tiers are drawn polished") != std::string::npos;
        });
        EXPECT_EQ(said, !scatters) << engine->name();
        if (scatters) {
            EXPECT_NEAR(result.stats.mean_radiance, 1, 1e-3);
        }
    }
    scene.immersion = 1.33;
    EXPECT_THROW(make_optical_setup(scene), InputError);
}

// Written to the last digit, so that another run draws the same picture.
TEST(Settings, ReadBackAsTheyWereWritten) {
    const std::vector<std::vector<std::string>> cases{
        {},
        {"effects=[]", "wavelengths=[589.3]"},
        {"engine=\"beams\"", "effects=[\"dispersion\",\"coherence\"]", "crystal_beams=\"split\"",
         "cut_weight=0.1234567890123456", "split_weight=1e-7", "tolerance=0.07",
         "clamp_indirect=12.5"},
        {"engine=\"reference\"", "samples=49", "wavelength_turns=7", "depth=12", "tolerance=0",
         "coherence=true", "bandwidth=3.5", "wavelengths=[450,550.25,610]"},
        {"engine=\"preview\"", "refraction=\"parallel\"", "coherence=false"},
    };
    for (const std::vector<std::string>& keys : cases) {
        std::vector<std::string> given, again;
        for (const std::string& key : keys) given.push_back("render." + key);
        const RenderSettings settings = small_scene(given).settings;
        for (const auto& [key, value] : written_settings(settings))
            again.push_back("render." + key + "=" + value);
        const RenderSettings read = read_scene(k_scene, again).settings;
        EXPECT_EQ(written_settings(read), written_settings(settings));
        EXPECT_EQ(read.engine, settings.engine);
        EXPECT_EQ(read.effects, settings.effects);
        EXPECT_EQ(read.effects_auto, settings.effects_auto);
        EXPECT_EQ(read.wavelengths_nm, settings.wavelengths_nm);
        EXPECT_EQ(read.cut_weight, settings.cut_weight);
        EXPECT_EQ(read.split_weight, settings.split_weight);
        EXPECT_EQ(read.tolerance, settings.tolerance);
        EXPECT_EQ(read.clamp_indirect, settings.clamp_indirect);
        EXPECT_EQ(read.samples, settings.samples);
        EXPECT_EQ(read.wavelength_turns, settings.wavelength_turns);
        EXPECT_EQ(read.coherence, settings.coherence);
        EXPECT_EQ(read.crystal_beams, settings.crystal_beams);
        EXPECT_EQ(read.bandwidth_nm, settings.bandwidth_nm);
    }
}

// Every direction is equally bright.
class EvenGlow : public Surroundings {
public:
    explicit EvenGlow(double radiance) : radiance_(radiance) {}
    void add_radiance(const Vec3&, const Vec3&, double weight, int, int count,
                      double* radiance) const override {
        for (int i = 0; i < count; ++i) radiance[i] += weight * radiance_;
    }
    void add_stokes(const PathEnd&, int, int, double*, int) const override {
        FAIL() << "nothing polarised was asked for";
    }
    void add_direct_stokes(const EyeRay&, const EyeFrame&, int, double*) const override {
        FAIL() << "nothing polarised was asked for";
    }
    double nearest_distance(const Vec3&, const Vec3&) const override {
        return std::numeric_limits<double>::infinity();
    }
    bool stands_at(const Vec3&, const Vec3&) const override { return false; }
    std::string name_at(const Vec3&, const Vec3&) const override { return "glow"; }
    double max_radiance() const override { return radiance_; }

private:
    double radiance_;
};

// Conservation of energy: a clear stone in a furnace of radiance 2 shows 2, whatever it reflects
// and refracts, less the remainder of its paths.
TEST(Surroundings, AreAskedByEveryPathThatLeavesTheStone) {
    const Scene scene = small_scene({"render.depth=60", "render.tolerance=0.001"});
    PreparedScene prepared(scene);
    prepared.surroundings = std::make_unique<EvenGlow>(2);
    const PixelShader shader(scene, prepared, 4);
    ASSERT_EQ(shader.planes(), 1);
    std::vector<double> stokes(static_cast<std::size_t>(prepared.colours.size()));
    PixelMemory memory;
    int hits = 0;
    for (int pixel = 0; pixel < 24 * 24; ++pixel) {
        const PixelSums sums = shader.shade(pixel % 24, pixel / 24, 1, 0, stokes.data(), memory);
        if (sums.hit > 0) ++hits;
        // Losses are reported as the mean over wavelengths.
        const double mean =
            std::accumulate(stokes.begin(), stokes.end(), 0.0) / static_cast<double>(stokes.size());
        EXPECT_NEAR(mean, 2 * (1 - sums.remainder - sums.cut - sums.absorbed), 1e-12);
    }
    EXPECT_GT(hits, 100);
}

// Weights below the smallest number are dropped and must not be divided by.
TEST(Gather, LeavesOutWhatIsAbsorbedToNothing) {
    const EvenGlow glow(2);
    Band band;
    band.count = 2;
    std::vector<double> radiance(2, 0.0);
    Gather<false> gather(glow, band, radiance.data());
    gather.path_exits({0, 0, 0}, {0, 0, 1}, NodeWeights{}, PathTrace{});
    EXPECT_EQ(radiance, (std::vector<double>{0, 0}));
    NodeWeights weight{};
    weight[1] = 0.25;
    gather.path_exits({0, 0, 0}, {0, 0, 1}, weight, PathTrace{});
    EXPECT_EQ(radiance, (std::vector<double>{0, 0.5}));
}

TEST(Turntable, KeepsTheStoneAndComesRound) {
    const Scene scene = small_scene();
    const Solid& before = scene.stone.solid;
    const double size = diameter(before);
    const Scene quarter = turned(scene, std::acos(0.0));
    EXPECT_NEAR(volume(quarter.stone.solid), volume(before), 1e-12 * volume(before));
    EXPECT_LT(glm::length(centroid(quarter.stone.solid) - centroid(before)), 1e-12 * size);
    EXPECT_LT(planarity(quarter.stone.solid), planarity(before) + 1e-12 * size);
    EXPECT_GT(glm::length(quarter.stone.solid.vertices[1] - before.vertices[1]), 0.01 * size);
    Scene round = scene;
    for (int i = 0; i < 4; ++i) round = turned(round, std::acos(0.0));
    for (std::size_t v = 0; v < before.vertices.size(); ++v)
        EXPECT_LT(glm::length(round.stone.solid.vertices[v] - before.vertices[v]), 1e-12 * size);
}

TEST(AsPlanned, AnotherPictureIsDrawnAsTheFirstAndSaysSo) {
    Scene scene = small_scene({"render.tolerance=0.1"});
    const RenderResult first = render(scene);
    ASSERT_TRUE(first.stats.plan.has_value());
    EXPECT_EQ(first.stats.plan->checked_bound, first.stats.error_bound);
    const RenderResult again = render_as_planned(scene, *first.stats.plan);
    EXPECT_EQ(again.picture.rgb, first.picture.rgb);
    EXPECT_EQ(again.stats.error_bound, first.stats.error_bound);
    EXPECT_EQ(again.stats.checked_pixels, 0);
    ASSERT_FALSE(again.stats.notes.empty());
    EXPECT_NE(again.stats.notes.back().find("earlier picture"), std::string::npos);
}

TEST(Checks, CostWhatTheySay) {
    Scene scene = small_scene({"render.tolerance=0.1"});
    scene.settings.check = Check::none;
    const RenderStats none = render(scene).stats;
    EXPECT_EQ(none.checked_pixels, 0);
    EXPECT_TRUE(std::isnan(none.error_bound));
    scene.settings.check = Check::estimate;
    const RenderStats estimate = render(scene).stats;
    EXPECT_GT(estimate.checked_pixels, 0);
    EXPECT_GT(estimate.error_bound, 0);
    EXPECT_EQ(estimate.engine, none.engine);
    EXPECT_EQ(estimate.beams, none.beams);
}

}  // namespace
}  // namespace culet
