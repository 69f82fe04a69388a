// Whitted's rays: mirrors, glass, stones, shadows. Expectations: closed forms and conservation of
// energy, stated with each test.

#include "render/shaded/whitted.h"

#include <gtest/gtest.h>

#include <cmath>

#include "stone/cuts/cuts.h"
#include "tests/render/shaded_scenes.h"

namespace culet {
namespace {

using test::diffuse;
using test::down;
using test::scene_of_objects;
using test::sphere;
using test::sun;

// A mirror sphere shows at each point what is in the mirror direction 2 (n.e) n - e: here a lobe of
// radiance cos^4 about x, times the mirror's albedo.
TEST(Whitted, AMirrorSphereReflectsTheEnvironment) {
    Scene scene = scene_of_objects({sphere(MirrorMaterial{SurfaceColour{0.8}})});
    scene.lights.sources.push_back(CosinePowerLight{{1, 0, 0}, 4, LightColour{1.0}});
    const WhittedTracer tracer(scene, 5);
    for (const double x : {0.1, 0.4, 0.6, 0.7}) {
        const double along = 2 * x * std::sqrt(1 - x * x - 0.01);
        const Rgb seen = tracer.trace(down(x, 0.1), 0).colour;
        EXPECT_NEAR(seen[2], 0.8 * std::pow(along, 4), 1e-9) << x;
    }
}

// A glass ball on its axis between a light above (radiance 1) and none below: the front reflects R
// = ((n - 1) / (n + 1))^2; inside, every second pass returns upwards: T^2 R (1 + R^2 + R^4 + ...).
// Transmitted light leaves into the dark below. With 12 faces the remainder is below R^11.
TEST(Whitted, AGlassBallOnItsAxisSumsFresnel) {
    DielectricMaterial glass;
    glass.index = 2.4;
    glass.absorption.value = 0.1;
    Scene scene = scene_of_objects({sphere(glass)});
    scene.lights.sources.push_back(HemisphereLight{{0, 0, 1}, LightColour{1.0}});
    const WhittedTracer tracer(scene, 12);
    const double r = std::pow(1.4 / 3.4, 2), t = 1 - r, left = std::exp(-0.1 * 2);
    const double expected = r + t * t * r * left * left / (1 - r * r * left * left);
    // Pruned below 1/2048 of the ray, at most three times.
    EXPECT_NEAR(tracer.trace(down(0, 0), 0).colour[0], expected, 3.0 / 2048);
    // A stone of the same index is the same physics: a plate that a ray meets perpendicularly.
    Scene stone = scene_of_objects({});
    stone.stone.solid = make_cut("step");
    stone.stone.material.index[0].n = 2.4;
    stone.lights = scene.lights;
    const WhittedTracer gem(stone, 1);
    EXPECT_NEAR(gem.trace(down(0, 0), 0).colour[0], r, 1e-9);
}

// In a furnace of radiance 1 clear glass and stones show 1, less the remainder of their paths:
// conservation of energy.
TEST(Whitted, ClearThingsVanishInAFurnace) {
    for (const char* cut : {"round-brilliant", "heart"}) {
        Scene scene = scene_of_objects({{SphereShape{{0, 0, -8}, 3}, DielectricMaterial{}}}, 9);
        scene.stone.solid = make_cut(cut);
        scene.stone.convex = std::string(cut) != "heart";
        scene.stone.material.index[0].n = 1.5;
        scene.lights.constant = 1;
        const WhittedTracer tracer(scene, 40);
        int met = 0;
        double sum = 0;
        for (int i = 0; i < 400; ++i) {
            const auto seen = tracer.trace(down(-4 + 0.4 * (i % 20), -4 + 0.4 * (i / 20)), 0);
            met += seen.met ? 1 : 0;
            EXPECT_LE(seen.colour[1], 1 + 1e-9);
            sum += 1 - seen.colour[1];
        }
        EXPECT_GT(met, 100) << cut;
        // Total reflections may continue for long; on average little remains.
        EXPECT_LT(sum / met, 0.03) << cut;
    }
}

// A disc under an opaque sphere has only ambient light; under glass it has more.
TEST(Whitted, OpaqueThingsThrowShadows) {
    for (const bool clear : {false, true}) {
        const SurfaceMaterial material =
            clear ? SurfaceMaterial(DielectricMaterial{}) : SurfaceMaterial(diffuse(0.5));
        Scene scene = scene_of_objects({{SphereShape{{0, 0, 3}, 1}, material},
                                        {PlaneShape{{0, 0, 0}, {0, 0, 1}}, diffuse(0.5)}});
        scene.lights.constant = 0.2;
        scene.lights.sources.push_back(sun({1, 0, 1}));
        const WhittedTracer tracer(scene, 5);
        // The light comes from +x at 45 degrees: the shadow's middle is at x = -3.
        const double lit = 0.5 * (0.2 + std::sqrt(0.5));
        EXPECT_NEAR(tracer.trace(down(2, 0), 0).colour[0], lit, 1e-9);
        EXPECT_NEAR(tracer.trace(down(-3, 0), 0).colour[0], clear ? lit : 0.5 * 0.2, 1e-9);
    }
}

}  // namespace
}  // namespace culet
