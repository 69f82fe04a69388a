// Hard cases, each by name. Expectations: the reference renderer, and the promises of the headers.

#include <gtest/gtest.h>

#include <cmath>

#include "render/beams/beam_tree.h"
#include "render/beams/environment_pyramid.h"
#include "render/beams/frame_renderer.h"
#include "render/beams/pixel_coverage.h"
#include "tests/render/beams/beam_lights.h"

namespace {

using namespace culet;

Scene hard_scene() {
    Scene scene = plain_scene(round_brilliant());
    look(scene, {0.21, 0.34, 1}, 10);
    return scene;
}

// A ray that meets other facets than its beam is retraced with the stone's index relative to the
// surrounding medium.
TEST(HardCases, RetracedRaysOfAnImmersedStoneAreTheReferences) {
    Scene scene = hard_scene();
    edgeless_lights()[1].make(scene);
    scene.immersion = 1.33;
    scene.stone.material.index[0].n = 1.76;
    const RenderResult beams = with_engine(scene, "beams", 1),
                       reference = with_engine(scene, "reference", 1);
    EXPECT_GT(beams.stats.retraced, 0);
    const Difference d = difference(beams.picture, reference.picture);
    EXPECT_LE(d.off, 2) << d;
}

// The maps of Voelker & Hamann follow one ray per front facet, which may leave the unfolded stone.
TEST(HardCases, MapsOfFrontFacetsLoseAndDoubleNoArea) {
    for (const bool parallel_camera : {true, false}) {
        for (const Refraction kind : {Refraction::perspective, Refraction::parallel}) {
            Scene scene = hard_scene();
            look(scene, {0.1, 0.23, 1}, 12);
            scene.camera.width = scene.camera.height = 401;
            if (parallel_camera) scene.camera.orthographic_width = 2.2;
            const FacetNet net(scene.stone.solid);
            BeamLimits limits;
            limits.depth = 7;
            limits.refraction = kind;
            BeamTree tree;
            build_beams(net, screen_view(scene.camera), 2.417, limits, tree);
            EXPECT_NEAR(tree.exit_area() / tree.front_area, 1, 4e-5);
        }
    }
}

// Parallel rays stay parallel: all kinds of map are equal and exact.
TEST(HardCases, AllRefractionsDrawTheSameOrthographicPicture) {
    Scene scene = hard_scene();
    edgeless_lights()[1].make(scene);
    scene.camera.orthographic_width = 2.2;
    const RenderResult exact = with_engine(scene, "beams", 16);
    for (const Refraction kind : {Refraction::perspective, Refraction::parallel}) {
        scene.settings.refraction = kind;
        const Difference d =
            difference(with_engine(scene, "beams", 16).picture, exact.picture, 1e-3);
        EXPECT_LE(d.off, 5) << d;
    }
}

// A wrong sequence may lead a ray anywhere, but it must not give NaN, and must not make a bound 0.
TEST(HardCases, NearLightsSeenAlongWrongSequencesAreNumbers) {
    std::mt19937_64 random(20286);
    for (int i = 0; i < 12; ++i) {
        for (const Refraction kind :
             {Refraction::astigmatic, Refraction::perspective, Refraction::parallel}) {
            SCOPED_TRACE("seed 20286, stone " + std::to_string(i));
            Scene scene = plain_scene(random_stone(random, 16));
            scene.camera.width = scene.camera.height = 64;
            look(scene, random_direction(random), 9, 1.5);
            edged_lights()[2].make(scene);
            scene.settings.refraction = kind;
            scene.settings.depth = 8;
            const RenderResult result = with_engine(scene, "beams", 16);
            int bad = 0;
            for (const float v : result.picture.rgb) bad += !std::isfinite(v);
            EXPECT_EQ(bad, 0) << "refraction " << static_cast<int>(kind);
            EXPECT_GT(result.stats.error_bound, 0);
        }
    }
}

// Parallel rays have the same direction in every pixel: a distant light's edge has no gradient.
TEST(HardCases, OrthographicPicturesInLightsWithEdgesAreNumbers) {
    for (const std::string engine : {"beams", "preview"}) {
        for (const std::size_t light : {0u, 1u, 6u}) {
            Scene scene = hard_scene();
            edged_lights()[light].make(scene);
            scene.camera.orthographic_width = 2.2;
            const RenderResult beams = with_engine(scene, engine, 16);
            int bad = 0;
            for (const float v : beams.picture.rgb) bad += !std::isfinite(v);
            EXPECT_EQ(bad, 0) << engine << ", " << edged_lights()[light].name;
            EXPECT_GT(beams.stats.error_bound, 0);
        }
    }
}

// In a light of 1 from everywhere a pixel brighter than 1 was painted twice. Views from close by,
// and of symmetric stones whose edges run through pixel centres.
TEST(HardCases, NothingIsBrighterThanTheFurnace) {
    for (const int samples : {1, 16}) {
        for (const std::string cut : {"round-brilliant", "step", "princess"}) {
            for (const Vec3& from : {Vec3{0, 0, 1}, Vec3{0, 0, -1}, Vec3{0.2, 0.5, 0.6}}) {
                for (const double distance : {0.7, 1.01, 6.0}) {
                    const Solid solid = make_cut(cut);
                    const double size = diameter(solid);
                    Scene scene = plain_scene(solid);
                    scene.camera.width = scene.camera.height = 81;
                    look(scene, from, distance * size, 0.55 * size);
                    const RenderResult beams = with_engine(scene, "beams", samples);
                    int bright = 0;
                    float most = 0;
                    for (const float v : beams.picture.rgb) {
                        bright += v > 1.0001f;
                        most = std::max(most, v);
                    }
                    EXPECT_EQ(bright / 3, 0)
                        << cut << " from (" << from.x << ", " << from.y << ", " << from.z << ") at "
                        << distance << " diameters, " << samples << " samples: up to " << most;
                }
            }
        }
    }
}

// Where a map does not quite lead a region onto the stone, facets must still share it instead of
// each taking all. The facet just left and facets seen from behind get nothing.
TEST(HardCases, BeamsOfNearViewsDoNotOverlap) {
    std::mt19937_64 random(20287);
    std::uniform_real_distribution<double> unit(0, 1);
    for (int i = 0; i < 60; ++i) {
        const std::string cut = i % 3 == 0 ? "round-brilliant" : i % 3 == 1 ? "step" : "princess";
        const Solid solid = make_cut(cut);
        const double size = diameter(solid);
        Scene scene = plain_scene(solid);
        const double distance = 0.55 + 0.6 * unit(random), n = 1.3 + 1.2 * unit(random);
        look(scene, random_direction(random), distance * size, 0.55 * size);
        const FacetNet net(solid);
        BeamLimits limits;
        limits.depth = 4;
        BeamTree tree;
        build_beams(net, screen_view(scene.camera), n, limits, tree);
        EXPECT_NEAR(tree.exit_area() / tree.front_area, 1, 4e-5)
            << "seed 20287, case " << i << ", " << cut << " at " << distance << " diameters";
    }
}

// cos^0 is 1 on the lobe's side and 0 on the other.
TEST(HardCases, ALobeOfExponent0ShinesFromOneSide) {
    Scene scene = hard_scene();
    scene.lights = {};
    scene.lights.sources.push_back(
        CosinePowerLight{glm::normalize(Vec3{0.2, 0.3, 1}), 0, {2.0, {}}});
    const Difference d = difference(with_engine(scene, "beams", 1).picture,
                                    with_engine(scene, "reference", 1).picture);
    EXPECT_LE(d.off, 3) << d;
}

// Coverage and means must not count what hides the stone.
TEST(HardCases, ALightBeforeTheStoneIsNotCountedAsTheStone) {
    for (const int samples : {1, 16}) {
        Scene scene = hard_scene();
        const Vec3 to_eye = glm::normalize(scene.camera.position);
        scene.lights.sources.push_back(
            SphereLight{2.5 * to_eye + Vec3{0.4, 0.3, 0}, 0.25, {0.7, {}}});
        const RenderResult beams = with_engine(scene, "beams", samples),
                           reference = with_engine(scene, "reference", samples == 1 ? 1 : 64);
        const double most = samples == 1 ? 2e-3 : 1e-2;
        EXPECT_LE(difference(beams.picture, reference.picture).mean, most);
        double covered = 0, exact = 0;
        for (std::size_t i = 0; i < beams.picture.pixels(); ++i) {
            covered += static_cast<double>(beams.picture.coverage[i]);
            exact += static_cast<double>(reference.picture.coverage[i]);
        }
        EXPECT_NEAR(covered / exact, 1, most);
        EXPECT_NEAR(beams.stats.mean_radiance / reference.stats.mean_radiance, 1, most);
        EXPECT_NEAR(beams.stats.remainder / reference.stats.remainder, 1, most);
    }
}

// Small pictures have small beams; the sum of all cuts must still keep the tolerance.
TEST(HardCases, TheToleranceIsKeptInSmallPictures) {
    for (const int side : {40, 96, 300}) {
        for (const double tolerance : {0.01, 2e-3}) {
            Scene scene = hard_scene();
            scene.camera.width = scene.camera.height = side;
            scene.settings.tolerance = tolerance;
            scene.settings.depth = 0;
            const RenderStats stats = with_engine(scene, "preview", 0).stats;
            EXPECT_LE(stats.remainder / stats.mean_radiance, tolerance) << side;
        }
    }
}

// A camera is more than a place: a lens needs a new plan.
TEST(HardCases, AFrameThroughALensIsThatOfAFreshRenderer) {
    Scene scene = hard_scene();
    edgeless_lights()[1].make(scene);
    scene.settings.samples = 16;
    FrameRenderer frames(scene);
    frames.draw();
    scene.camera.aperture_radius = 0.5;
    scene.camera.focus_distance = 10;
    frames.look_from(scene.camera);
    EXPECT_EQ(frames.draw().picture.rgb, render(scene).picture.rgb);
}

// From far away another cut keeps the tolerance than from close by.
TEST(HardCases, AFrameFromElsewhereHasTheLimitsOfAFreshRenderer) {
    Scene scene = hard_scene();
    edgeless_lights()[1].make(scene);
    scene.settings.samples = 16;
    scene.settings.tolerance = 0.1;
    scene.settings.depth = 0;
    FrameRenderer frames(scene);
    frames.draw();
    look(scene, {1, 0.2, -1}, 4);
    frames.look_from(scene.camera);
    FrameRenderer anew(scene);
    const RenderResult moved = frames.draw(true), fresh = anew.draw(true);
    EXPECT_EQ(moved.stats.beams, fresh.stats.beams);
    EXPECT_EQ(moved.picture.rgb, fresh.picture.rgb);
}

// The sum over all directions of what a map sends, at its own resolution; a sun may be one texel.
// Bilinear look-up spreads a texel over its neighbours with weights that add up to its area, up to
// the curvature of sin(colatitude) over two rows.
TEST(HardCases, AnEnvironmentKeepsTheLightOfOneTexel) {
    const double pi = std::numbers::pi;
    std::mt19937_64 random(20288);
    for (const int width : {32, 64, 256, 1024}) {
        double worst = 0;
        for (int i = 0; i < 12; ++i) {
            EnvironmentMap map;
            map.width = width;
            map.height = width / 2;
            map.rgb.assign(static_cast<std::size_t>(3 * width * (width / 2)), 0.0f);
            const int x = static_cast<int>(random() % static_cast<unsigned>(width)),
                      y = width / 16 +
                          static_cast<int>(random() % static_cast<unsigned>(3 * width / 8));
            map.rgb[static_cast<std::size_t>(3 * (y * width + x))] = 1;
            const EnvironmentPyramid pyramid(map);
            const EnvironmentPyramid::Level& level = pyramid.levels().front();
            double sum = 0;
            for (int v = 0; v < level.side; ++v) {
                for (int u = 0; u < level.side; ++u) {
                    // Solid angle of a texel of the octahedral square.
                    const double a = 2 * (u + 0.5) / level.side - 1,
                                 b = 2 * (v + 0.5) / level.side - 1,
                                 c = 1 - std::abs(a) - std::abs(b);
                    const double px = c < 0 ? 1 - std::abs(b) : a, py = c < 0 ? 1 - std::abs(a) : b;
                    const double length = std::sqrt(px * px + py * py + c * c),
                                 side = 2.0 / level.side;
                    sum += side * side / (length * length * length) *
                           static_cast<double>(pyramid.plane(
                               0)[level.start +
                                  static_cast<std::size_t>((v + 1) * (level.side + 2) + u + 1)]);
                }
            }
            const double texel = 2 * pi / width,
                         exact = texel * texel * std::sin(pi * (y + 0.5) / (width / 2));
            worst = std::max(worst, std::abs(sum / exact - 1));
        }
        EXPECT_LE(worst, 0.05) << "seed 20288, width " << width;
    }
}

TEST(HardCases, ASunSmallerThanAPixelKeepsItsLight) {
    Scene scene = plain_scene(slab(1));
    scene.camera.width = scene.camera.height = 40;
    scene.camera.position = {0.05, 0.05, 8};
    scene.camera.look_at = {0, 0, 0};
    scene.camera.fov = 0.9;
    scene.settings.depth = 3;
    scene.lights = {};
    // A pixel is 0.024 wide; the sun's diameter is 0.0094, and it is behind the camera.
    scene.lights.sources.push_back(DiscLight{{0, 0, 1}, 0, 0.0047, {1e4, {}}});
    const RenderResult beams = with_engine(scene, "beams", 16);
    const RenderResult exact = with_engine(scene, "reference", 1024);
    double seen = 0, expected = 0;
    for (std::size_t i = 0; i < exact.picture.pixels(); ++i) {
        seen += luminance_at(beams.picture, i);
        expected += luminance_at(exact.picture, i);
    }
    EXPECT_GT(expected, 0);
    EXPECT_NEAR(seen / expected, 1, 0.05);
}

// A beam of which only the middle ray is followed past its first inner facet may fill many pixels,
// and a sun lights some of them. The faces of a slab are parallel, so light leaves as if the first
// face had reflected it. The sun's image is a disc of (f tan a)^2 pi pixels, with f the picture's
// distance in pixels and a the sun's radius; its radiance is R + (1 - R)^2 R (1 + R^2 + ..) = 2 R /
// (1 + R) of the sun's.
TEST(HardCases, ABeamFollowedByOneRayShowsTheSunWhereItIs) {
    Scene scene = plain_scene(slab(0.5));
    const double n = 1.1, sun = 0.05;
    scene.stone.material.index[0].n = n;
    scene.camera.width = scene.camera.height = 14;
    scene.camera.position = {0, 0, 8};
    scene.camera.fov = 0.25;
    scene.settings.tolerance = 0.05;
    scene.settings.cut_weight = 1e-9;
    scene.lights = {};
    scene.lights.sources.push_back(DiscLight{{0, 0, 1}, 0, sun, {1e4, {}}});
    const double f = 7 / std::tan(scene.camera.fov / 2), radius = f * std::tan(sun);
    const double R = std::pow((n - 1) / (n + 1), 2);
    const double expected = 1e4 * 2 * R / (1 + R) * std::numbers::pi * radius * radius;
    scene.settings.samples = 16;
    FrameRenderer frames(scene);
    const RenderResult& beams = frames.draw(false);
    double seen = 0;
    for (std::size_t i = 0; i < beams.picture.pixels(); ++i) seen += luminance_at(beams.picture, i);
    // A pixel's share is that of a straight edge. For a disc of radius r this is too much by 1 /
    // (12 r^2), because the mean square distance of a pixel's points from its middle is 1/12 per
    // axis.
    EXPECT_NEAR(seen / expected, 1, 2 / (12 * radius * radius))
        << "a disc of radius " << radius << " pixels, " << beams.stats.beams << " beams";
}

// The same for a near light that is small in the picture.
TEST(HardCases, ALampSmallerThanAPixelKeepsItsLight) {
    Scene scene = plain_scene(slab(1));
    scene.camera.width = scene.camera.height = 40;
    scene.camera.position = {0.05, 0.05, 8};
    scene.camera.fov = 0.9;
    scene.settings.depth = 3;
    scene.lights = {};
    scene.lights.sources.push_back(SphereLight{{1, 1, 9}, 0.02, {1e4, {}}});
    const RenderResult beams = with_engine(scene, "beams", 16),
                       exact = with_engine(scene, "reference", 4096);
    double seen = 0, expected = 0;
    for (std::size_t i = 0; i < exact.picture.pixels(); ++i) {
        seen += luminance_at(beams.picture, i);
        expected += luminance_at(exact.picture, i);
    }
    EXPECT_GT(expected, 0);
    EXPECT_NEAR(seen / expected, 1, 0.05);
}

}  // namespace
