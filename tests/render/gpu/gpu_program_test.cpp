// The promises of the GPU program to its caller, and of the engine.

#include <gmock/gmock.h>

#include <fmt/format.h>

#include <regex>

#include "render/engine/engine.h"
#include "render/image/film_look.h"
#include "render/scene/turntable.h"
#include "stone/material/material_io.h"
#include "tests/render/gpu/gpu_scenes.h"

namespace culet {
namespace {

using ::testing::HasSubstr;

Scene lit_scene() {
    Scene scene = plain_scene(round_brilliant());
    look(scene, {0.21, 0.34, 1}, 10);
    scene.lights.constant = 0.1;
    scene.lights.sources = {CosinePowerLight{glm::normalize(Vec3{0.3, 0.2, 1}), 16, {4.7}},
                            DiscLight{glm::normalize(Vec3{-1, 0.2, 0.4}), 0.0, 0.35, {4.0}},
                            SphereLight{{4, 2, 6}, 2, {3.0}}};
    return scene;
}

GpuProgram program_of(const Scene& scene, const GpuOptions& options = {}) {
    const OpticalSetup setup = make_optical_setup(scene);
    return gpu_program(scene, setup, WavelengthSet(setup.wavelengths_nm), options);
}

TEST(GpuProgram, NamesUniformsThatItsSourceHas) {
    Scene scene = lit_scene();
    scene.stone.material = catalogue_material("sapphire_blue");
    scene.lights.environment = smooth_environment();
    scene.lights.polarisation = LinearPolarisation{};
    scene.settings.wavelengths_nm = {450, 550, 610};
    GpuOptions options;
    options.balance = true;
    const GpuProgram program = program_of(scene, options);
    const OpticalSetup setup = make_optical_setup(scene);
    std::vector<GpuUniform> all = program.uniforms;
    const auto add = [&all](const std::vector<GpuUniform>& more) {
        all.insert(all.end(), more.begin(), more.end());
    };
    add(gpu_view(scene.camera, {}, program.middle));
    add(gpu_lights(scene.lights, program.middle));
    ASSERT_FALSE(program.passes.empty());
    add(program.passes[0].uniforms);
    add(gpu_eye(scene.camera.optics, setup, program.passes[0]));
    for (const GpuUniform& uniform : all) {
        const std::regex declared("uniform [a-zA-Z0-9 ]*[^;]*\\b" + uniform.name + "\\b[^;]*;");
        EXPECT_TRUE(std::regex_search(program.kernel, declared)) << uniform.name;
        EXPECT_EQ(uniform.values.size() % static_cast<std::size_t>(uniform.components), 0u)
            << uniform.name;
    }
    ASSERT_EQ(program.textures.size(), 1u);
    EXPECT_EQ(program.textures[0].rgba.size(),
              static_cast<std::size_t>(4 * program.textures[0].width * program.textures[0].height));
}

// What a person changes live must not require a compilation.
TEST(GpuProgram, IsTheSameSourceWhateverChangesLive) {
    const Scene scene = lit_scene();
    const std::string source = program_of(scene).kernel;
    Scene other = scene;
    look(other, {1, 2, 3}, 7);
    other.stone.material.index[0].n = 1.7;
    other.lights.constant = 0.7;
    std::get<DiscLight>(other.lights.sources[1]).to = 0.2;
    std::get<SphereLight>(other.lights.sources[2]).radiance.value = 9.0;
    GpuOptions deeper;
    deeper.depth = 20;
    deeper.cut_weight = 0.01;
    EXPECT_EQ(program_of(other, deeper).kernel, source);
    other.lights.sources.pop_back();
    EXPECT_NE(program_of(other, deeper).kernel, source);
}

TEST(GpuProgram, CoversAllWavelengthsInPassesOfWhatFits) {
    Scene scene = lit_scene();
    scene.stone.material = catalogue_material("diamond");
    for (const int count : {1, 3, 8, 29}) {
        scene.settings.wavelengths_nm.clear();
        for (int i = 0; i < count; ++i) scene.settings.wavelengths_nm.push_back(420.0 + 8 * i);
        for (const int most : {1, 3, 8}) {
            GpuOptions options;
            options.pass_wavelengths = most;
            int next = 0;
            for (const GpuPass& pass : program_of(scene, options).passes) {
                EXPECT_EQ(pass.first, next);
                EXPECT_LE(pass.count, most);
                next += pass.count;
            }
            EXPECT_EQ(next, count);
        }
    }
}

TEST(GpuProgram, SaysWhatItDoesNotDraw) {
    const auto refused = [](const Scene& scene, const std::string& words) {
        const std::string why = refused_by_gpu(scene);
        EXPECT_THAT(why, HasSubstr(words));
        EXPECT_THROW(program_of(scene), InputError);
    };
    Scene scene = lit_scene();
    EXPECT_EQ(refused_by_gpu(scene), "");
    Scene carved = scene;
    carved.stone.convex = false;
    refused(carved, "convex");
    Scene has_objects = scene;
    has_objects.objects.push_back({SphereShape{{5, 0, 0}, 1}, MirrorMaterial{}});
    refused(has_objects, "objects");
    Scene cone = scene;
    cone.camera.cone = 0.3;
    refused(cone, "conoscope");
    Scene two = scene;
    two.camera.optics.two_windows = true;
    refused(two, "two");
    Scene many = scene;
    for (int i = 0; i < 60; ++i) many.lights.sources.push_back(scene.lights.sources[0]);
    refused(many, "63 lights");
}

class GpuEngine : public GpuTest {
protected:
    RenderResult draw(const Scene& scene) { return engine_named(k_gpu_engine).draw(scene, {}); }
};

TEST_F(GpuEngine, DrawsTheSameBytesAgain) {
    Scene scene = lit_scene();
    scene.settings.samples = 4;
    EXPECT_EQ(draw(scene).picture.rgb, draw(scene).picture.rgb);
}

TEST_F(GpuEngine, SaysWhatItDid) {
    Scene scene = lit_scene();
    scene.settings.depth = 6;
    scene.settings.samples = 4;
    scene.settings.engine = k_gpu_engine;
    const RenderStats gpu = render(scene).stats;
    scene.settings.engine = k_reference_engine;
    const RenderStats reference = render(scene).stats;
    EXPECT_EQ(gpu.engine, "gpu");
    EXPECT_EQ(gpu.depth, reference.depth);
    EXPECT_EQ(gpu.wavelengths_nm, reference.wavelengths_nm);
    EXPECT_NEAR(gpu.remainder, reference.remainder, 1e-5);
    EXPECT_NEAR(gpu.mean_radiance, reference.mean_radiance, 1e-3 * reference.mean_radiance);
    EXPECT_NEAR(gpu.error_bound, reference.error_bound, 1e-2 * reference.error_bound);
    EXPECT_NEAR(static_cast<double>(gpu.rays), static_cast<double>(reference.rays), 4);
    ASSERT_FALSE(gpu.notes.empty());
    EXPECT_THAT(gpu.notes.back(), HasSubstr("drawn by "));
    for (const char c : gpu.notes.back()) EXPECT_TRUE(c >= ' ' && c <= '~');
}

TEST_F(GpuEngine, CutsWhatTheToleranceAllows) {
    Scene scene = lit_scene();
    scene.settings.depth = 0;
    scene.settings.tolerance = 0.01;
    scene.settings.samples = 1;
    const RenderResult gpu = draw(scene),
                       reference = engine_named(k_reference_engine).draw(scene, {});
    EXPECT_NEAR(gpu.stats.cut, reference.stats.cut, 1e-4);
    EXPECT_LE(gpu.stats.error_bound, 0.01);
    EXPECT_LE(difference(gpu.picture, reference.picture).share_off(), 0.01);
}

TEST_F(GpuEngine, RefusesACameraInsideTheStoneAndTooLargePictures) {
    Scene scene = lit_scene();
    scene.camera.position = {0, 0, 0.05};
    scene.camera.look_at = {0, 0, -5};
    EXPECT_THROW(draw(scene), InputError);
    Scene wide = lit_scene();
    wide.camera.width = 100000;
    wide.camera.height = 1;
    EXPECT_THROW(draw(wide), InputError);
}

TEST_F(GpuEngine, StopsWhenAskedTo) {
    Scene scene = lit_scene();
    scene.settings.samples = 4;
    int asked = 0;
    const Progress stop = [&asked](double) { return ++asked < 3; };
    EXPECT_THROW(engine_named(k_gpu_engine).draw(scene, stop), Interrupted);
    EXPECT_EQ(asked, 3);
    EXPECT_GT(draw(scene).stats.mean_radiance, 0);
}

TEST_F(GpuEngine, TurnsLightsByOneUniform) {
    Scene scene = lit_scene();
    scene.lights.environment = smooth_environment();
    scene.lights.sources.push_back(
        PlaneLight{{0, 0, 9}, {0, 0, -1}, Vec3{3, 0, 0}, Vec3{0.4, 2, 0}, {3.0}});
    const OpticalSetup setup = make_optical_setup(scene);
    const WavelengthSet colours(setup.wavelengths_nm);
    const GpuProgram program = program_of(scene);
    // Stone and eye turned by a quarter about z through the stone's middle with fixed lights give
    // the same picture as a fixed stone with the lights turned back, the planes included.
    const auto quarter = [](const Vec3& v) { return Vec3{-v.y, v.x, v.z}; };
    Scene turned = scene;
    turned.camera.position = program.middle + quarter(scene.camera.position - program.middle);
    turned.camera.look_at = program.middle + quarter(scene.camera.look_at - program.middle);
    turned.camera.up = quarter(scene.camera.up);
    for (Vec3& corner : turned.stone.solid.vertices)
        corner = program.middle + quarter(corner - program.middle);
    for (Facet& facet : turned.stone.solid.facets) {
        const Vec3 on = facet.plane.offset * facet.plane.normal;
        facet.plane.normal = quarter(facet.plane.normal);
        facet.plane.offset =
            glm::dot(program.middle + quarter(on - program.middle), facet.plane.normal);
    }
    const GlContext context;
    const auto picture = [&](const Scene& drawn, const std::vector<float>& turn) {
        const GpuProgram made = program_of(drawn);
        GpuCanvas canvas(context, made, drawn.camera.width, drawn.camera.height, false);
        canvas.set(gpu_lights(scene.lights, program.middle));
        canvas.set(gpu_view(drawn.camera, {}, program.middle));
        canvas.set(made.passes[0].uniforms);
        canvas.set({{"u_light_turn", 9, false, turn}});
        EXPECT_TRUE(canvas.draw([] { return true; }));
        return canvas.read(0);
    };
    const std::vector<float> as_they_are = picture(turned, {1, 0, 0, 0, 1, 0, 0, 0, 1}),
                             by_uniform = picture(scene, {0, 1, 0, -1, 0, 0, 0, 0, 1});
    int off = 0, lit = 0;
    for (std::size_t i = 0; i < as_they_are.size(); ++i) {
        off += !(std::abs(as_they_are[i] - by_uniform[i]) < 1e-3f);
        lit += as_they_are[i] > 0.5f;
    }
    EXPECT_LE(off, 60);
    EXPECT_GT(lit, 5000);
}

// The display pass against the bytes of a PNG.
TEST_F(GpuEngine, ShowsLightAsPngsDo) {
    Picture ramp;
    ramp.width = 64;
    ramp.height = 1;
    GpuTexture sum{"u_sum", 5, 64, 1, {}};
    for (int i = 0; i < 64; ++i) {
        const float v = i == 0 ? -1.0f : std::exp2(0.25f * static_cast<float>(i) - 12.0f);
        for (const float colour : {v, 2 * v, 0.3f * v}) {
            ramp.rgb.push_back(colour);
            sum.rgba.push_back(4 * colour);
        }
        sum.rgba.push_back(4);
    }
    GpuProgram program = program_of(lit_scene());
    program.kernel = program.display;
    program.textures = {sum};
    const GlContext context;
    for (const ToneMap map : {ToneMap::none, ToneMap::reinhard, ToneMap::filmic, ToneMap::gamma2}) {
        SCOPED_TRACE(name_of(map));
        program.uniforms = {{"u_exposure", 1, false, {1.7f / 4}},
                            {"u_tone_map", 1, true, {static_cast<float>(map)}}};
        GpuCanvas canvas(context, program, 64, 1, false);
        ASSERT_TRUE(canvas.draw([] { return true; }));
        const std::vector<float> shown = canvas.read(0);
        PngLook look;
        look.exposure = 1.7;
        look.tone_map = map;
        const std::vector<float> expected = as_shown(ramp, look);
        for (std::size_t i = 0; i < 64; ++i) {
            for (std::size_t c = 0; c < 3; ++c) {
                // A hundredth of an eight-bit step: the driver's pow.
                EXPECT_NEAR(static_cast<double>(shown[4 * i + c]),
                            srgb_encoded(static_cast<double>(expected[3 * i + c])), 4e-5)
                    << i;
            }
        }
    }
}

}  // namespace
}  // namespace culet
