#include "compare/calibration/hypotheses.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "compare/calibration/cropped_camera.h"
#include "compare/scores/chance.h"
#include "render/render.h"
#include "render/scene/turned_lights.h"
#include "stone/numbers/units.h"
#include "tests/compare/study_scene.h"

namespace culet {
namespace {

Camera turned_camera(Camera camera, const glm::dmat3& by, const Vec3& about) {
    camera.position = about + by * (camera.position - about);
    camera.look_at = about + by * (camera.look_at - about);
    camera.up = by * camera.up;
    return camera;
}

double mean_difference(const Picture& a, const Picture& b) {
    double sum = 0, scale = 0;
    for (std::size_t i = 0; i < a.rgb.size(); ++i) {
        sum += std::abs(static_cast<double>(a.rgb[i] - b.rgb[i]));
        scale += static_cast<double>(a.rgb[i]);
    }
    return sum / scale;
}

Scene lit_scene() {
    Scene scene = test::cube_scene();
    scene.settings.engine = "reference";
    scene.settings.samples = 1;
    scene.settings.wavelengths_nm = {550};
    scene.settings.effects_auto = false;
    scene.lights.sources.push_back(DiscLight{glm::normalize(Vec3{1, 0.5, 0.3}), 0, 0.4, {2.0}});
    scene.lights.sources.push_back(SphereLight{Vec3{5, -6, 8}, 2, {3.0}});
    PlaneLight plane;
    plane.point = {0, 0, -6};
    plane.normal = {0, 0, 1};
    plane.u = Vec3{2, 0, 0};
    plane.v = Vec3{0, 3, 0};
    plane.radiance = {1.0};
    scene.lights.sources.push_back(plane);
    return scene;
}

// Optics has no preferred direction: stone, lights and camera turned together give the same
// picture, except for pixels at edges that rounding moves.
TEST(TurnedWorld, AsAWholeLooksTheSame) {
    const Scene scene = lit_scene();
    const glm::dmat3 by = rotation_about(glm::normalize(Vec3{1, 2, -0.5}), 1.1);
    const Vec3 about{0.2, -0.1, 0.4};
    Scene turned = scene;
    turned.stone = turned_stone(scene.stone, by, about);
    turned.lights = turned_lights(scene.lights, by, about);
    turned.camera = turned_camera(scene.camera, by, about);
    const Picture before = render(scene).picture, after = render(turned).picture;
    EXPECT_LT(mean_difference(before, after), 2e-3);
    // Turning any of them alone changes it.
    Scene light = scene;
    light.lights = turned_lights(scene.lights, by, about);
    EXPECT_GT(mean_difference(before, render(light).picture), 0.05);
}

TEST(TurnedWorld, EnvironmentIsSeenWhereItWasTurnedTo) {
    EnvironmentMap map{128, 64, {}};
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 128; ++x) {
            const double polar = 3.14159265358979 * (y + 0.5) / 64;
            map.rgb.push_back(static_cast<float>(1 + std::cos(polar)));
            map.rgb.push_back(
                static_cast<float>(2 + std::sin(polar) * std::cos(6.28318530718 * x / 128)));
            map.rgb.push_back(0.5f);
        }
    }
    Lights lights;
    lights.environment = std::make_shared<const EnvironmentMap>(map);
    Chance chance(3);
    const glm::dmat3 by = rotation_about(chance.direction(), 0.8);
    const Lights turned = turned_lights(lights, by, {0, 0, 0});
    const Lights same = turned_lights(lights, glm::dmat3(1), {0, 0, 0});
    for (int i = 0; i < 50; ++i) {
        const Vec3 direction = chance.direction();
        const Rgb was = lights.environment->at(direction),
                  is = turned.environment->at(by * direction);
        for (std::size_t c = 0; c < 3; ++c) {
            // Two bilinear look-ups in a map with texels of 2.8 degrees: second differences of 1/8
            // (2 pi / 128)^2 in each direction, and the pole.
            EXPECT_NEAR(is[c], was[c], 0.01);
            EXPECT_NEAR(same.environment->at(direction)[c], was[c], 1e-3);
        }
    }
}

TEST(Materials, AreChangedByWhatWasAsked) {
    for (const char* name : {"diamond", "quartz", "tourmaline_dravite", "glass_bk7", "peridot"}) {
        const Material material = catalogue_material(name);
        const Material higher = with_index_changed(material, 0.02),
                       flat = without_dispersion(material);
        for (int r = 0; r < ray_count(material.optic); ++r) {
            const auto k = static_cast<std::size_t>(r);
            EXPECT_NEAR(higher.index[k].at(589.3) - material.index[k].at(589.3), 0.02, 1e-6)
                << name;
            // For a Sellmeier index the step is 0.02 n_D / n: dispersion changes it by a few per
            // cent.
            EXPECT_NEAR(higher.index[k].at(450) - material.index[k].at(450), 0.02, 1e-3) << name;
            EXPECT_EQ(flat.index[k].at(450), flat.index[k].at(650)) << name;
            EXPECT_NEAR(flat.index[k].at(500), material.index[k].at(589.3), 1e-12) << name;
        }
    }
    const Material ruby = catalogue_material("tourmaline_dravite");
    EXPECT_NEAR(with_absorption_times(ruby, 1.3).absorption_per_mm[0].at(500),
                1.3 * ruby.absorption_per_mm[0].at(500), 1e-12);
}

TEST(Materials, NeighboursAreOthersAndTheNearestFirst) {
    const Material diamond = catalogue_material("diamond");
    const auto neighbours = neighbouring_materials(diamond, 3);
    ASSERT_EQ(neighbours.size(), 3u);
    double before = 0;
    for (const Material& other : neighbours) {
        const double apart = std::abs(other.index[0].at(589.3) - diamond.index[0].at(589.3));
        EXPECT_GT(apart, 0.001);
        EXPECT_GE(apart + 0.2, before);
        before = apart;
    }
    EXPECT_TRUE(neighbouring_materials(diamond, 0).empty());
}

// A ray through a pixel of the crop is the ray through the same point of the whole picture.
TEST(CroppedCamera, SeesAlongTheSameRays) {
    Scene scene = test::cube_scene();
    for (const bool orthographic : {false, true}) {
        Camera camera = scene.camera;
        camera.width = 300;
        camera.height = 200;
        camera.look_at = {0.3, -0.2, 0};
        if (orthographic) camera.orthographic_width = 9;
        const Camera cut = cropped_to_stone(camera, scene.stone.solid, 64, 0.2);
        EXPECT_NEAR(projected_diameter(scene.stone.solid, cut), 64, 1e-3);
        const auto whole = projected_corners(scene.stone.solid, camera),
                   part = projected_corners(scene.stone.solid, cut);
        const EyeRays from(camera), to(cut);
        ASSERT_EQ(whole.size(), part.size());
        for (std::size_t i = 0; i < whole.size(); ++i) {
            const EyeRay a = from.through(whole[i][0], whole[i][1]),
                         b = to.through(part[i][0], part[i][1]);
            EXPECT_LT(glm::length(a.direction - b.direction), 1e-9);
            EXPECT_LT(glm::length(a.origin - b.origin), 1e-9);
            // It also meets the corner.
            const Vec3 towards = scene.stone.solid.vertices[i] - a.origin;
            EXPECT_LT(glm::length(glm::cross(towards, a.direction)), 1e-9);
        }
    }
}

}  // namespace
}  // namespace culet
