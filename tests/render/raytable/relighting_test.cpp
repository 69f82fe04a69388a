// Pictures from ray tables against the reference along the same rays, within the bounds of
// rounding_bounds.h.

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <numbers>
#include <numeric>

#include "render/beams/beam_shading.h"
#include "render/scene/light_presets.h"
#include "tests/render/raytable/rounding_bounds.h"

namespace culet {
namespace {

using test::Apart;
using test::apart;
using test::brilliant;
using test::by_reference;
using test::in_material;
using test::relit_by;
using test::table_of;

using test::bound_of_lobes;
using test::expect_equal_but_for_rounding;
using test::k_direction;
using test::k_rounding;
using test::lit;
using test::slope_of_lobes;

TEST(Relighting, InSmoothLightIsTheReferenceWithinTheBound) {
    const Scene scene = brilliant();
    const RayTable table = table_of(scene);
    const Picture truth = by_reference(scene).picture;
    const Apart fast = apart(relit_by(table, scene).picture, truth);
    EXPECT_LT(fast.worst, bound_of_lobes());
    const Apart plain =
        apart(relit_by(table, scene, ExitPrecision::double_precision).picture, truth);
    EXPECT_LT(plain.worst, 1e-9 * slope_of_lobes() + k_rounding * 7.8);
    // The requirement.
    EXPECT_LT(fast.mean, 1e-3);
}

TEST(Relighting, OfOneTableIsDrawingAnewInEveryPreset) {
    Scene scene = brilliant();
    scene.settings.wavelengths_nm = {450, 550, 610};
    scene.settings.effects[static_cast<std::size_t>(Effects::dispersion)] = false;
    const RayTable table = table_of(scene);
    for (const LightPreset& preset : light_presets()) {
        SCOPED_TRACE(preset.name);
        const Scene now = lit(scene, *light_preset(preset.name));
        if (std::string(preset.name) == "daylight") {
            // A smooth lobe beside a sun of 60.
            const Apart off = apart(relit_by(table, now).picture, by_reference(now).picture);
            EXPECT_LT(off.worst, 1.3 * std::sqrt(6) * k_direction + k_rounding * 64);
        } else {
            expect_equal_but_for_rounding(now, table, 6);
        }
    }
}

TEST(Relighting, KeepsTheBoundsWhateverTheProcessorHas) {
    Scene scene = brilliant();
    scene.settings.wavelengths_nm = {450, 550, 610};
    scene.settings.effects[static_cast<std::size_t>(Effects::dispersion)] = false;
    scene.stone.material.absorption_per_mm[0] = Spectrum(0.2);
    const RayTable table = table_of(scene);
    const Picture truth = by_reference(scene).picture;
    const double absorption = 0.2 * 0.5 * table.header().length_step * 7.8;
    for (const std::string& target : shading_targets()) {
        ASSERT_TRUE(use_shading_target(target));
        EXPECT_LT(apart(relit_by(table, scene).picture, truth).worst, bound_of_lobes() + absorption)
            << target;
    }
    use_shading_target(shading_targets().front());
}

TEST(Relighting, SeesNearLightsOneBeforeTheOtherAndBeforeTheStone) {
    const Scene scene = brilliant();
    const RayTable table = table_of(scene);
    const double size = diameter(scene.stone.solid);
    Lights lights;
    lights.constant = 0.1;
    lights.sources.push_back(SphereLight{Vec3{-size, size, 2 * size}, 0.5 * size, {4.0}});
    lights.sources.push_back(SphereLight{Vec3{-2 * size, 2 * size, 4 * size}, 1.5 * size, {1.0}});
    // Half in front of the stone, as seen by the eye.
    lights.sources.push_back(
        SphereLight{2.0 * size * bench_view() + Vec3{0.3 * size, 0, 0}, 0.2 * size, {0.5}});
    PlaneLight panel;
    panel.point = {-2 * size, 0, 2 * size};
    panel.normal = glm::normalize(Vec3{1, 0, -1});
    panel.u = Vec3{0, size, 0};
    panel.v = size * glm::normalize(Vec3{1, 0, 1});
    panel.radiance = {2.0};
    lights.sources.push_back(panel);
    expect_equal_but_for_rounding(lit(scene, lights), table, 5);
    const Picture picture = relit_by(table, lit(scene, lights)).picture;
    const Picture bare = relit_by(table, scene).picture;
    EXPECT_LT(std::accumulate(picture.coverage.begin(), picture.coverage.end(), 0.0),
              std::accumulate(bare.coverage.begin(), bare.coverage.end(), 0.0) - 20);
}

// Lights beyond the vectors' capacity are evaluated one by one.
TEST(Relighting, SeesAnyNumberOfNearLights) {
    const Scene scene = brilliant(24);
    const RayTable table = table_of(scene);
    Lights lights;
    for (int i = 0; i < 20; ++i) {
        const double azimuth = 2 * std::numbers::pi * i / 20;
        lights.sources.push_back(SphereLight{
            Vec3{6 * std::cos(azimuth), 6 * std::sin(azimuth), 5}, 0.9, {1.0 + 0.1 * i}});
    }
    expect_equal_but_for_rounding(lit(scene, lights), table, 3);
}

TEST(Relighting, SeesAnEnvironmentAsTheReferenceDoes) {
    Scene scene = brilliant();
    scene.settings.wavelengths_nm = {450, 550, 610};
    scene.settings.effects[static_cast<std::size_t>(Effects::dispersion)] = false;
    const RayTable table = table_of(scene);
    auto map = std::make_shared<EnvironmentMap>();
    map->width = 64;
    map->height = 32;
    for (int i = 0; i < 64 * 32; ++i) {
        for (int c = 0; c < 3; ++c)
            map->rgb.push_back(static_cast<float>(0.5 + 0.5 * std::sin(1.3 * i + c)));
    }
    Lights lights;
    lights.environment = map;
    const Scene now = lit(scene, lights);
    const Apart off = apart(relit_by(table, now).picture, by_reference(now).picture);
    EXPECT_GT(off.brightest, 0.5);
    // Neighbouring texels differ by at most 1 and are 2 pi / 64 wide at the equator. A column's
    // position is off by the direction's error over the sine of the polar angle; the first row of
    // texel centres has sin(pi / 64). The row of a point next to a pole may be off by half a digit.
    EXPECT_LT(off.worst, 4 * (k_direction + 4 * 0x1p-24 * std::numbers::pi) * 64 /
                             (2 * std::numbers::pi) / std::sin(std::numbers::pi / 64));
}

TEST(Relighting, IsTheSameWhateverTheThreads) {
    for (Scene scene : {brilliant(40), in_material(brilliant(12), "zircon_high")}) {
        scene.settings.threads = 1;
        const RayTable one = table_of(scene);
        const Picture alone = relit_by(one, scene).picture;
        for (const int threads : {2, 3}) {
            scene.settings.threads = threads;
            const RayTable many = table_of(scene);
            EXPECT_EQ(many.header().checksum, one.header().checksum);
            EXPECT_EQ(relit_by(many, scene).picture.rgb, alone.rgb);
        }
    }
}

}  // namespace
}  // namespace culet
