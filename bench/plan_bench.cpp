// Does the plan keep its promises? Over scenes and tolerances: the measured error beside the bound,
// and the time beside that of the cheapest settings chosen by hand. References are drawn at some
// pixels only, so that it takes minutes.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "bench/effect_prices.h"
#include "bench/hand_chosen.h"
#include "render/beams/frame_renderer.h"
#include "render/colour/colour_error.h"
#include "render/engine/engine.h"
#include "render/image/image_io.h"
#include "render/planner/explain.h"
#include "render/planner/planner.h"
#include "render/planner/truth.h"
#include "render/planner/wavelengths.h"
#include "render/render.h"
#include "stone/text/errors.h"
#include "tests/cpu_time.h"
#include "tests/render/plan_scenes.h"

namespace {

using namespace culet;

struct Options {
    int pixels = 64, checked = 60, first = 0, count = 60, every = 1;
    int truth_rays = 400;
    std::vector<double> tolerances{0.1, 0.03, 0.01, 0.003};
    std::filesystem::path whole;  // folder of true pictures; empty: at some pixels
    bool turns = false, prices = false, against_cheapest = false, list = false;
};

double median(std::vector<double> values) {
    if (values.empty()) return 0;
    std::nth_element(values.begin(), values.begin() + static_cast<long>(values.size() / 2),
                     values.end());
    return values[values.size() / 2];
}

// The benefit of rays that take turns with the wavelengths.
void turns(const Options& options) {
    const PlanScene item = plan_scenes(options.pixels)[static_cast<std::size_t>(options.first)];
    Scene scene = item.scene;
    const StonePixels pixels = stone_pixels(scene, options.checked);
    PathLimits limits;
    limits.depth = k_deepest;
    limits.cut_weight = make_optical_setup(scene).splits ? 0.01 : 1e-3;
    limits.split_weight = 0.1;
    limits.roulette = make_optical_setup(scene).splits;
    const auto draw = [&](int rays, int nodes, int turn) {
        Scene drawn = scene;
        drawn.settings.wavelengths_nm = even_wavelengths(nodes);
        drawn.settings.wavelength_turns = turn;
        return draw_pilot(drawn, pixels, limits, rays);
    };
    const PilotDrawing truth = draw(options.truth_rays, 57, turns_for(options.truth_rays, 57));
    fmt::print("{}: rays, wavelengths, turns: error, by halves, seconds; truth {:.3g}\n", item.name,
               truth.few_rays);
    for (int rays : {4, 16, 64, 144, 256}) {
        for (int nodes : {8, 15, 29, 57}) {
            for (int turn : {1, 2, 4, 8, 16, 32}) {
                if (2 * turn > rays || turn > nodes || nodes > 10 * turn) continue;
                const PilotDrawing found = draw(rays, nodes, turn);
                fmt::print("{:>5}{:>4}{:>4} {:>10.3g}{:>10.3g}{:>10.3g}\n", rays, nodes, turn,
                           colour_error(found.rgb, truth.rgb).radiance, found.few_rays,
                           found.seconds);
                std::fflush(stdout);
            }
        }
    }
}

// Everything on; the same for all tolerances.
ScenePlan finest_plan() {
    ScenePlan finest;
    finest.settings.wavelengths_nm.assign(57, 0);
    finest.settings.cut_weight = 1e-3;
    return finest;
}

Truth truth_of(const Scene& scene, const Options& options) {
    return draw_truth(scene, finest_plan(), options.checked, options.truth_rays);
}

// Draws every pixel, which takes minutes; kept in a file.
Truth whole_truth_of(const Scene& scene, std::size_t number, const Options& options) {
    const std::filesystem::path file =
        options.whole / fmt::format("{}-{}-{}.exr", number, options.pixels, options.truth_rays);
    const StonePixels pixels = all_stone_pixels(scene);
    if (!std::filesystem::exists(file)) {
        const Truth drawn = draw_truth(scene, finest_plan(), pixels, options.truth_rays);
        Picture picture;
        picture.width = scene.camera.width;
        picture.height = scene.camera.height;
        picture.rgb.resize(3 * picture.pixels());
        for (std::size_t i = 0; i < pixels.at.size(); ++i) {
            const auto [x, y] = pixels.at[i];
            const std::size_t first = static_cast<std::size_t>(3 * (y * picture.width + x));
            for (std::size_t c = 0; c < 3; ++c)
                picture.rgb[first + c] = static_cast<float>(drawn.drawing.rgb[i][c]);
        }
        write_picture(picture, file, {},
                      {{"culet:few_rays", fmt::format("{}", drawn.drawing.few_rays)},
                       {"culet:seconds", fmt::format("{}", drawn.drawing.seconds)}});
    }
    const Picture picture = read_picture(file).picture;
    Truth truth;
    truth.pixels = pixels;
    truth.samples = options.truth_rays;
    for (const auto& [x, y] : pixels.at) truth.drawing.rgb.push_back(picture.pixel(x, y));
    for (const auto& [key, value] : picture.text) {
        if (key == "culet:few_rays") truth.drawing.few_rays = std::stod(value);
        if (key == "culet:seconds") truth.drawing.seconds = std::stod(value);
    }
    return truth;
}

// Processor time of the plan's final settings, as if chosen by hand.
double seconds_of_chosen(const Scene& whole, const ScenePlan& plan) {
    Scene scene = whole;
    scene.settings = plan.settings;
    const auto draw = [&] {
        if (drawn_by_beams(scene.settings))
            FrameRenderer(scene).draw(false);
        else
            engine_of(scene.settings).draw(scene, {});
    };
    return quickest(draw, 1, 0).cpu;
}

// Compares the automatic picture, with all its overhead, with the truth and with the cheapest
// settings of a sweep.
int run(const Options& options) {
    std::vector<PlanScene> scenes = plan_scenes(options.pixels);
    fmt::print(
        "{:<36}{:>6} {:<10}{:>5}{:>4}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}{:>8}{:>8}  {}\n",
        "scene", "tol", "engine", "rays", "nm", "bound", "measured", "noise", "plan ms", "CPU ms",
        "drawn ms", "hand ms", "error", "ratio", "drawn", "by hand");
    struct Sums {
        std::vector<double> ratios, drawn_ratios, bounds, planning, planning_ms, cpu_ms;
        int over = 0, under = 0, cases = 0;
    };
    std::vector<Sums> sums(options.tolerances.size());
    const double finest = *std::min_element(options.tolerances.begin(), options.tolerances.end());
    for (int i = options.first; i < std::min(options.first + options.count, 60);
         i += options.every) {
        const PlanScene& item = scenes[static_cast<std::size_t>(i)];
        const Truth truth = options.whole.empty()
                                ? truth_of(item.scene, options)
                                : whole_truth_of(item.scene, static_cast<std::size_t>(i), options);
        const std::vector<HandChosen> by_hand = options.against_cheapest
                                                    ? hand_chosen(item.scene, truth, finest)
                                                    : std::vector<HandChosen>{};
        for (std::size_t t = 0; options.list && t < by_hand.size(); ++t) {
            fmt::print("    {:<50}{:>9.2f}{:>9.4f}\n", by_hand[t].words, 1e3 * by_hand[t].cpu,
                       by_hand[t].error);
        }
        for (std::size_t t = 0; t < options.tolerances.size(); ++t) {
            const double tolerance = options.tolerances[t];
            Scene scene = item.scene;
            scene.settings.tolerance = tolerance;
            RenderResult drawn;
            const Clocks took = quickest([&] { drawn = render(scene); }, 1, 0);
            // If nothing was drawn twice, the time besides drawing is planning and estimation.
            const double planned = drawn.stats.plan->seconds_planning;
            const Verification found = compare_with_truth(truth, drawn.picture);
            const HandChosen* best = cheapest_within(by_hand, tolerance);
            Sums& sum = sums[t];
            ++sum.cases;
            const double bound = drawn.stats.error_bound,
                         ratio = best != nullptr ? took.cpu / best->cpu : 0;
            const double chosen = best != nullptr ? seconds_of_chosen(scene, *drawn.stats.plan) : 0,
                         drawn_ratio = best != nullptr ? chosen / best->cpu : 0;
            // Within the truth's own accuracy.
            const double certain = found.measured - 2 * found.standard_error;
            const bool over = found.measured > tolerance, under = found.measured > bound;
            sum.over += certain > tolerance;
            sum.under += certain > bound;
            if (best != nullptr) {
                sum.ratios.push_back(ratio);
                sum.drawn_ratios.push_back(drawn_ratio);
            }
            if (found.measured > 0) sum.bounds.push_back(bound / found.measured);
            sum.planning.push_back(planned / took.wall);
            sum.planning_ms.push_back(1e3 * planned);
            sum.cpu_ms.push_back(1e3 * took.cpu);
            fmt::print(
                "{:<36}{:>6g} {:<10}{:>5}{:>4}{:>9.2g}{:>9.2g}{:>9.2g}{:>9.1f}{:>9.1f}{:>9.1f}"
                "{:>9.1f}{:>9.2g}{:>8.2f}{:>8.2f}  {}{}{}\n",
                item.name.substr(0, 35), tolerance, drawn.stats.engine,
                drawn.stats.plan->settings.samples, drawn.stats.wavelengths_nm.size(), bound,
                found.measured, found.noise, 1e3 * planned, 1e3 * took.cpu, 1e3 * chosen,
                best != nullptr ? 1e3 * best->cpu : 0, best != nullptr ? best->error : 0, ratio,
                drawn_ratio, best != nullptr ? best->words : "-", over ? " OVER" : "",
                under ? " BOUND" : "");
            for (const std::string& note : drawn.stats.notes)
                if (options.list) fmt::print("    {}\n", note);
            if (options.list) fmt::print("{}", explain(*drawn.stats.plan));
            std::fflush(stdout);
        }
    }
    for (std::size_t t = 0; t < options.tolerances.size(); ++t) {
        const Sums& sum = sums[t];
        fmt::print(
            "tolerance {:g}: {} scenes, {} certainly over it, {} certainly over the bound; in the "
            "median bound / measured {:.3g}, planning / all {:.3g} ({:.3g} ms of {:.3g})",
            options.tolerances[t], sum.cases, sum.over, sum.under, median(sum.bounds),
            median(sum.planning), median(sum.planning_ms), median(sum.cpu_ms));
        if (!sum.ratios.empty()) {
            fmt::print("; time / cheapest {:.3g} in the median, {:.3g} at worst",
                       median(sum.ratios), *std::max_element(sum.ratios.begin(), sum.ratios.end()));
            fmt::print("; of the picture as chosen alone {:.3g}, {:.3g}", median(sum.drawn_ratios),
                       *std::max_element(sum.drawn_ratios.begin(), sum.drawn_ratios.end()));
        }
        fmt::print("\n");
    }
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    CLI::App program{"plans: bounds against measured errors, and what planning costs"};
    program.add_option("--pixels", options.pixels, "along a side");
    program.add_option("--checked", options.checked, "pixels of the truth");
    program.add_option("--truth-rays", options.truth_rays, "rays in each of them");
    program.add_option("--whole", options.whole,
                       "hold against every pixel: folder to keep true pictures in");
    program.add_option("--first", options.first, "scene to start with, from 0");
    program.add_option("--count", options.count, "scenes");
    program.add_option("--every", options.every, "of the scenes, every so many");
    program.add_option("--tolerance", options.tolerances, "instead of 0.1 0.03 0.01 0.003");
    program.add_flag("--prices", options.prices, "what each effect costs, on and off");
    program.add_flag("--turns", options.turns, "rays that take turns with wavelengths");
    program.add_flag("--against-cheapest", options.against_cheapest,
                     "hold the whole time against the cheapest of a sweep");
    program.add_flag("--list", options.list, "the sweep, and the plans");
    CLI11_PARSE(program, argc, argv);
    try {
        if (options.prices) {
            print_effect_prices(128);
            return 0;
        }
        if (options.turns) {
            turns(options);
            return 0;
        }
        return run(options);
    } catch (const InputError& error) {
        fmt::print(stderr, "{}\n", error.what());
        return 2;
    }
}
