// The GPU kernel beside the reference and the beams: bench_gpu [--pixels N] [--json FILE]
//
// A round brilliant of 73 facets at depth 7, one ray a pixel, the same rays for all three. A frame
// of the kernel is one pass of all wavelengths with the program compiled; processor time is that of
// all threads of the driver, which computes on the processor (Mesa's llvmpipe) or not at all.
// Errors are over the stone's pixels, relative to their mean.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <iostream>

#include "render/engine/engine.h"
#include "render/gpu/gpu_canvas.h"
#include "render/reference/prepared_scene.h"
#include "stone/material_io.h"
#include "stone/output_file.h"
#include "tests/bench/bench_scenes.h"
#include "tests/bench/bench_table.h"
#include "tests/bench/cpu_time.h"

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

double root_mean_square(const std::vector<float>& rgba, const Picture& truth) {
    double squares = 0, sum = 0, count = 0;
    for (std::size_t i = 0; i < truth.pixels(); ++i) {
        if (!(truth.coverage[i] > 0)) continue;
        for (std::size_t c = 0; c < 3; ++c) {
            const double exact = static_cast<double>(truth.rgb[3 * i + c]),
                         off = static_cast<double>(rgba[4 * i + c]) - exact;
            squares += off * off;
            sum += exact;
            count += 1;
        }
    }
    return std::sqrt(squares / count) / (sum / count);
}

Clocks drawn_by(const std::string& engine, Scene scene, Picture& picture) {
    scene.settings.engine = engine;
    scene.settings.check = Check::none;
    return quickest([&] { picture = engine_named(engine).draw(scene, {}).picture; }, 2, 1);
}

void run(int pixels, const std::string& json) {
    const GlContext context;
    BenchTables tables;
    tables.section(
        fmt::format("{} x {} pixels, depth 7, 73 facets", pixels, pixels),
        fmt::format("one ray a pixel; driver {}; times in ms, all threads", context.renderer()),
        {"gpu CPU", "gpu wall", "start wall", "reference CPU", "beams CPU", "gpu RMSE",
         "beams RMSE"});
    for (const Case& one : cases(pixels)) {
        const Frame frame = gpu_frame(one.scene, context);
        // A crystal's reference is the other engine that merges.
        const bool crystal = one.scene.stone.material.optic != OpticCharacter::isotropic;
        Picture beams, truth;
        const Clocks by_beams = drawn_by(k_beam_engine, one.scene, beams);
        const Clocks by_reference =
            crystal ? Clocks{} : drawn_by(k_reference_engine, one.scene, truth);
        if (crystal) truth = beams;
        std::vector<float> rgba;
        for (std::size_t i = 0; i < beams.rgb.size(); i += 3)
            rgba.insert(rgba.end(), {beams.rgb[i], beams.rgb[i + 1], beams.rgb[i + 2], 1.0f});
        const auto ms = [](double seconds) { return fmt::format("{:.1f}", 1e3 * seconds); };
        const auto error = [](double v) { return fmt::format("{:.2g}", v); };
        tables.line(one.name, {ms(frame.draw.cpu), ms(frame.draw.wall), ms(frame.start.wall),
                               crystal ? "" : ms(by_reference.cpu), ms(by_beams.cpu),
                               error(root_mean_square(frame.rgba, truth)),
                               crystal ? "" : error(root_mean_square(rgba, truth))});
    }
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
