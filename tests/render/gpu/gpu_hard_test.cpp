// Hard cases for the GPU kernel, and what it must conserve.

#include <fmt/format.h>

#include <numbers>

#include "tests/render/gpu/gpu_scenes.h"

namespace culet {
namespace {

// A picture of one sample with its energy balance, as on the canvas.
struct Accounts {
    std::vector<float> sum, balance;
};

Accounts drawn(const Scene& scene) {
    const OpticalSetup setup = make_optical_setup(scene);
    const WavelengthSet colours(setup.wavelengths_nm);
    GpuOptions options;
    options.depth = scene.settings.depth;
    options.cut_weight = scene.settings.cut_weight.value_or(0);
    options.balance = true;
    const GlContext context;
    const GpuProgram program = gpu_program(scene, setup, colours, options);
    GpuCanvas canvas(context, program, scene.camera.width, scene.camera.height, true);
    canvas.set(gpu_lights(scene.lights, program.middle));
    canvas.set(gpu_view(scene.camera, {}, program.middle));
    for (const GpuPass& pass : program.passes) {
        canvas.set(pass.uniforms);
        canvas.set(gpu_eye(scene.camera.optics, setup, pass));
        EXPECT_TRUE(canvas.draw([] { return true; }));
    }
    return {canvas.read(0), canvas.read(1)};
}

// Conservation: in a constant light of 1 a pixel shows all light except the reported losses. Each
// face adds roundings of 6e-8; there are some ten faces with a few operations each.
constexpr float k_rounding = 5e-6f;

void expect_balance(const Scene& scene, int least) {
    const Accounts all = drawn(scene);
    int hits = 0;
    float worst = 0;
    for (std::size_t i = 0; i < all.sum.size(); i += 4) {
        const float lost = all.balance[i] + all.balance[i + 1] + all.balance[i + 2];
        worst = std::max(worst, std::abs(all.sum[i + 1] + lost - 1));
        ASSERT_TRUE(std::isfinite(all.sum[i + 1]));
        hits += all.sum[i + 3] > 0;
    }
    EXPECT_LE(worst, k_rounding);
    EXPECT_GE(hits, least);
}

Scene furnace(const Solid& solid) {
    Scene scene = plain_scene(solid);
    look(scene, {0.21, 0.34, 1}, 10);
    return scene;
}

using GpuHard = GpuTest;

TEST_F(GpuHard, AFurnaceShowsNothingButItself) {
    for (const bool polarised : {false, true}) {
        SCOPED_TRACE(polarised);
        Scene scene = furnace(round_brilliant());
        scene.settings.effects_auto = false;
        scene.settings.effects.fill(true);
        scene.settings.effects[static_cast<std::size_t>(Effects::polarization)] = polarised;
        expect_balance(scene, 3000);
        // Until nothing remains: exactly white.
        scene.settings.depth = 400;
        const Accounts all = drawn(scene);
        for (std::size_t i = 0; i < all.sum.size(); i += 4)
            ASSERT_NEAR(all.sum[i + 1], 1, 2e-5) << "pixel " << i / 4;
    }
}

TEST_F(GpuHard, LightIsSeenAbsorbedOrLeft) {
    Scene scene = furnace(round_brilliant());
    scene.stone.material.absorption_per_mm[0] = Spectrum(0.4);
    expect_balance(scene, 3000);
    scene.settings.cut_weight = 0.05;
    expect_balance(scene, 3000);
    Material& material = scene.stone.material;
    material.optic = OpticCharacter::uniaxial;
    material.index[0].n = 1.642;
    material.index[1].n = 1.622;
    material.absorption_per_mm[0] = Spectrum(0.9);
    material.absorption_per_mm[1] = Spectrum(0.05);
    expect_balance(scene, 3000);
}

TEST_F(GpuHard, RaysThroughEdgesAndCorners) {
    // A cube whose edges and corners lie exactly on pixel rays: seen along an edge's bisector, the
    // edge is the picture's middle column.
    std::vector<NamedPlane> planes;
    for (int axis = 0; axis < 3; ++axis) {
        for (const int sign : {-1, 1}) {
            Vec3 n{0, 0, 0};
            n[axis] = sign;
            planes.push_back({"face", {n, 0.5}});
        }
    }
    Scene scene = furnace(intersect_half_spaces(planes).solid);
    scene.camera.width = scene.camera.height = 65;
    scene.camera.orthographic_width = 65.0 / 32;
    for (const Vec3 from : {Vec3{1, 1, 0}, Vec3{1, 1, 1}, Vec3{1, 0, 0}}) {
        look(scene, from, 10);
        scene.camera.up = {0, 0, 1};
        expect_balance(scene, 500);
    }
}

TEST_F(GpuHard, TotalReflectionBeginsWhereItMust) {
    // Seen through a prism: the far face of a slab at angles about the critical one. There
    // transmission goes as the square root of the distance from the critical angle, so 1e-7 becomes
    // 3e-4 of a face's power.
    std::vector<NamedPlane> planes{{"entry", {glm::normalize(Vec3{1, 0, 1}), 1}},
                                   {"far", {{0, 0, -1}, 0.2}},
                                   {"side", {{-1, 0, 0}, 2}},
                                   {"left", {{0, -1, 0}, 2}},
                                   {"right", {{0, 1, 0}, 2}}};
    for (const double n : {1.001, 1.33, 1.5, 2.417, 4.0}) {
        SCOPED_TRACE(n);
        Scene scene = furnace(intersect_half_spaces(planes).solid);
        scene.stone.material.index[0].n = n;
        look(scene, {1, 0.1, 0.8}, 4, 1.4);
        scene.settings.depth = 3;
        expect_balance(scene, 1500);
        scene.lights.constant = 0;
        scene.lights.sources = {CosinePowerLight{{0, 0, -1}, 1, {1.0}},
                                CosinePowerLight{glm::normalize(Vec3{1, 0, 1}), 1, {0.5}}};
        const PixelErrors errors =
            errors_of(with_engine(scene, "gpu", 1).picture,
                      with_engine(scene, "reference", 1).picture, inner_pixels(scene));
        EXPECT_LE(errors.inner_rms, 2e-3) << errors;
    }
}

TEST_F(GpuHard, AStoneLighterThanWhatSurroundsIt) {
    for (const double outside : {1.501, 1.9, 2.5}) {
        SCOPED_TRACE(outside);
        Scene scene = furnace(round_brilliant());
        scene.stone.material.index[0].n = 1.5;
        scene.immersion = outside;
        expect_balance(scene, 3000);
        scene.lights.constant = 0.1;
        scene.lights.sources = {CosinePowerLight{glm::normalize(Vec3{0.3, 0.2, 1}), 3, {2.0}}};
        const Difference d = difference(with_engine(scene, "gpu", 1).picture,
                                        with_engine(scene, "reference", 1).picture, 1e-3);
        EXPECT_LE(d.share_off(), 2e-3) << d;
    }
}

TEST_F(GpuHard, AStoneOfItsSurroundingsIndexIsNotThere) {
    Scene scene = furnace(round_brilliant());
    scene.stone.material.index[0].n = 1.5;
    scene.immersion = 1.5;
    scene.lights.constant = 0;
    scene.lights.sources = {CosinePowerLight{{0, 0, -1}, 2, {1.0}}};
    const Accounts all = drawn(scene);
    const EyeRays eyes(scene.camera);
    for (int y = 0; y < scene.camera.height; ++y) {
        for (int x = 0; x < scene.camera.width; ++x) {
            const double down = -eyes.through(x + 0.5, y + 0.5).direction.z;
            ASSERT_NEAR(static_cast<double>(
                            all.sum[4 * static_cast<std::size_t>(y * scene.camera.width + x)]),
                        down * down, 1e-5);
        }
    }
}

TEST_F(GpuHard, SliversAndStonesFarFromTheOrigin) {
    std::mt19937_64 random(41);
    for (int i = 0; i < 6; ++i) {
        SCOPED_TRACE(fmt::format("seed 41, stone {}", i));
        Scene scene = furnace(stone_with_slivers(random, 12));
        look(scene, random_direction(random), 6, 1.5);
        expect_balance(scene, 500);
    }
    Scene scene = furnace(round_brilliant());
    const Vec3 away{3e4, -2e4, 1e4};
    for (Vec3& corner : scene.stone.solid.vertices) corner += away;
    for (Facet& facet : scene.stone.solid.facets)
        facet.plane.offset += glm::dot(facet.plane.normal, away);
    scene.camera.position += away;
    scene.camera.look_at += away;
    expect_balance(scene, 3000);
}

TEST_F(GpuHard, NearLightsBeforeAndBehindTheStone) {
    Scene scene = furnace(round_brilliant());
    scene.lights.sources = {SphereLight{{0.3, 0.5, 2}, 0.4, {3.0}},
                            SphereLight{{0, 0, 9.6}, 0.1, {7.0}},
                            SphereLight{{0, 0, 11}, 0.5, {9.0}},
                            PlaneLight{{0, 0, -2}, {0, 0, 1}, Vec3{2, 0, 0}, Vec3{0, 2, 0}, {0.5}}};
    const Difference d = difference(with_engine(scene, "gpu", 1).picture,
                                    with_engine(scene, "reference", 1).picture, 1e-3);
    EXPECT_LE(d.share_off(), 2e-3) << d;
    const Picture gpu = with_engine(scene, "gpu", 1).picture,
                  reference = with_engine(scene, "reference", 1).picture;
    int uncovered = 0, off = 0;
    for (std::size_t i = 0; i < gpu.pixels(); ++i) {
        off += gpu.coverage[i] != reference.coverage[i];
        uncovered += reference.coverage[i] == 0;
    }
    EXPECT_LE(off, 3);
    EXPECT_GT(uncovered, 500);
}

}  // namespace
}  // namespace culet
