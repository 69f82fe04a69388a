// Measures the engine beams: pictures per second and error, varying one parameter at a time about a
// base case (bench_scenes.h), beside the reference, a plain ray tracer and POV-Ray. docs/engines.md
// explains the results.
//
//   bench_beams [--pixels N] [--section NAME] [--json FILE] [--cache DIR]

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <iostream>

#include "bench/beam_bench.h"
#include "render/beams/beam_shading.h"
#include "stone/text/output_file.h"

int main(int argc, char** argv) {
    using namespace culet;
    CLI::App app{"Speed and error of the renderer by beams, in tables on stdout."};
    int pixels = 800;
    std::string section, json, cache;
    app.add_option("--pixels", pixels, "width and height of the pictures")
        ->check(CLI::Range(16, 4000));
    app.add_option("--section", section, "run this part only");
    app.add_option("--json", json, "also write the tables here");
    app.add_option("--cache", cache,
                   "folder that keeps the reference's pictures from run to run; empty it when the "
                   "reference changes")
        ->check(CLI::ExistingDirectory);
    try {
        app.parse(argc, argv);
        const std::string processor = shading_targets().front();
        std::cout << fmt::format(
            "bench_beams, {} x {} pixels, {}\nCPU ms: quickest, one thread; wall ms: all threads; "
            "PSNR: over the largest radiance of the reference's picture;\nerror: mean difference "
            "over "
            "the stone's pixels, over their mean radiance; reported: what the renderer says that "
            "it "
            "is at most\n(both of the exact drawing: to the reference with 1 sample); off: pixels "
            "of the exact drawing over 1e-3 of the peak away from that\n",
            pixels, pixels, processor);
        BeamBench bench(pixels, cache);
        bench.run(section);
        if (!json.empty())
            write_text(json, bench.tables().json({{"schema", "1"},
                                                  {"pixels", std::to_string(pixels)},
                                                  {"instructions", processor}}));
        return 0;
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return app.exit(error);
        std::cerr << "bench_beams: " << error.what() << "\n";
    } catch (const std::exception& error) {
        std::cerr << "bench_beams: " << error.what() << "\n";
    }
    return 2;
}
