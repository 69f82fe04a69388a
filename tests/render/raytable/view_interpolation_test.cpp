// Views between stored ones.
// Expectations: a stored view is itself; sums of shares; conservation of energy; what is between
// comes nearer the reference as the steps get smaller.

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <numbers>

#include "render/raytable/view_interpolation.h"
#include "render/render.h"
#include "stone/output_file.h"
#include "tests/render/raytable/table_scenes.h"
#include "tests/scratch_folder.h"

namespace culet {
namespace {

using test::brilliant;

constexpr double k_pi = std::numbers::pi;

Scene seen_from(double polar, double azimuth, int pixels = 64) {
    Scene scene = brilliant(pixels);
    Camera& camera = scene.camera;
    const double distance = glm::length(camera.position - camera.look_at);
    camera.position =
        camera.look_at + distance * Vec3{std::sin(polar) * std::cos(azimuth),
                                         std::sin(polar) * std::sin(azimuth), std::cos(polar)};
    return scene;
}

std::vector<ViewTable> tables_about(const Scene& scene, double step) {
    std::vector<ViewTable> tables;
    for (const StoredView& view : stored_views(scene.camera, step)) {
        Scene seen = scene;
        seen.camera = view.camera;
        tables.push_back({view, test::table_of(seen)});
    }
    return tables;
}

RenderResult between(const Scene& scene, double step) {
    const RayTable table = interpolated(scene, table_rays(scene), tables_about(scene, step), {});
    return test::relit_by(table, scene);
}

TEST(StoredViews, LieAboutTheViewAtWholeSteps) {
    for (const double polar : {0.0, 0.02, 0.33, 1.3, 3.1, k_pi}) {
        for (const double azimuth : {-3.0, -0.05, 0.0, 0.31, 3.1}) {
            const Scene scene = seen_from(polar, azimuth, 8);
            const Vec3& middle = scene.camera.look_at;
            const Vec3 towards = glm::normalize(scene.camera.position - middle);
            double whole = 0;
            for (const StoredView& view : stored_views(scene.camera, 0.1)) {
                whole += view.share;
                EXPECT_GT(view.share, 0);
                EXPECT_NEAR(glm::length(view.camera.position - middle),
                            glm::length(scene.camera.position - middle), 1e-12);
                // At most a diagonal of a cell away.
                const double away = angle_between(view.camera.position - middle, towards);
                EXPECT_LT(away, 0.1 * std::sqrt(2) + 1e-9);
            }
            EXPECT_NEAR(whole, 1, 1e-9);
        }
    }
    // 3.1416 is 32 steps of not more than 0.1, and 6.2832 are 63.
    EXPECT_EQ(stored_views(seen_from(0, 0.3, 8).camera, 0.1).front().name,
              "polar-0000-azimuth-0000.rays");
    const auto one = stored_views(seen_from(4 * k_pi / 32, 62 * 2 * k_pi / 63, 8).camera, 0.1);
    ASSERT_EQ(one.size(), 1u);
    EXPECT_EQ(one.front().name, "polar-0004-azimuth-0062.rays");
    EXPECT_EQ(stored_views(seen_from(0.33, 6.25, 8).camera, 0.1).size(), 4u);
    Scene lens = seen_from(0.3, 0.3, 8);
    lens.camera.aperture_radius = 0.1;
    EXPECT_THROW(stored_views(lens.camera, 0.1), InputError);
    // There are 64 steps of the azimuth, so that one of them is along up.
    EXPECT_THROW(stored_views(seen_from(k_pi / 2, k_pi / 2, 8).camera, k_pi / 32), InputError);
}

TEST(ScreenPlace, IsWhereTheEyeRayCameFrom) {
    Scene scene = seen_from(0.4, 0.9, 40);
    scene.camera.principal_point = {{13.5, 22}};
    for (const bool parallel : {false, true}) {
        if (parallel) scene.camera.orthographic_width = 3;
        const ScreenPlace place(scene.camera);
        const EyeRays eyes(scene.camera);
        for (const double x : {0.0, 11.25, 39.0}) {
            const EyeRay ray = eyes.through(x, 17.5);
            const auto found = place.of(ray.origin + 3.7 * ray.direction);
            EXPECT_NEAR(found[0], x, 1e-9);
            EXPECT_NEAR(found[1], 17.5, 1e-9);
        }
    }
}

// Rounded twice: weights are floats both times, points and lengths go from one rectangle to another
// and matter for near lights and body colours alone.
TEST(ViewInterpolation, OfAStoredViewIsThatView) {
    const Scene scene = seen_from(4 * k_pi / 32, 2 * k_pi * 3 / 63);
    ASSERT_EQ(stored_views(scene.camera, 0.1).size(), 1u);
    const Picture picture = between(scene, 0.1).picture;
    const Picture stored = test::relit_by(test::table_of(scene), scene).picture;
    const test::Apart off = test::apart(picture, stored);
    EXPECT_EQ(picture.coverage, stored.coverage);
    // The stored camera differs in last digits, and a pixel on an edge may go the other way.
    EXPECT_LT(off.mean, 1e-4);
}

TEST(ViewInterpolation, KeepsTheEnergy) {
    Scene scene = seen_from(0.37, 0.47);
    scene.lights = {};
    scene.lights.constant = 1;
    const RenderStats stats = between(scene, 0.1).stats;
    // The tables' means stand for the rays that are used.
    EXPECT_NEAR(stats.mean_radiance + stats.remainder + stats.cut, 1, 0.02);
    Scene deep = scene;
    deep.settings.depth = 400;
    const RenderResult result = between(deep, 0.1);
    EXPECT_NEAR(result.stats.mean_radiance + result.stats.cut, 1, 1e-4);
}

TEST(ViewInterpolation, ComesNearerWithSmallerSteps) {
    const Scene scene = seen_from(0.37, 0.47, 96);
    const Picture truth = test::by_reference(scene).picture;
    const double coarse = test::apart(between(scene, 0.2).picture, truth).mean;
    const double middle = test::apart(between(scene, 0.05).picture, truth).mean;
    const double fine = test::apart(between(scene, 0.0125).picture, truth).mean;
    EXPECT_LT(middle, 0.75 * coarse);
    EXPECT_LT(fine, 0.75 * middle);
}

TEST(ViewInterpolation, IsTheSameWhateverTheThreads) {
    Scene scene = seen_from(0.37, 0.47, 32);
    scene.settings.threads = 1;
    const std::vector<ViewTable> tables = tables_about(scene, 0.1);
    const RayTable one = interpolated(scene, table_rays(scene), tables, {});
    scene.settings.threads = 3;
    EXPECT_EQ(interpolated(scene, table_rays(scene), tables, {}).header().checksum,
              one.header().checksum);
}

TEST(ViewInterpolation, KeepsItsViewsInAFolder) {
    const test::ScratchFolder folder;
    Scene scene = seen_from(0.37, 0.47, 24);
    scene.settings.engine = k_raytable_engine;
    scene.settings.ray_views = folder / "views";
    const RenderResult first = render(scene);
    EXPECT_TRUE(std::isnan(first.stats.error_bound));
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder / "views"), {}), 4);
    const RenderResult again = render(scene);
    EXPECT_EQ(again.picture.rgb, first.picture.rgb);
    // Another depth is another table.
    scene.settings.depth = 5;
    EXPECT_THROW((void)render(scene), InputError);
    scene.settings.depth = 6;
    scene.settings.reflection_factor = 0.2;
    EXPECT_THROW((void)render(scene), InputError);
}

}  // namespace
}  // namespace culet
