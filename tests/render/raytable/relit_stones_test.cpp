// Stones of every kind from ray tables, with other body colours and weights.
//
// Expectations: the reference along the same rays, within the bounds of rounding_bounds.h; closed
// forms of series; conservation of energy.

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "render/scene/light_presets.h"
#include "tests/render/raytable/rounding_bounds.h"

namespace culet {
namespace {

using test::Apart;
using test::apart;
using test::bound_of_lobes;
using test::brilliant;
using test::by_reference;
using test::expect_equal_but_for_rounding;
using test::in_material;
using test::k_rounding;
using test::lit;
using test::relit_by;
using test::table_of;

TEST(RelitStones, FurnaceShowsOneButForWhatTheTableLeavesOut) {
    Lights furnace;
    furnace.constant = 1;
    std::vector<Scene> scenes{brilliant(), in_material(brilliant(16), "zircon_high"),
                              test::with_solid(brilliant(24), carved::star_prism(), false)};
    for (Scene& scene : scenes) {
        scene = lit(scene, furnace);
        const RayTable table = table_of(scene);
        const RenderStats stats = relit_by(table, scene).stats;
        EXPECT_NEAR(stats.mean_radiance + stats.remainder + stats.cut, 1, k_rounding);
        EXPECT_EQ(stats.absorbed, 0);
    }
    // Where almost nothing is left out each pixel is 1, like the air around it.
    Scene deep = scenes[0];
    deep.settings.depth = 400;
    const RenderResult result = relit_by(table_of(deep), deep);
    for (const float value : result.picture.rgb)
        EXPECT_NEAR(static_cast<double>(value), 1, 1e-4 + result.stats.remainder * 1e4);
    EXPECT_LT(result.stats.remainder, 1e-6);
}

TEST(RelitStones, TakesAnotherBodyColourWithoutTracing) {
    Scene clear = brilliant();
    clear.settings.wavelengths_nm = {450, 550, 610};
    clear.settings.effects[static_cast<std::size_t>(Effects::dispersion)] = false;
    const RayTable table = table_of(clear);
    Scene red = clear;
    const double strongest = 0.8;  // per mm
    red.stone.material.absorption_per_mm[0] = Spectrum({450, 550, 610}, {0.3, strongest, 0.02});
    const RenderResult result = relit_by(table, red), truth = by_reference(red);
    const Apart off = apart(result.picture, truth.picture);
    // exp(-K L) changes by K dL at most, and dL is half a step.
    const double length = 0.5 * table.header().length_step;
    EXPECT_LT(off.worst, bound_of_lobes() + strongest * length * 7.8);
    EXPECT_GT(apart(result.picture, relit_by(table, clear).picture).worst, 0.1);
    // The absorbed light, and on average the exits, equal the reference's. But the reference counts
    // what stays inside at the depth limit after absorption, as absorbed.
    EXPECT_GE(result.stats.remainder, truth.stats.remainder);
    EXPECT_NEAR(result.stats.remainder + result.stats.absorbed,
                truth.stats.remainder + truth.stats.absorbed, 1e-5);
}

TEST(RelitStones, OfACrystalTakesTheAbsorptionOfEachWave) {
    Scene scene = in_material(brilliant(20), "sapphire_blue");
    scene.settings.wavelengths_nm = {589.3};
    Scene clear = scene;
    for (Spectrum& spectrum : clear.stone.material.absorption_per_mm) spectrum = Spectrum(0.0);
    const RayTable table = table_of(clear);
    ASSERT_EQ(table.header().lengths, 3u);
    ASSERT_EQ(table.header().cut, 0);
    for (const double darker : {1.0, 4.0}) {
        Scene now = scene;
        double strongest = 0;
        for (Spectrum& spectrum : now.stone.material.absorption_per_mm) {
            spectrum = spectrum.scaled(darker);
            strongest = std::max(strongest, spectrum.at(589.3));
        }
        ASSERT_GT(strongest, 0);
        const Apart off = apart(relit_by(table, now).picture, by_reference(now).picture);
        EXPECT_LT(off.worst,
                  bound_of_lobes() * 4 + 3 * strongest * 0.5 * table.header().length_step * 7.8);
    }
}

TEST(RelitStones, OfTreesIsTheReference) {
    Lights lights = *light_preset("jeweller");
    const std::vector<Scene> scenes{in_material(brilliant(20), "zircon_high"),
                                    in_material(brilliant(20), "topaz_imperial"),
                                    test::with_solid(brilliant(32), carved::star_prism(), false),
                                    test::with_solid(brilliant(32), carved::crag(3), false)};
    for (const Scene& scene : scenes) {
        SCOPED_TRACE(scene.stone.material.name);
        expect_equal_but_for_rounding(lit(scene, lights), table_of(scene), 6);
    }
    Scene liquid = in_material(brilliant(20), "topaz_imperial");
    liquid.immersion = 1.5;
    // Transmitted light, with the light behind the stone.
    expect_equal_but_for_rounding(lit(liquid, *light_preset("lightbox")), table_of(liquid), 6);
}

TEST(RelitStones, OfTreesThatWereCutIsWithinTheBoundThatItStates) {
    Scene scene = in_material(brilliant(16), "zircon_high");
    scene.settings.depth = 9;
    const Picture truth = by_reference(scene).picture;
    scene.settings.tolerance = 0.01;
    for (const double cut : {1e-2, 1e-3}) {
        scene.settings.cut_weight = cut;
        const RayTable table = table_of(scene);
        const RenderResult result = relit_by(table, scene);
        EXPECT_GT(result.stats.cut, 0);
        // In addition to paths that the depth ends, in both pictures.
        const double bound = result.stats.cut * 7.8 / result.stats.mean_radiance;
        EXPECT_LT(apart(result.picture, truth).mean, bound);
        EXPECT_GE(result.stats.error_bound, 0.9 * bound);
    }
}

TEST(RelitStones, WithDispersionKeepsEachWavelengthApart) {
    Scene scene = brilliant(32);
    scene.settings.wavelengths_nm = {430, 520, 589.3, 660};
    scene.settings.spectral = true;
    const RayTable table = table_of(scene);
    ASSERT_EQ(table.header().bands, 4u);
    const Scene now = lit(scene, *light_preset("lightbox"));
    const RenderResult result = relit_by(table, now);
    Scene plain = now;
    plain.settings.spectral = false;  // S0 alone takes the shorter code path
    EXPECT_LT(apart(result.picture, by_reference(plain).picture).worst, k_rounding * 6);
    ASSERT_EQ(result.picture.spectral.size(), 4u);
    const Picture spectral = by_reference(now).picture;
    for (std::size_t node = 0; node < 4; ++node) {
        for (std::size_t i = 0; i < spectral.pixels(); ++i)
            EXPECT_NEAR(result.picture.spectral[node][i], spectral.spectral[node][i],
                        k_rounding * 6);
    }
}

TEST(RelitStones, GoesByEveryCamera) {
    std::vector<Scene> scenes{brilliant(24), brilliant(24), brilliant(24), brilliant(24)};
    scenes[0].settings.samples = 9;
    scenes[0].settings.filter = PixelFilter::gaussian;
    scenes[0].settings.filter_radius = 1;
    scenes[1].camera.orthographic_width = 2.5;
    scenes[2].camera.aperture_radius = 0.3;
    scenes[2].camera.focus_distance = glm::length(scenes[2].camera.position);
    scenes[2].settings.samples = 7;
    scenes[3].camera.cone = 0.4;
    for (Scene& scene : scenes) {
        scene.lights.sources.push_back(SphereLight{Vec3{4, 0, 4}, 1, {2.0}});
        const RayTable table = table_of(scene);
        const Apart off = apart(relit_by(table, scene).picture, by_reference(scene).picture);
        EXPECT_GT(off.brightest, 0.1);
        EXPECT_LT(off.worst, bound_of_lobes());
    }
}

// Lee's factors: a ray with m exits sends R out at once and T T R^(k - 1) at its k-th inner face
// that lets light out; with R + T = 1 the whole series is R + T T / (1 - R) = 1.
TEST(RelitStones, TakesConstantFactorsForFresnels) {
    Scene scene = lit(brilliant(32), {});
    scene.lights.constant = 1;
    const RayTable table = table_of(scene);
    const double R = 0.2, T = 0.7;
    scene.settings.reflection_factor = R;
    scene.settings.transmission_factor = T;
    const Picture picture = relit_by(table, scene).picture;
    const auto& parts = table.parts();
    std::uint32_t before = 0;
    for (std::size_t hit = 0; hit < parts.hit_ray.size(); ++hit) {
        const std::uint32_t exits = parts.exits_end[hit] - before;
        before = parts.exits_end[hit];
        ASSERT_GT(exits, 0u);
        const double sum = R + T * T * (1 - std::pow(R, exits - 1)) / (1 - R);
        EXPECT_NEAR(picture.rgb[3 * parts.hit_ray[hit]], sum, k_rounding);
    }
    Scene deep = scene;
    deep.settings.depth = 400;
    deep.settings.transmission_factor = 1 - R;
    const Picture whole = relit_by(table_of(deep), deep).picture;
    for (const float value : whole.rgb) EXPECT_NEAR(static_cast<double>(value), 1, 1e-4);
}

}  // namespace
}  // namespace culet
