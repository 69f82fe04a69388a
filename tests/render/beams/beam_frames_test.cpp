// Expectations: the same bytes for any number of threads and any earlier frames; the reference with
// 256 samples per pixel; and the stated error bound.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "render/beams/frame_renderer.h"
#include "render/scene/scene_io.h"
#include "render/scene/transform.h"
#include "render/scene/turned_lights.h"
#include "stone/text/errors.h"
#include "tests/render/beams/beam_lights.h"

namespace {

using namespace culet;

Scene brilliant_scene() {
    Scene scene = plain_scene(round_brilliant());
    look(scene, {0.21, 0.34, 1}, 10);
    edged_lights().back().make(scene);
    return scene;
}

TEST(Frames, AreTheSameBytesWithAnyNumberOfThreads) {
    for (const std::string engine : {"beams", "preview"}) {
        for (const int samples : {1, 16}) {
            Scene scene = brilliant_scene();
            optics()[5].make(scene);
            scene.camera.height = 150;
            scene.settings.threads = 1;
            const RenderResult one = with_engine(scene, engine, samples);
            for (const int threads : {2, 5}) {
                scene.settings.threads = threads;
                const RenderResult many = with_engine(scene, engine, samples);
                EXPECT_EQ(one.picture.rgb, many.picture.rgb) << engine << threads;
                EXPECT_EQ(one.picture.coverage, many.picture.coverage);
                EXPECT_EQ(one.stats.error_bound, many.stats.error_bound);
                EXPECT_EQ(one.stats.remainder, many.stats.remainder);
                EXPECT_EQ(one.stats.beams, many.stats.beams);
            }
        }
    }
}

TEST(Frames, WithOtherLightsAreThoseOfAFreshRenderer) {
    for (const std::string engine : {"beams", "preview"}) {
        Scene scene = brilliant_scene();
        scene.settings.engine = engine;
        scene.settings.samples = 16;
        FrameRenderer frames(scene);
        const Picture first = frames.draw().picture;
        for (const auto& lights : {edged_lights(), edgeless_lights()}) {
            for (const NamedChange& light : lights) {
                SCOPED_TRACE(light.name);
                Scene changed = scene;
                light.make(changed);
                frames.light_with(changed.lights);
                const RenderResult& relit = frames.draw(true);
                const RenderResult fresh = render(changed);
                EXPECT_EQ(relit.picture.rgb, fresh.picture.rgb);
                EXPECT_EQ(relit.stats.error_bound, fresh.stats.error_bound);
            }
        }
        frames.light_with(scene.lights);
        EXPECT_EQ(frames.draw().picture.rgb, first.rgb);
    }
}

TEST(Frames, WithLightsThatCallForOtherWavelengthsAreThoseOfAFreshRenderer) {
    Scene scene = brilliant_scene();
    optics()[5].make(scene);
    scene.settings.wavelengths_nm.clear();
    scene.settings.tolerance = 0.02;
    scene.settings.samples = 16;
    FrameRenderer frames(scene);
    frames.draw();
    Scene changed = scene;
    changed.lights = {};
    changed.lights.sources.push_back(CosinePowerLight{{0, 0, 1}, 3, {"A", {}}});
    changed.lights.environment = smooth_environment();
    frames.light_with(changed.lights);
    EXPECT_EQ(frames.draw().picture.rgb, FrameRenderer(changed).draw().picture.rgb);
}

TEST(Frames, OfAllChangedAtOnceAndTakenAwayAreThoseOfAFreshRenderer) {
    const Scene scene = brilliant_scene();
    FrameRenderer frames(scene);
    frames.draw();
    const Picture first = frames.take().picture;
    Scene changed = scene;
    look(changed, {0.3, -0.4, 1}, 7);
    changed.camera.width = 130;
    changed.settings.engine = "preview";
    changed.lights = {};
    changed.lights.sources.push_back(CosinePowerLight{{0, 0, 1}, 3, {"A", {}}});
    frames.show(changed);
    EXPECT_EQ(frames.draw().picture.rgb, FrameRenderer(changed).draw().picture.rgb);
    frames.show(scene);
    frames.draw();
    const RenderResult again = frames.take();
    EXPECT_EQ(again.picture.rgb, first.rgb);
    EXPECT_EQ(again.picture.coverage, first.coverage);
}

TEST(Frames, FromAnotherViewAndBackAreTheFirst) {
    Scene scene = brilliant_scene();
    scene.settings.samples = 16;
    FrameRenderer frames(scene);
    const RenderResult first = frames.draw(true);
    Scene moved = scene;
    for (const Vec3& from : {Vec3{1, 0, 0.2}, Vec3{0, 0, -1}, Vec3{0.3, -0.4, 1}}) {
        look(moved, from, 7);
        moved.camera.width = from.x == 1 ? 60 : 130;
        frames.look_from(moved.camera);
        const RenderResult& there = frames.draw(true);
        EXPECT_EQ(there.picture.rgb, render(moved).picture.rgb);
    }
    frames.look_from(scene.camera);
    const RenderResult& back = frames.draw(true);
    EXPECT_EQ(back.picture.rgb, first.picture.rgb);
    EXPECT_EQ(back.picture.coverage, first.picture.coverage);
    EXPECT_EQ(back.stats.error_bound, first.stats.error_bound);
    EXPECT_EQ(back.stats.remainder, first.stats.remainder);
}

TEST(Frames, FromAnotherViewInTurnedLightsAreThoseOfAFreshRenderer) {
    const Scene scene = brilliant_scene();
    FrameRenderer frames(scene);
    frames.draw();
    Scene moved = scene;
    look(moved, {0.3, -0.4, 1}, 7);
    moved.lights = turned_lights(scene.lights, rotation_of({20, 0, 70}), {0, 0, 0});
    frames.look_from(moved.camera, moved.lights);
    EXPECT_EQ(frames.draw().picture.rgb, FrameRenderer(moved).draw().picture.rgb);
    // Another kind of lights needs other wavelengths, which are chosen anew.
    moved.settings.wavelengths_nm.clear();
    FrameRenderer open(moved);
    Scene changed = moved;
    changed.lights = {};
    changed.lights.sources.push_back(CosinePowerLight{{0, 0, 1}, 3, {"A", {}}});
    open.look_from(changed.camera, changed.lights);
    EXPECT_EQ(open.draw().picture.rgb, FrameRenderer(changed).draw().picture.rgb);
}

TEST(Frames, ThatMustBeQuickHaveFewerBeamsAndSayWhatIsLeft) {
    Scene scene = plain_scene(round_brilliant());
    look(scene, {0.21, 0.34, 1}, 10);
    scene.settings.depth = 14;
    scene.settings.engine = "preview";
    FrameRenderer frames(scene);
    const RenderStats whole = frames.draw().stats;
    frames.keep_within(1e-3);
    RenderStats quick;
    for (int i = 0; i < 4; ++i) {
        quick = frames.draw().stats;
        EXPECT_NEAR(quick.mean_radiance + quick.remainder, 1, 1e-5);
    }
    EXPECT_LT(quick.beams, whole.beams / 2);
    EXPECT_GT(quick.remainder, whole.remainder);
    frames.keep_within(0);
    const RenderStats again = frames.draw().stats;
    EXPECT_EQ(again.beams, whole.beams);
    EXPECT_EQ(again.remainder, whole.remainder);
}

// Mean |difference| over the stone / mean, against 256 samples of the same depth.
void expect_bound_holds(Scene scene, const std::string& engine, int samples) {
    scene.settings.samples = samples;
    scene.settings.engine = engine;
    const RenderResult beams = render(scene);
    scene.settings.tolerance = 0;
    const RenderResult exact = with_engine(scene, "reference", 256);
    const Difference d = difference(beams.picture, exact.picture);
    EXPECT_EQ(d.not_finite, 0);
    EXPECT_TRUE(std::isfinite(beams.stats.error_bound));
    // The 256 samples have an error of their own.
    EXPECT_LE(d.mean, beams.stats.error_bound + exact.stats.sampling_error) << engine << ", " << d;
}

TEST(ErrorBounds, HoldForEveryRefractionAndEngine) {
    std::mt19937_64 random(20284);
    for (const Refraction kind :
         {Refraction::astigmatic, Refraction::perspective, Refraction::parallel}) {
        for (const std::string engine : {"beams", "preview"}) {
            for (int i = 0; i < 3; ++i) {
                SCOPED_TRACE("seed 20284, kind " + std::to_string(static_cast<int>(kind)) +
                             ", case " + std::to_string(i));
                Scene scene = i == 0 ? brilliant_scene() : plain_scene(random_stone(random, 8 * i));
                scene.camera.width = scene.camera.height = 64;
                look(scene, random_direction(random), i == 0 ? 4 : 9, i == 0 ? 1.05 : 1.5);
                edged_lights()[static_cast<std::size_t>(i == 2 ? 4 : i)].make(scene);
                scene.settings.refraction = kind;
                scene.settings.depth = 4 + 2 * i;
                expect_bound_holds(scene, engine, 16);
            }
        }
    }
}

TEST(ErrorBounds, HoldAtSmallTolerances) {
    for (const double tolerance : {0.1, 1e-3}) {
        for (const std::string engine : {"beams", "preview"}) {
            Scene scene = brilliant_scene();
            scene.camera.width = scene.camera.height = 64;
            edgeless_lights()[1].make(scene);
            scene.settings.tolerance = tolerance;
            scene.settings.depth = 16;
            expect_bound_holds(scene, engine, 16);
        }
    }
}

TEST(ErrorBounds, HoldThroughALens) {
    for (const double aperture : {0.02, 0.2, 1.0}) {
        SCOPED_TRACE(aperture);
        Scene scene = brilliant_scene();
        scene.camera.width = scene.camera.height = 64;
        edgeless_lights()[1].make(scene);
        scene.camera.aperture_radius = aperture;
        scene.camera.focus_distance = 10;
        expect_bound_holds(scene, "beams", 64);
    }
}

// Peak signal-to-noise ratio over the stone's pixels, including the reference's own noise at 256
// samples.
TEST(Averages, AreWithin50DBOf256SamplesInSmoothLight) {
    std::mt19937_64 random(20285);
    for (int i = 0; i < 3; ++i) {
        SCOPED_TRACE("seed 20285, stone " + std::to_string(i));
        Scene scene = plain_scene(i == 0 ? round_brilliant() : random_stone(random, 10 * i));
        scene.camera.width = scene.camera.height = 200;
        look(scene, {0.21, 0.34, 1}, i == 0 ? 12 : 15, i == 0 ? 1.05 : 1.5);
        edgeless_lights()[1].make(scene);
        scene.lights.sources.pop_back();
        const RenderResult beams = with_engine(scene, "beams", 16),
                           exact = with_engine(scene, "reference", 256);
        const Difference d = difference(beams.picture, exact.picture);
        RecordProperty("psnr_" + std::to_string(i), std::to_string(d.psnr()));
        EXPECT_GE(d.psnr(), 50) << d;
    }
}

// Lights seen straight through and mirrored in one big facet, where beams have no borders: only the
// light's own edge needs smoothing.
TEST(Averages, SmoothTheEdgesOfLightsWithinAFacet) {
    for (const NamedChange& light : edged_lights()) {
        SCOPED_TRACE(light.name);
        Scene scene = plain_scene(slab(1));
        light.make(scene);
        scene.camera.width = scene.camera.height = 80;
        scene.camera.position = {2, 3, 8};
        scene.camera.look_at = {-0.5, -0.3, 0};
        scene.camera.fov = 0.9;
        scene.settings.depth = 5;
        const RenderResult beams = with_engine(scene, "beams", 16),
                           exact = with_engine(scene, "reference", 256);
        const Difference d = difference(beams.picture, exact.picture, 0.05);
        // Across an edge 256 samples have a step of 1/256 at best, 1/16 where the edge runs along
        // their rows.
        EXPECT_GE(d.psnr(), 40) << d;
        EXPECT_LE(d.share_off(), 5e-3) << d;
    }
}

// Pixels that several beams share: each beam sees another part of the lights.
TEST(Averages, InPixelsThatBeamsShareAreThoseOfTheParts) {
    for (const NamedChange& light : edged_lights()) {
        SCOPED_TRACE(light.name);
        Scene scene = brilliant_scene();
        light.make(scene);
        scene.camera.width = scene.camera.height = 48;
        scene.settings.tolerance = 1e-3;
        const RenderResult beams = with_engine(scene, "beams", 16),
                           exact = with_engine(scene, "reference", 1024);
        const Difference d = difference(beams.picture, exact.picture);
        RecordProperty(light.name, std::to_string(d.psnr()));
        // Where an edge crosses a pixel the reference's noise is some 1024^(-3/4) of the step. With
        // one such pixel in three and a step of a third of the peak this gives 59 dB, and the
        // beams' borders may be off by as much again. Lights seen by whole pixels gave 41 to 53 dB.
        EXPECT_GE(d.psnr(), 55) << d;
    }
}

// A small sun that many pixels see in part: circle segments, from 64 x 64 points each.
TEST(Averages, OfASunManyPixelsWideArePartsOfACircle) {
    constexpr int k_pixels = 120, k_points = 64;
    constexpr double k_radius = 0.0047, k_fov = 0.012;
    Scene scene = plain_scene(slab(1));
    scene.lights = {};
    const Vec3 sun = glm::normalize(Vec3{0.3, 0.2, 1});
    scene.lights.sources.push_back(DiscLight{sun, 0.0, k_radius, {1.0, {}}});
    scene.camera.width = scene.camera.height = k_pixels;
    scene.camera.position = 10.0 * sun;
    scene.camera.look_at = 20.0 * sun;
    scene.camera.fov = k_fov;
    const RenderResult seen = with_engine(scene, "beams", 16);
    const double step = 2 * std::tan(0.5 * k_fov) / k_pixels, limit = std::tan(k_radius);
    double most = 0;
    for (int y = 0; y < k_pixels; ++y) {
        for (int x = 0; x < k_pixels; ++x) {
            int inside = 0;
            for (int i = 0; i < k_points * k_points; ++i) {
                const double u = x + (i % k_points + 0.5) / k_points - 0.5 * k_pixels,
                             v = y + (i / k_points + 0.5) / k_points - 0.5 * k_pixels;
                inside += std::hypot(u * step, v * step) < limit;
            }
            most = std::max(most, std::abs(seen.picture.pixel(x, y)[1] -
                                           static_cast<double>(inside) / (k_points * k_points)));
        }
    }
    // Points in rows: 1/64. Curvature of the rim over a pixel: its side squared over 8 radii.
    // Directions in single precision: 2 rounding units of 6e-8 over a pixel's angle.
    EXPECT_LE(most, 1.0 / k_points + step / (8 * k_radius) + 1.2e-7 / step);
}

std::string refusal(const Scene& scene) {
    try {
        render(scene);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

TEST(Refusals, AreOneLineThatSaysWhatToDo) {
    const std::vector<std::pair<std::string, NamedChange>> cases{
        {"convex", {"not convex", [](Scene& s) { s.stone.convex = false; }}},
        {"filter", {"tent", [](Scene& s) { s.settings.filter = PixelFilter::tent; }}},
        {"filter", {"gaussian", [](Scene& s) { s.settings.filter = PixelFilter::gaussian; }}},
        {"filter", {"wide box", [](Scene& s) { s.settings.filter_radius = 0.7; }}},
        {"conoscope", {"conoscope", [](Scene& s) { s.camera.cone = 0.3; }}},
        {"denser", {"index 1", [](Scene& s) { s.stone.material.index[0].n = 1; }}},
        {"denser", {"thinner", [](Scene& s) { s.immersion = 2.5; }}},
        {"near lights",
         {"17 spheres",
          [](Scene& s) {
              for (int i = 0; i < 17; ++i)
                  s.lights.sources.push_back(SphereLight{{5, 5, 5.0 + 3 * i}, 1, {1.0, {}}});
          }}},
        {"inside",
         {"camera inside",
          [](Scene& s) {
              s.camera.position = {0, 0, 0.01};
          }}},
    };
    for (const auto& [word, change] : cases) {
        for (const std::string engine : {"beams", "preview"}) {
            SCOPED_TRACE(change.name);
            Scene scene = brilliant_scene();
            scene.settings.engine = engine;
            change.make(scene);
            const std::string line = refusal(scene);
            EXPECT_NE(line.find(word), std::string::npos) << line;
            EXPECT_EQ(line.find('\n'), std::string::npos) << line;
        }
    }
}

TEST(Refusals, OfASceneFileNameWhatIsKnown) {
    namespace fs = std::filesystem;
    const fs::path folder = fs::path(testing::TempDir()) / "culet_beam_refusals";
    fs::create_directories(folder);
    std::ofstream(folder / "mesh.obj")
        << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
    std::ofstream(folder / "stone.toml")
        << "[stone]\nmesh = \"mesh.obj\"\nmaterial = \"diamond\"\n";
    const auto line_of = [&](const std::string& value) {
        std::ofstream(folder / "scene.toml") << "stone = \"stone.toml\"\n[light]\nconstant = "
                                                "1.0\n[render]\nengine = \"beams\"\nrefraction = "
                                             << value << "\n";
        try {
            read_scene(folder / "scene.toml");
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_EQ(line_of("\"parallel\""), "");
    for (const char* value : {"\"sideways\"", "\"\"", "\"Parallel\""}) {
        const std::string line = line_of(value);
        EXPECT_NE(line.find("astigmatic, perspective, parallel"), std::string::npos) << line;
        EXPECT_EQ(line.find('\n'), std::string::npos) << line;
    }
    EXPECT_NE(line_of("2"), "");
    fs::remove_all(folder);
}

TEST(Refusals, SixteenNearLightsAreNotTooMany) {
    Scene scene = brilliant_scene();
    scene.lights = {};
    for (int i = 0; i < 16; ++i)
        scene.lights.sources.push_back(SphereLight{{5, 5, 5.0 + 3 * i}, 1, {1.0, {}}});
    EXPECT_EQ(refusal(scene), "");
}

TEST(Refusals, OfAFrameLeaveTheRendererAsItWas) {
    const Scene scene = brilliant_scene();
    FrameRenderer frames(scene);
    const Picture before = frames.draw().picture;
    Camera inside = scene.camera;
    inside.position = {0, 0, 0.01};
    EXPECT_THROW(frames.look_from(inside), InputError);
    Lights many = scene.lights;
    for (int i = 0; i < 17; ++i)
        many.sources.push_back(SphereLight{{5, 5, 5.0 + 3 * i}, 1, {1.0, {}}});
    EXPECT_THROW(frames.light_with(many), InputError);
    EXPECT_EQ(frames.draw().picture.rgb, before.rgb);
}

TEST(Progresses, OfNoStopsThePicture) {
    Scene scene = brilliant_scene();
    EXPECT_THROW(render(scene, [](double) { return false; }), Interrupted);
}

}  // namespace
