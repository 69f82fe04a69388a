// The cost of effects that are off. A clear isotropic stone in unpolarised light at one wavelength
// is drawn by the normal renderer, by the renderer compiled without any effect
// (render/setup/built_effects.h), and by a minimal tracer (bare_tracer.h).
//
// This source is built twice. bench_stripped runs itself and bench_stripped_without in alternating
// order, one drawing at a time, and compares processor times and pictures.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <stdexcept>

#include "bench/bare_tracer.h"
#include "render/beams/frame_renderer.h"
#include "render/render.h"
#include "render/setup/built_effects.h"
#include "stone/text/errors.h"
#include "tests/cpu_time.h"
#include "tests/render/bench_scenes.h"

namespace {

using namespace culet;

constexpr int k_side = 3, k_depth = 200, k_drawings = 3, k_frames = 20;
constexpr double k_cut = 1e-3;

struct Case {
    const char* name;
    const char* engine;
    bool caps;
    int pixels;
};
constexpr std::array<Case, 4> k_cases{{{"reference, lobes", "reference", false, 160},
                                       {"reference, caps", "reference", true, 160},
                                       {"beams, 20 frames", "beams", false, 400},
                                       {"preview, 20 frames", "preview", false, 400}}};

Scene scene_of(const Case& which) {
    Scene scene = base_scene(which.pixels);
    scene.stone.material = catalogue_material("cubic_zirconia");
    RenderSettings& settings = scene.settings;
    settings.effects.fill(false);
    settings.threads = 1;
    settings.engine = which.engine;
    settings.wavelengths_nm = {589.3};
    if (which.engine == std::string("reference")) {
        settings.samples = k_side * k_side;
        settings.depth = k_depth;
        // With a cut weight and a tolerance given, no pilot is drawn.
        settings.tolerance = 1e-3;
        settings.cut_weight = k_cut;
    }
    if (which.caps) {
        scene.lights.sources.clear();
        scene.lights.sources.push_back(DiscLight{{0, 0, 1}, 0.2, 0.7, {3.0}});
        scene.lights.sources.push_back(DiscLight{{0.8, 0, 0.6}, 0, 0.5, {2.0}});
    }
    return scene;
}

struct Drawing {
    std::vector<double> cpu;
    std::vector<float> rgb;
};

Drawing draw_here(const Case& which, bool bare) {
    const Scene scene = scene_of(which);
    Drawing drawing;
    const auto timed = [&](const auto& work) {
        for (int i = 0; i <= k_drawings; ++i) {
            const double start = clocks().cpu;
            work();
            // The first run warms up memory.
            if (i > 0) drawing.cpu.push_back(clocks().cpu - start);
        }
    };
    if (bare) {
        BarePicture picture;
        timed([&] { picture = draw_bare(scene, k_side, k_depth, k_cut); });
        for (double v : picture.radiance)
            drawing.rgb.insert(drawing.rgb.end(), 3, static_cast<float>(v));
    } else if (which.engine == std::string("reference")) {
        RenderResult result;
        timed([&] { result = render(scene); });
        drawing.rgb = result.picture.rgb;
    } else {
        FrameRenderer frames(scene);
        timed([&] {
            for (int frame = 0; frame < k_frames; ++frame) {
                frames.look_from(scene.camera);
                frames.draw();
            }
        });
        drawing.rgb = frames.draw().picture.rgb;
    }
    return drawing;
}

void print_drawing(const Drawing& drawing) {
    for (double cpu : drawing.cpu) fmt::print("{:.9f}\n", cpu);
    std::fwrite(drawing.rgb.data(), sizeof(float), drawing.rgb.size(), stdout);
}

Drawing drawn_by(const std::string& program, int which, bool bare) {
    const std::string command =
        fmt::format("'{}' --draw {}{}", program, which, bare ? " --bare" : "");
    const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
    if (!pipe) throw std::runtime_error("cannot start " + program);
    Drawing drawing;
    for (int i = 0; i < k_drawings; ++i) {
        std::array<char, 64> line{};
        if (std::fgets(line.data(), line.size(), pipe.get()) == nullptr)
            throw std::runtime_error(program + " drew nothing");
        drawing.cpu.push_back(std::strtod(line.data(), nullptr));
    }
    std::array<float, 4096> piece{};
    for (std::size_t got = 0;
         (got = std::fread(piece.data(), sizeof(float), piece.size(), pipe.get())) > 0;)
        drawing.rgb.insert(drawing.rgb.end(), piece.begin(),
                           piece.begin() + static_cast<std::ptrdiff_t>(got));
    return drawing;
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const std::size_t n = values.size();
    return n == 0 ? 0 : 0.5 * (values[(n - 1) / 2] + values[n / 2]);
}

// Largest difference of two pictures, relative to the mean of the first.
double apart(const std::vector<float>& a, const std::vector<float>& b) {
    if (a.size() != b.size() || a.empty()) return std::numeric_limits<double>::infinity();
    double most = 0, mean = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        most = std::max(most, std::abs(static_cast<double>(a[i]) - static_cast<double>(b[i])));
        mean += static_cast<double>(a[i]) / static_cast<double>(a.size());
    }
    return most / mean;
}

void compare(const std::string& self, int rounds) {
    const std::string other = self + "_without";
    fmt::print("{:<20}{:<16}{:>12}{:>9}  {:<14}  {}\n", "scene", "beside", "CPU ms", "ratio",
               "of the rounds", "largest difference over the mean");
    for (std::size_t c = 0; c < k_cases.size(); ++c) {
        const int number = static_cast<int>(c);
        const bool traced = k_cases[c].engine == std::string("reference");
        const int contestants = traced ? 3 : 2;
        std::array<std::vector<double>, 3> cpu;
        std::array<std::vector<float>, 3> rgb;
        for (int round = 0; round < rounds; ++round) {
            for (int turn = 0; turn < contestants; ++turn) {
                // Each is first as often as last.
                const std::size_t who =
                    static_cast<std::size_t>(round % 2 == 0 ? turn : contestants - 1 - turn);
                Drawing drawing = drawn_by(who == 1 ? other : self, number, who == 2);
                cpu[who].push_back(*std::min_element(drawing.cpu.begin(), drawing.cpu.end()));
                rgb[who] = std::move(drawing.rgb);
            }
        }
        const double own = median(cpu[0]);
        fmt::print("{:<20}{:<16}{:>12.2f}\n", k_cases[c].name, "(all effects)", 1e3 * own);
        for (std::size_t who = 1; who < static_cast<std::size_t>(contestants); ++who) {
            // Ratios within each round, since the machine's other load changes between rounds.
            std::vector<double> ratios;
            for (std::size_t round = 0; round < cpu[0].size(); ++round)
                ratios.push_back(cpu[0][round] / cpu[who][round]);
            const auto [least, most] = std::minmax_element(ratios.begin(), ratios.end());
            fmt::print("{:<20}{:<16}{:>12.2f}{:>9.3f}  {:.3f} to {:.3f}  {:.2g}\n", "",
                       who == 1 ? "compiled out" : "bare tracer", 1e3 * median(cpu[who]),
                       median(ratios), *least, *most, apart(rgb[0], rgb[who]));
        }
        std::fflush(stdout);
    }
}

}  // namespace

int main(int argc, char** argv) {
    int which = -1, rounds = 7;
    bool bare = false;
    CLI::App program{"what effects that are off cost, beside a build that has none"};
    program.add_option("--rounds", rounds, "of three drawings by each");
    program.add_option("--draw", which, "draw one case, for the other program");
    program.add_flag("--bare", bare, "by the bare tracer");
    CLI11_PARSE(program, argc, argv);
    try {
        if (which >= 0) {
            print_drawing(draw_here(k_cases.at(static_cast<std::size_t>(which)), bare));
        } else {
            static_assert(k_cases.size() == 4);
            compare(std::filesystem::canonical("/proc/self/exe").string(), rounds);
        }
        return 0;
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}\n", error.what());
        return 2;
    }
}
