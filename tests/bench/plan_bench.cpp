// Does the plan keep its word? Over scenes and tolerances: measured error beside the bound, and the
// time beside that of the cheapest settings chosen by hand. Reference pictures are drawn at some
// pixels only, so that it ends in minutes.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <limits>

#include "render/colour_error.h"
#include "render/plan/planner.h"
#include "render/plan/verify.h"
#include "stone/errors.h"
#include "tests/bench/cpu_time.h"
#include "tests/bench/effect_prices.h"
#include "tests/bench/plan_scenes.h"

namespace {

using namespace culet;

struct Options {
    int pixels = 64, checked = 60, first = 0, count = 60, every = 1;
    int truth_rays = 400;
    std::vector<double> tolerances{0.1, 0.03, 0.01, 0.003};
    bool turns = false, prices = false, beams_only = false;
};

// A picture of the settled settings: whole by beams, at the truth's pixels by the reference.
struct Drawn {
    Verification found;
    double cpu = 0, bound = 0;
    std::string engine;
    int samples = 0;
    std::size_t wavelengths = 0;
};

Drawn drawn_by_reference(const Scene& scene, const Truth& truth) {
    PathLimits limits;
    const RenderSettings& settings = scene.settings;
    limits.seed = settings.seed;
    limits.depth = settings.depth > 0 ? settings.depth : k_deepest;
    limits.cut_weight = *settings.cut_weight;
    limits.split_weight = *settings.split_weight;
    limits.roulette = make_plan(scene).splits;
    const Clocks start = clocks();
    const PilotDrawing drawing = draw_pilot(scene, truth.pixels, limits, settings.samples);
    Drawn result;
    result.cpu = (clocks().cpu - start.cpu) * truth.pixels.in_picture /
                 static_cast<double>(truth.pixels.at.size());
    Picture picture;
    picture.width = scene.camera.width;
    picture.height = scene.camera.height;
    picture.rgb.resize(3 * picture.pixels());
    for (std::size_t i = 0; i < truth.pixels.at.size(); ++i) {
        const auto [x, y] = truth.pixels.at[i];
        for (std::size_t c = 0; c < 3; ++c)
            picture.rgb[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                             static_cast<std::size_t>(x)) +
                        c] = static_cast<float>(drawing.rgb[i][c]);
    }
    result.found = hold_against(truth, picture);
    result.bound =
        settings.samples > 1 ? drawing.few_rays : std::numeric_limits<double>::quiet_NaN();
    result.engine = "reference";
    return result;
}

Drawn drawn(const Scene& scene, const Truth& truth) {
    Drawn result;
    if (scene.settings.engine == "reference") {
        result = drawn_by_reference(scene, truth);
    } else {
        const Clocks start = clocks();
        const RenderResult rendered = render(scene);
        result.cpu = clocks().cpu - start.cpu;
        result.found = hold_against(truth, rendered.picture);
        result.bound = rendered.stats.engine_error;
        result.engine = rendered.stats.engine;
    }
    result.samples = scene.settings.samples;
    result.wavelengths = scene.settings.wavelengths_nm.size();
    return result;
}

// As render() has it.
double bound_of(const ScenePlan& plan, const Drawn& result) {
    return plan.bound + (result.engine == "reference"
                             ? std::max(plan.bound_of_sampling, result.bound)
                             : result.bound);
}

double median(std::vector<double> values) {
    if (values.empty()) return 0;
    std::nth_element(values.begin(), values.begin() + static_cast<long>(values.size() / 2),
                     values.end());
    return values[values.size() / 2];
}

// What rays that take turns with the wavelengths bring.
void turns(const Options& options) {
    const PlanScene item = plan_scenes(options.pixels)[static_cast<std::size_t>(options.first)];
    Scene scene = item.scene;
    const StonePixels pixels = stone_pixels(scene, options.checked);
    PathLimits limits;
    limits.depth = k_deepest;
    limits.cut_weight = make_plan(scene).splits ? 0.01 : 1e-3;
    limits.split_weight = 0.1;
    limits.roulette = make_plan(scene).splits;
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

int run(const Options& options) {
    std::vector<PlanScene> scenes = plan_scenes(options.pixels);
    std::vector<double> ratios, planning, planning_ms;
    int cases = 0, over = 0, under = 0;
    fmt::print("{:<40}{:>7} {:<10}{:>5}{:>4} {:>9}{:>9}{:>9}{:>8}{:>9}{:>9}  {}\n", "scene", "tol",
               "engine", "rays", "nm", "bound", "measured", "noise", "dE", "plan ms", "CPU ms",
               "off");
    for (int i = options.first; i < std::min(options.first + options.count, 60);
         i += options.every) {
        PlanScene& item = scenes[static_cast<std::size_t>(i)];
        Truth truth;
        for (double tolerance : options.tolerances) {
            Scene scene = item.scene;
            scene.settings.tolerance = tolerance;
            const Clocks start = clocks();
            const ScenePlan plan = plan_scene(scene);
            const double plan_cpu = clocks().cpu - start.cpu;
            if (truth.pixels.at.empty()) {
                ScenePlan finest;
                finest.settings.wavelengths_nm.assign(57, 0);
                finest.settings.cut_weight = 1e-3;
                truth = draw_truth(item.scene, finest, options.checked, options.truth_rays);
            }
            Scene settled = item.scene;
            settled.settings = plan.settings;
            Drawn result = drawn(settled, truth);
            double bound = bound_of(plan, result);
            if (result.engine != "reference" && bound > tolerance && options.beams_only) {
                fmt::print(
                    "    beams: {:.2g} by their check with {} rays at {} pixels, measured "
                    "{:.2g}, plan {:.2g}, {:.1f} ms\n",
                    result.bound, plan.settings.checked_samples, plan.settings.checked_pixels,
                    result.found.measured, plan.bound, 1e3 * result.cpu);
            } else if (result.engine != "reference" && bound > tolerance) {
                const double before = result.cpu;
                fmt::print(
                    "    beams: {:.2g} by their check with {} rays at {} pixels, measured "
                    "{:.2g}, plan {:.2g}, {:.1f} ms\n",
                    result.bound, plan.settings.checked_samples, plan.settings.checked_pixels,
                    result.found.measured, plan.bound, 1e3 * before);
                settled.settings = plan.reference;
                result = drawn(settled, truth);
                result.engine = "ref. after";
                result.cpu += before;
                bound = bound_of(plan, result);
            }
            // As render() does, once.
            const double room = tolerance - plan.bound;
            if (bound > tolerance && settled.settings.engine == "reference" && room > 0) {
                const double before = result.cpu;
                settled.settings.samples =
                    rays_to_reach(room, settled.settings.samples, bound - plan.bound);
                result = drawn(settled, truth);
                result.cpu += before;
                bound = plan.bound + result.bound;
            }
            const Verification& found = result.found;
            std::string off;
            for (const PlanItem& line : plan.items) {
                if (!line.on && line.bound > 0) off += line.name + " ";
            }
            fmt::print(
                "{:<40}{:>7g} {:<10}{:>5}{:>4} {:>9.2g}{:>9.2g}{:>9.2g}{:>8.2g}{:>9.1f}"
                "{:>9.1f}  {}{}{}\n",
                item.name, tolerance, result.engine, result.samples, result.wavelengths, bound,
                found.measured, found.noise, found.delta_e, 1e3 * plan_cpu, 1e3 * result.cpu, off,
                found.measured > tolerance ? "OVER " : "", found.measured > bound ? "BOUND " : "");
            std::fflush(stdout);
            ++cases;
            over += found.measured > tolerance;
            under += found.measured > bound;
            if (found.measured > 0) ratios.push_back(bound / found.measured);
            planning.push_back(plan_cpu / result.cpu);
            planning_ms.push_back(1e3 * plan_cpu);
        }
    }
    fmt::print(
        "{} cases: {} over the tolerance, {} over the bound; bound / measured in the median "
        "{:.3g}; planning / picture in the median {:.3g}, {:.3g} ms\n",
        cases, over, under, median(ratios), median(planning), median(planning_ms));
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    CLI::App program{"plans: bounds against measured errors, and what planning costs"};
    program.add_option("--pixels", options.pixels, "along a side");
    program.add_option("--checked", options.checked, "pixels of the truth");
    program.add_option("--truth-rays", options.truth_rays, "rays in each of them");
    program.add_option("--first", options.first, "scene to start with, from 0");
    program.add_option("--count", options.count, "scenes");
    program.add_option("--every", options.every, "of the scenes, every so many");
    program.add_option("--tolerance", options.tolerances, "instead of 0.1 0.03 0.01 0.003");
    program.add_flag("--prices", options.prices, "what each effect costs, on and off");
    program.add_flag("--turns", options.turns, "rays that take turns with wavelengths");
    program.add_flag("--beams-only", options.beams_only, "do not fall back to the reference");
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
