// Expectations: the reference renderer, ray by ray; conservation of energy; and the same code
// compiled for other processors.

#include "render/beams/beam_shading.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/render/beams/beam_lights.h"

namespace {

using namespace culet;

// One ray through the middle of each pixel, like the reference with one sample. Single precision
// has a rounding unit of 6e-8. After six facets the direction is off by some 1e-6, and lobes of
// exponent 120 make this 1e-4. `most_off`: the share of pixels that close to an edge of a facet or
// light.
void expect_as_reference(Scene scene, double most_off = 1e-3) {
    const RenderResult beams = with_engine(scene, "beams", 1),
                       reference = with_engine(scene, "reference", 1);
    const Difference d = difference(beams.picture, reference.picture, 1e-4);
    ASSERT_GT(d.pixels, 500);
    EXPECT_EQ(d.not_finite, 0) << d;
    EXPECT_LE(d.off, std::max(2.0, std::ceil(most_off * d.pixels))) << d;
    // The remainder is that of the same rays; a few pixels at edges take another path.
    EXPECT_NEAR(beams.stats.remainder, reference.stats.remainder + reference.stats.cut, 2e-4) << d;
    EXPECT_NEAR(beams.stats.absorbed, reference.stats.absorbed, 2e-4);
    EXPECT_NEAR(beams.stats.mean_radiance / reference.stats.mean_radiance, 1, 2e-3) << d;
    double covered = 0, exact = 0;
    for (std::size_t i = 0; i < beams.picture.pixels(); ++i) {
        covered += static_cast<double>(beams.picture.coverage[i]);
        exact += static_cast<double>(reference.picture.coverage[i]);
    }
    EXPECT_NEAR(covered, exact, std::max(2.0, most_off * exact));
}

Scene shaded_scene() {
    Scene scene = plain_scene(round_brilliant());
    look(scene, {0.21, 0.34, 1}, 10);
    return scene;
}
Scene random_scene(std::mt19937_64& random, int planes) {
    Scene scene = plain_scene(random_stone(random, planes));
    look(scene, random_direction(random), 9, 1.5);
    return scene;
}

TEST(SingleRays, AreTheReferencesInEveryLight) {
    std::mt19937_64 random(20280);
    for (const auto& lights : {edgeless_lights(), edged_lights()}) {
        for (const NamedChange& light : lights) {
            SCOPED_TRACE("seed 20280, " + light.name);
            for (Scene scene : {shaded_scene(), random_scene(random, 16)}) {
                light.make(scene);
                expect_as_reference(scene);
            }
        }
    }
}

TEST(SingleRays, AreTheReferencesThroughAllOptics) {
    std::mt19937_64 random(20281);
    for (const NamedChange& change : optics()) {
        SCOPED_TRACE("seed 20281, " + change.name);
        for (Scene scene : {shaded_scene(), random_scene(random, 16)}) {
            edgeless_lights()[1].make(scene);
            scene.lights.constant = 0.3;
            nth_light<CosinePowerLight>(scene.lights, 0).radiance.value = Rgb{1.0, 2.0, 3.0};
            change.make(scene);
            expect_as_reference(scene);
        }
    }
}

TEST(SingleRays, AreTheReferencesInAnEnvironment) {
    for (const int width : {8, 64, 512}) {
        for (const bool spectral : {false, true}) {
            SCOPED_TRACE(width);
            Scene scene = shaded_scene();
            scene.lights.constant = 0;
            scene.lights.environment = smooth_environment(width);
            if (spectral) scene.settings.wavelengths_nm = {450, 550, 640};
            const RenderResult beams = with_engine(scene, "beams", 1),
                               reference = with_engine(scene, "reference", 1);
            const Difference d = difference(beams.picture, reference.picture, 1e-2);
            EXPECT_EQ(d.not_finite, 0);
            // The octahedral map interpolates between other points than the lat-long one: the error
            // is the square of a texel times the curvature, about 1/8 (2 pi / width)^2.
            const double texel = 2 * 3.1416 / width;
            EXPECT_LE(d.mean, 0.25 * texel * texel + 2e-4) << d;
        }
    }
}

TEST(SingleRays, AreTheReferencesAtEveryDepth) {
    for (const int depth : {1, 2, 3, 12, 24}) {
        SCOPED_TRACE(depth);
        Scene scene = shaded_scene();
        edgeless_lights()[1].make(scene);
        scene.settings.depth = depth;
        // Every facet met adds borders between paths, and rounding error.
        expect_as_reference(scene, 1e-3 * std::max(1, depth / 6));
    }
}

TEST(SingleRays, AreTheReferencesFrom101DiametersAndNearer) {
    const Solid solid = round_brilliant();
    for (const Vec3& from : {Vec3{0.21, 0.34, 1}, Vec3{0.1, 0.2, -1}, Vec3{1, 0.2, 0.1}}) {
        for (const double distance : {1.01 * 2, 1.2}) {
            SCOPED_TRACE(std::to_string(distance) + " from z " + std::to_string(from.z));
            Scene scene = plain_scene(solid);
            edgeless_lights()[1].make(scene);
            look(scene, from, distance);
            expect_as_reference(scene);
        }
    }
}

TEST(SingleRays, AreTheReferencesOfStonesWithSlivers) {
    std::mt19937_64 random(20282);
    for (int i = 0; i < 8; ++i) {
        SCOPED_TRACE("seed 20282, stone " + std::to_string(i));
        Scene scene = plain_scene(stone_with_slivers(random, 3 + 5 * i));
        edgeless_lights()[1].make(scene);
        look(scene, random_direction(random), 9, 1.5);
        expect_as_reference(scene);
    }
}

TEST(SingleRays, AreTheReferencesWhereOnlyAPartIsSeen) {
    Scene scene = shaded_scene();
    edgeless_lights()[1].make(scene);
    scene.camera.look_at = {0.4, 0.3, 0};
    scene.camera.fov = 0.06;
    expect_as_reference(scene);
    scene.camera.width = 131;
    scene.camera.height = 37;
    expect_as_reference(scene);
}

// In a constant light of 1 the light seen, absorbed and remaining adds up to 1. The mean radiance
// is a luminance, the others are means over wavelengths; with one wavelength they agree.
TEST(Furnace, SendsBackWhatGoesIn) {
    std::mt19937_64 random(20283);
    for (const std::string engine : {"beams", "preview"}) {
        for (const int samples : {1, 16}) {
            for (const NamedChange& change : optics()) {
                SCOPED_TRACE(engine + ", seed 20283, " + change.name);
                Scene scene = random_scene(random, 14);
                scene.lights.constant = 1;
                change.make(scene);
                if (scene.settings.wavelengths_nm.size() > 1) scene.settings.wavelengths_nm = {520};
                for (const int depth : {2, 14}) {
                    scene.settings.depth = depth;
                    const RenderResult result = with_engine(scene, engine, samples);
                    const RenderStats& stats = result.stats;
                    EXPECT_NEAR(stats.mean_radiance + stats.remainder + stats.absorbed, 1, 1e-5)
                        << "depth " << depth;
                    for (float v : result.picture.rgb) ASSERT_TRUE(std::isfinite(v));
                }
            }
        }
    }
}

TEST(Furnace, CountsWhatIsCut) {
    for (const std::string engine : {"beams", "preview"}) {
        for (const double tolerance : {0.1, 0.01}) {
            Scene scene = shaded_scene();
            scene.settings.tolerance = tolerance;
            scene.settings.depth = 0;
            const RenderStats stats = with_engine(scene, engine, 16).stats;
            EXPECT_NEAR(stats.mean_radiance + stats.remainder, 1, 1e-5);
            EXPECT_GT(stats.remainder, 0);
            EXPECT_GT(stats.error_bound, stats.remainder);
        }
    }
}

class Targets : public testing::Test {
protected:
    void TearDown() override { use_shading_target(shading_targets().front()); }
};

// The same operations at another vector width; fused multiply-adds round once instead of twice.
// Near the critical angle the exit direction turns by the root of a rounding unit, 3e-4. There a
// pixel may see a tenth of a radian of a light with an edge: 3e-3 of the light, for few pixels. The
// centroid of a part of a pixel is off by the rounding error of its moments over its area, 2e-5
// pixels in regions 50 wide; for light that leaves at grazing angles a map changes by several times
// its mean over a pixel: 1e-4.
TEST_F(Targets, OfEveryInstructionSetDrawTheSamePicture) {
    std::vector<NamedChange> lights = edged_lights();
    const std::size_t edged = lights.size();
    lights.push_back(edgeless_lights()[2]);
    lights.push_back({"environment", [](Scene& s) {
                          s.lights = {};
                          s.lights.environment = smooth_environment();
                      }});
    for (std::size_t number = 0; number < lights.size(); ++number) {
        const NamedChange& light = lights[number];
        const double tolerance = number < edged ? 3e-3 : number == edged ? 2e-5 : 1e-4;
        for (const int samples : {1, 16}) {
            SCOPED_TRACE(light.name);
            Scene scene = shaded_scene();
            light.make(scene);
            optics()[5].make(scene);
            ASSERT_TRUE(use_shading_target(shading_targets().front()));
            const RenderResult best = with_engine(scene, "beams", samples);
            for (const std::string& target : shading_targets()) {
                ASSERT_TRUE(use_shading_target(target));
                const RenderResult other = with_engine(scene, "beams", samples);
                const Difference d = difference(other.picture, best.picture, tolerance);
                EXPECT_LE(d.off, std::max(2.0, 1e-3 * d.pixels)) << target << ": " << d;
                EXPECT_LE(d.mean, 1e-5) << target << ": " << d;
                EXPECT_EQ(d.not_finite, 0);
                use_shading_target(shading_targets().front());
            }
        }
    }
    EXPECT_FALSE(use_shading_target("abacus"));
}

}  // namespace
