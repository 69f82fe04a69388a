// Compares the GPU kernel with the reference and the beams: bench_gpu [--pixels N] [--json FILE]
//
// A round brilliant of 73 facets at depth 7, one ray per pixel, the same rays for all three. A
// frame of the kernel is one pass of all wavelengths with the program compiled. Processor time is
// that of all threads of the driver, which computes on the processor (Mesa's llvmpipe) or not at
// all. RMSE is relative to the mean, over the pixels ("inner" of all "pixels" of the stone) that
// are not at an edge of the path pattern (tests/render/gpu/path_pattern.h). "off" are all pixels
// that differ by more than a hundredth of the mean: rays that pass an edge within single precision.
// The last table is the waiting time of a person who turns the stone in a large window.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <iostream>

#include "bench/bench_table.h"
#include "render/engine/engine.h"
#include "render/gpu/gpu_canvas.h"
#include "render/reference/prepared_scene.h"
#include "stone/material/material_io.h"
#include "stone/text/output_file.h"
#include "tests/cpu_time.h"
#include "tests/render/bench_scenes.h"
#include "tests/render/gpu/path_pattern.h"

namespace culet {
namespace {

struct Case {
    std::string name;
    Scene scene;
};

std::vector<Case> cases(int pixels) {
    Scene plain = base_scene(pixels);
    plain.settings.depth = 7;
    plain.settings.samples = 1;
    std::vector<Case> all{{"one wavelength", plain}};
    Scene polarised = plain;
    set_polarised(polarised, true);
    all.push_back({"one wavelength, polarised", polarised});
    Scene fire = plain;
    fire.settings.wavelengths_nm = {450, 550, 610};
    all.push_back({"three wavelengths", fire});
    set_polarised(fire, true);
    all.push_back({"three wavelengths, polarised", fire});
    Scene eight = fire;
    eight.settings.wavelengths_nm = {410, 450, 490, 530, 570, 610, 650, 690};
    all.push_back({"eight wavelengths, polarised", eight});
    Scene crystal = polarised;
    crystal.stone.material = catalogue_material("sapphire_blue");
    crystal.settings.crystal_beams = CrystalBeams::merged;
    crystal.settings.wavelengths_nm = {450, 550, 610};
    crystal.settings.effects[static_cast<std::size_t>(Effects::coherence)] = false;
    all.push_back({"sapphire, merged, three", crystal});
    return all;
}

struct Frame {
    Clocks draw, start;
    std::vector<float> rgba;
};

Frame gpu_frame(const Scene& scene, const GlContext& context) {
    const PreparedScene prepared(scene);
    GpuOptions options;
    options.depth = prepared.limits.depth;
    const Clocks before = clocks();
    const GpuProgram program = gpu_program(scene, prepared.setup, prepared.colours, options);
    GpuCanvas canvas(context, program, scene.camera.width, scene.camera.height, false);
    canvas.set(gpu_lights(scene.lights, program.middle));
    const auto draw = [&] {
        canvas.start_anew();
        canvas.set(gpu_view(scene.camera, SamplePoint{}, program.middle));
        for (const GpuPass& pass : program.passes) {
            canvas.set(pass.uniforms);
            canvas.set(gpu_eye(scene.camera.optics, prepared.setup, pass));
            (void)canvas.draw([] { return true; });
        }
    };
    draw();
    Frame frame;
    const Clocks after = clocks();
    frame.start = {after.cpu - before.cpu, after.wall - before.wall};
    frame.draw = quickest(draw, 3, 2);
    frame.rgba = canvas.read(0);
    return frame;
}

Picture picture_of(const std::vector<float>& rgba) {
    Picture picture;
    for (std::size_t i = 0; i < rgba.size(); i += 4)
        picture.rgb.insert(picture.rgb.end(), {rgba[i], rgba[i + 1], rgba[i + 2]});
    return picture;
}

Clocks drawn_by(const std::string& engine, Scene scene, Picture& picture) {
    scene.settings.engine = engine;
    scene.settings.check = Check::none;
    return quickest([&] { picture = engine_named(engine).draw(scene, {}).picture; }, 2, 1);
}

// 1920 x 1080 pixels at depth 12: the kernel alone, for cards that must keep up with a screen.
void window(BenchTables& tables, const GlContext& context) {
    tables.section("1920 x 1080 pixels, depth 12, 73 facets",
                   fmt::format("one ray a pixel; driver {}", context.renderer()),
                   {"frame ms", "frames/s", "start ms"});
    for (Case one : cases(1080)) {
        one.scene.camera.width = 1920;
        one.scene.settings.depth = 12;
        const Frame frame = gpu_frame(one.scene, context);
        tables.line(one.name, {fmt::format("{:.2f}", 1e3 * frame.draw.wall),
                               fmt::format("{:.0f}", 1 / frame.draw.wall),
                               fmt::format("{:.0f}", 1e3 * frame.start.wall)});
    }
}

void run(int pixels, const std::string& json) {
    const GlContext context;
    BenchTables tables;
    tables.section(
        fmt::format("{} x {} pixels, depth 7, 73 facets", pixels, pixels),
        fmt::format("one ray a pixel; driver {}; times in ms, all threads", context.renderer()),
        {"gpu CPU", "gpu wall", "start wall", "reference CPU", "beams CPU", "gpu RMSE",
         "beams RMSE", "inner", "gpu off", "beams off", "pixels"});
    for (const Case& one : cases(pixels)) {
        const Frame frame = gpu_frame(one.scene, context);
        // For crystals the reference is the other engine that merges the waves.
        const bool crystal = one.scene.stone.material.optic != OpticCharacter::isotropic;
        Picture beams, truth;
        const Clocks by_beams = drawn_by(k_beam_engine, one.scene, beams);
        const Clocks by_reference =
            crystal ? Clocks{} : drawn_by(k_reference_engine, one.scene, truth);
        if (crystal) truth = beams;
        const std::vector<bool> inner = inner_pixels(one.scene);
        const PixelErrors gpu = errors_of(picture_of(frame.rgba), truth, inner),
                          rival = errors_of(beams, truth, inner);
        const auto ms = [](double seconds) { return fmt::format("{:.1f}", 1e3 * seconds); };
        const auto error = [](double v) { return fmt::format("{:.2g}", v); };
        tables.line(one.name,
                    {ms(frame.draw.cpu), ms(frame.draw.wall), ms(frame.start.wall),
                     crystal ? "" : ms(by_reference.cpu), ms(by_beams.cpu), error(gpu.inner_rms),
                     crystal ? "" : error(rival.inner_rms), fmt::format("{}", gpu.inner),
                     fmt::format("{}", gpu.off), crystal ? "" : fmt::format("{}", rival.off),
                     fmt::format("{}", gpu.stone)});
    }
    window(tables, context);
    if (!json.empty())
        write_text(json, tables.json({{"bench", "gpu"}, {"driver", context.renderer()}}));
}

}  // namespace
}  // namespace culet

int main(int argc, char** argv) {
    CLI::App app("The GPU kernel beside the reference and the beams");
    int pixels = 512;
    std::string json;
    app.add_option("--pixels", pixels);
    app.add_option("--json", json);
    CLI11_PARSE(app, argc, argv);
    try {
        culet::run(pixels, json);
    } catch (const std::exception& error) {
        std::cerr << error.what() << "\n";
        return 2;
    }
    return 0;
}
