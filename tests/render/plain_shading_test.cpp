// The plain shadings: flat, Gouraud and Phong, and what their pictures share. Expectations: closed
// forms, stated with each test.

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "render/optics/conductor.h"
#include "render/render.h"
#include "render/scene/framing.h"
#include "render/shaded/local_shading.h"
#include "render/shaded/shaded_picture.h"
#include "stone/cuts/cuts.h"
#include "stone/material/material.h"
#include "stone/text/errors.h"
#include "tests/render/shaded_scenes.h"

namespace culet {
namespace {

constexpr double k_pi = std::numbers::pi;

using test::diffuse;
using test::down;
using test::scene_of_objects;
using test::sphere;
using test::sun;

// Lambert: a white sphere of albedo a, lit by irradiance pi from direction l, shows a max(0, n.l).
TEST(Phong, ALambertSphereUnderADistantLight) {
    Scene scene = scene_of_objects({sphere(diffuse(0.6))});
    const Vec3 toward = glm::normalize(Vec3(1, 2, 3));
    scene.lights.sources.push_back(sun(toward));
    scene.shading.specular = 0;
    const LocalShader shader(scene, LocalShading::phong);
    for (const double x : {-0.9, -0.3, 0.0, 0.5, 0.8}) {
        const Vec3 normal(x, 0.2, std::sqrt(1 - x * x - 0.04));
        const LocalShader::Seen seen = shader.shade(down(x, 0.2));
        EXPECT_TRUE(seen.met);
        for (const double c : seen.colour)
            EXPECT_NEAR(c, 0.6 * std::max(0.0, glm::dot(normal, toward)), 1e-9);
    }
    EXPECT_FALSE(shader.shade(down(1.1, 0)).met);
}

// Phong: where the normal bisects the angle between light and eye the highlight is k_s L; at an
// angle b between reflected light and eye it is k_s L cos^m b.
TEST(Phong, AHighlightHasTheValueOfItsFormula) {
    Scene scene = scene_of_objects({sphere(diffuse(0))});
    const double angle = 0.4;
    scene.lights.sources.push_back(sun({std::sin(angle), 0, std::cos(angle)}));
    scene.shading.specular = 0.7;
    scene.shading.exponent = 20;
    const LocalShader shader(scene, LocalShading::phong);
    for (const double off : {0.0, 0.05, -0.1, 0.3}) {
        // Turning the normal by `off` turns the reflected light by twice that.
        const double normal = 0.5 * angle + off;
        const Rgb seen = shader.shade(down(std::sin(normal), 0)).colour;
        EXPECT_NEAR(seen[1], 0.7 * std::pow(std::cos(2 * off), 20), 1e-7) << off;
    }
}

// c + l a + q a^2, with a the distance relative to that of the scene's middle; the strength of a
// sphere light there is its radiance times (radius / distance)^2.
TEST(Phong, LightFadesWithDistanceAsItsThreeTermsSay) {
    Scene scene = scene_of_objects({{DiscShape{{0, 0, 0}, {0, 0, 1}, 5}, diffuse(1)}}, 12);
    scene.camera.position = {0, 0, 10};
    SphereLight lamp;
    lamp.center = {0, 0, 4};
    lamp.radius = 0.5;
    lamp.radiance.value = 3.0;
    scene.lights.sources.push_back(lamp);
    scene.shading.specular = 0;
    for (const std::array<double, 3>& attenuation :
         {std::array{0.0, 0.0, 1.0}, std::array{1.0, 0.0, 0.0}, std::array{0.2, 0.3, 0.5}}) {
        scene.shading.attenuation = attenuation;
        const LocalShader shader(scene, LocalShading::phong);
        for (const double x : {1.0, 2.0, 3.0}) {
            const double distance = std::hypot(x, 4.0), a = distance / 4;
            const double expected = 3 * std::pow(0.5 / 4, 2) * (4 / distance) /
                                    (attenuation[0] + attenuation[1] * a + attenuation[2] * a * a);
            // The lamp itself hides the middle.
            EXPECT_NEAR(shader.shade(down(x, 0)).colour[0], expected, 1e-9 * expected);
        }
    }
}

// Ambient light alone: albedo times the mean of the light over all directions, which is 1 for a
// hemisphere of radiance 2.
TEST(Phong, AmbientLightIsTheMeanOfAllDirections) {
    Scene scene = scene_of_objects({sphere(diffuse(0.25))});
    scene.lights.constant = 0.5;
    scene.lights.sources.push_back(HemisphereLight{{0, 0, 1}, LightColour{2.0}});
    const LocalShader shader(scene, LocalShading::phong);
    for (const double c : shader.shade(down(0.3, 0.4)).colour) EXPECT_NEAR(c, 0.25 * 1.5, 1e-9);
    // A miss shows the light: a constant 0.5 from below.
    for (const double c : shader.shade(down(1.2, 0)).colour) EXPECT_NEAR(c, 0.5, 1e-9);
}

// On one flat facet whose corners have its own normal, under a distant light, every corner has the
// facet's colour: Gouraud equals flat shading.
TEST(Gouraud, EqualsFlatShadingForOneFacet) {
    auto mesh = std::make_shared<TriangleMesh>();
    mesh->vertices = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
    mesh->triangles = {{0, 1, 2}};
    Scene scene = scene_of_objects({{MeshShape{mesh}, diffuse(0.5)}});
    scene.lights.sources.push_back(sun({1, 0, 2}));
    scene.shading.specular = 0;
    const LocalShader flat(scene, LocalShading::flat), gouraud(scene, LocalShading::gouraud);
    for (const auto& [x, y] : {std::pair{0.0, 0.0}, {0.4, -0.5}, {-0.3, 0.2}}) {
        const double expected = 0.5 * 2 / std::sqrt(5.0);
        EXPECT_NEAR(flat.shade(down(x, y)).colour[0], expected, 1e-9);
        EXPECT_NEAR(gouraud.shade(down(x, y)).colour[0], expected, 1e-9);
    }
}

// Two squares meet at a ridge in right angles. On the ridge the mean of their normals points up, on
// the outer edges it is each square's own. Between them Gouraud's colour is linear.
TEST(Gouraud, InterpolatesColoursOfCorners) {
    auto mesh = std::make_shared<TriangleMesh>();
    mesh->vertices = {{-1, -1, -1}, {0, -1, 0}, {0, 1, 0}, {-1, 1, -1}, {1, -1, -1}, {1, 1, -1}};
    mesh->triangles = {{0, 1, 2}, {0, 2, 3}, {1, 4, 5}, {1, 5, 2}};
    Scene scene = scene_of_objects({{MeshShape{mesh}, diffuse(1)}});
    scene.lights.sources.push_back(sun({0, 0, 1}));
    scene.shading.specular = 0;
    const LocalShader gouraud(scene, LocalShading::gouraud), flat(scene, LocalShading::flat),
        phong(scene, LocalShading::phong);
    // At the ridge 1, at the edge cos 45 degrees. Corner 1 has one triangle of the left square and
    // two of the right one, corner 2 the reverse: their normals are mirror images at the same angle
    // to the light. The middle of the ridge is between them.
    const double edge = std::sqrt(0.5);
    const Vec3 left(-1, 0, 1), right(1, 0, 1);
    const double ridge = glm::normalize(left + 2.0 * right).z;
    EXPECT_NEAR(flat.shade(down(0.3, 0.1)).colour[0], edge, 1e-9);
    EXPECT_NEAR(gouraud.shade(down(-1e-9, 0)).colour[0], ridge, 1e-6);
    EXPECT_NEAR(gouraud.shade(down(-0.5, 0)).colour[0], 0.5 * (ridge + edge), 1e-6);
    // Phong's normal there is the normalised mean of both corners': straight up on the ridge.
    EXPECT_NEAR(phong.shade(down(-1e-9, 0)).colour[0], 1, 1e-6);
}

TEST(Flat, AStonesFacetHasOneColour) {
    Scene scene;
    scene.stone.solid = make_cut("round-brilliant");
    scene.stone.material = catalogue_material("diamond");
    frame_stone(scene.stone.solid, Facing::crown, scene.camera);
    scene.lights.sources.push_back(sun({1, 1, 2}));
    SphereLight lamp;
    lamp.center = {20, 0, 30};
    lamp.radiance.value = 5.0;
    scene.lights.sources.push_back(lamp);
    const LocalShader flat(scene, LocalShading::flat), phong(scene, LocalShading::phong);
    const Rgb middle = flat.shade(down(0, 0)).colour;
    EXPECT_EQ(flat.shade(down(1.2, 0.6)).colour, middle);
    EXPECT_NE(phong.shade(down(1.2, 0.6)).colour, phong.shade(down(0, 0)).colour);
    // A clear stone's body colour is white. The table faces up: Lambert's law for both lights, plus
    // the model's highlights.
    EXPECT_GT(middle[0], 2 / std::sqrt(6.0));
}

// Metals: Fresnel's equations at normal incidence, ((n - 1)^2 + k^2) / ((n + 1)^2 + k^2), and 1 at
// grazing incidence.
TEST(PlainSurface, MetalsReflectAsTheirIndexSays) {
    EXPECT_NEAR(conductor_reflectance(0.2, 3.0, 1), (0.64 + 9) / (1.44 + 9), 1e-12);
    EXPECT_NEAR(conductor_reflectance(0.2, 3.0, 0), 1, 1e-12);
    // Without absorption: glass. At Brewster's angle (tan = n) p is 0 and s is ((n^2 - 1)/(n^2 +
    // 1))^2.
    const double n = 1.5, cosine = 1 / std::sqrt(1 + n * n);
    EXPECT_NEAR(conductor_reflectance(n, 0, cosine), 0.5 * std::pow(1.25 / 3.25, 2), 1e-12);
}

// The mean of a pixel's rays, over the edge of a disc that covers a known part of the picture.
TEST(ShadedPicture, AveragesItsRays) {
    Scene scene = scene_of_objects({{DiscShape{{0, 0, 0}, {0, 0, 1}, 1}, diffuse(1)}}, 4);
    scene.lights.sources.push_back(sun({0, 0, 1}));
    scene.shading.specular = 0;
    scene.camera.width = scene.camera.height = 8;
    scene.settings.samples = 400;
    scene.settings.engine = "phong";
    const RenderResult result = render(scene);
    double sum = 0, covered = 0;
    for (std::size_t i = 0; i < result.picture.pixels(); ++i) {
        sum += static_cast<double>(result.picture.rgb[3 * i]);
        covered += static_cast<double>(result.picture.coverage[i]);
    }
    // Of 64 pixels of 0.5 x 0.5 the disc covers pi / 0.25. A regular grid of 20 x 20 rays per pixel
    // counts an area to within (its border x the grid's step) / 2, and much closer because the
    // border's errors have either sign.
    const double bound = 2 * k_pi * (0.5 / 20) / 2 / 0.25;
    EXPECT_NEAR(sum, k_pi / 0.25, bound);
    EXPECT_NEAR(covered, sum, 1e-4);
    EXPECT_NEAR(result.stats.mean_radiance, 1, 1e-6);
}

TEST(ShadedPicture, IsTheSameWhateverTheThreads) {
    Scene scene = scene_of_objects({sphere(MetalMaterial{{0.2}, {3.0}, {}, 0.4}),
                                    {PlaneShape{{0, 0, -1}, {0, 0, 1}}, diffuse(0.4)}});
    scene.lights.constant = 0.3;
    scene.lights.sources.push_back(sun({1, 2, 3}));
    scene.settings.engine = "whitted";
    scene.settings.samples = 4;
    scene.settings.threads = 1;
    const RenderResult one = render(scene);
    scene.settings.threads = 3;
    EXPECT_EQ(render(scene).picture.rgb, one.picture.rgb);
    // Another seed changes the rough reflections.
    scene.settings.seed = 2;
    EXPECT_NE(render(scene).picture.rgb, one.picture.rgb);
}

TEST(ShadedPicture, RefusesPolarisationAndSpectra) {
    Scene scene = scene_of_objects({sphere(diffuse(0.5))});
    scene.lights.constant = 1;
    for (const char* engine : {"flat", "gouraud", "phong", "whitted"}) {
        scene.settings.engine = engine;
        Scene refused = scene;
        refused.camera.optics.analyzer = 0.0;
        EXPECT_THROW(render(refused), InputError);
        refused = scene;
        refused.settings.spectral = true;
        EXPECT_THROW(render(refused), InputError);
    }
}

}  // namespace
}  // namespace culet
