// culet optimize STONE|CUT -o BETTER.asc: better angles with the meets kept.

#include "render/optimize/optimize.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "app/grade/command_grade.h"
#include "app/grade/optimize_options.h"
#include "app/input/grade_input.h"
#include "app/program/terminal.h"
#include "render/grade/grade_figures.h"
#include "render/optimize/optimized_json.h"
#include "stone/gemcad/gemcad_io.h"
#include "stone/text/errors.h"
#include "stone/text/output_file.h"

namespace culet {

namespace fs = std::filesystem;

namespace {

LightModel model_called(const std::string& name) {
    for (int m = 0; m < k_light_model_count; ++m) {
        if (name == name_of(static_cast<LightModel>(m))) return static_cast<LightModel>(m);
    }
    throw InputError(
        fmt::format("--model is iso, cos, sc2, random or wlr (docs/grade.md), found \"{}\"", name));
}

OptimizeOptions options_of(const OptimizeCommand& command, const GradeInput& input) {
    OptimizeOptions options;
    options.merit.index =
        grade_index(input.has_material ? &input.stone.material : nullptr, input.index);
    options.merit.model = model_called(command.model);
    options.merit.head = radians(command.head_deg);
    options.merit.weights = merit_weights(command.objective);
    options.merit.threads = command.common.threads;
    options.evaluations = command.evaluations;
    options.limits.range = radians(command.range_deg);
    options.limits.over_critical = radians(command.over_critical_deg);
    options.limits.least_volume = command.least_volume_percent / 100;
    if (!command.table.empty()) {
        std::string list = command.table;
        std::replace(list.begin(), list.end(), ':', ',');
        const std::vector<double> range =
            numbers_in(list, 2, 2, "--table is LEAST:MOST, per cent of the stone's width");
        options.limits.least_table = range[0] / 100;
        options.limits.most_table = range[1] / 100;
    }
    if (command.recut) options.recut = Recut{command.gain, command.most_loss_percent / 100};
    return options;
}

void print_result(const Optimized& result, const Design& design, const OptimizeCommand& command) {
    std::string text = fmt::format(
        "{}: {:.2f} before, {:.2f} now ({:.2f} where crown and pavilion are each "
        "scaled as a whole)\n",
        command.objective, result.at_start.total, result.at_better.total,
        result.by_two_factors.total);
    const std::vector<std::string> names = tier_words(result, design);
    for (std::size_t t = 0; t < names.size(); ++t)
        text += fmt::format("  {:<16}{:>8.2f} -> {:.2f} degrees\n", names[t],
                            degrees(result.tiers[t].from), degrees(result.tiers[t].to));
    text += fmt::format("  table {:.1f} -> {:.1f} % of the width; ",
                        100 * table_share(result.start), 100 * table_share(result.better));
    text += command.recut ? fmt::format("{:.2f} % of the weight is cut away\n",
                                        100 * (1 - result.volume_ratio))
                          : fmt::format("volume {:+.2f} %\n", 100 * (result.volume_ratio - 1));
    if (!result.found) text += "  nothing better was found: the angles stay as they are\n";
    print_lines(text);
}

// The solid's, or the one that its drawing shows; without a title it gets the stone's name.
Design design_of(const OptimizeOptions& options, const GradeInput& input) {
    Design design = cutting_design(input.stone.solid);
    if (design.headings.empty()) design.headings.push_back(input.name);
    // Designs state four decimals.
    design.refractive_index = std::round(1e4 * options.merit.index.n) / 1e4;
    return design;
}

// Figures that got worse, which a buyer may ask for but the objective ignored.
void print_losses(const Optimized& result, const OptimizeOptions& options) {
    GradeOptions grade;
    grade.head = options.merit.head;
    grade.threads = options.merit.threads;
    const auto figures = [&](const Solid& solid) {
        return figures_of(grade_stone(solid, options.merit.index, grade));
    };
    const std::vector<GradeFigure> before = figures(result.start), now = figures(result.better);
    // Points; smaller changes are invisible.
    constexpr double k_seen = 0.05;
    for (const GradeFigure& was : before) {
        if (!was.percent && was.name != "weighted_light_return") continue;
        const auto is = std::find_if(now.begin(), now.end(), [&](const GradeFigure& figure) {
            return figure.name == was.name;
        });
        const double scale = was.percent ? 1 : 100;
        if (is != now.end() && scale * (was.value - is->value) > k_seen)
            print_lines(fmt::format("  worse than before: {} {:.2f} -> {:.2f} %\n", was.words,
                                    scale * was.value, scale * is->value));
    }
}

int run_optimize(OptimizeCommand command) {
    if (!is_cut(command.out)) {
        throw InputError(command.out,
                         "is written as a cut design: give it the ending .asc, .gem or .gcs");
    }
    command.choices.command = "culet optimize";
    command.choices.index = command.index;
    command.choices.overrides = command.common.set;
    command.choices.quiet = command.common.quiet;
    if (command.gain > 0 && !command.recut)
        throw InputError("--gain is for recutting a stone: give --recut too");
    GradeInput input = load_for_grade(command.file, command.choices, false).front();
    const OptimizeOptions options = options_of(command, input);
    require_writable(command.out);
    require_writable(command.json);
    Optimized result;
    try {
        result = optimize_cut(input.stone.solid, options,
                              progress_line("optimize", command.common.quiet));
    } catch (const InputError& error) {
        throw InputError(input.file, error.what());
    }
    Design design = design_of(options, input);
    const Design given = design;
    const fs::path before = fs::path(command.page) / "before.asc";
    if (!command.page.empty()) {
        fs::create_directories(command.page);
        write_cut(result.start, design, before);
    }
    design.footnotes.push_back(fmt::format("Angles by culet optimize, for {}", command.objective));
    say_notes(command.out, write_cut(about_its_axis(result), design, command.out),
              command.common.quiet);
    if (!command.json.empty())
        write_text(command.json, optimized_json(result, given, options, command.objective));
    if (command.json != "-") {
        print_result(result, given, command);
        if (result.found && !result.interrupted) print_losses(result, options);
    }
    // The last note of an untrusted fit is printed below.
    for (std::size_t i = 0; i + (input.trusted ? 0 : 1) < input.notes.size(); ++i)
        say(fmt::format("{}: {}", input.file, input.notes[i]), command.common.quiet);
    if (result.interrupted) {
        say(fmt::format("interrupted after {} of about {} cuts: {} is the best until then",
                        result.evaluations, options.evaluations, command.out),
            command.common.quiet);
        return exit_interrupted;
    }
    if (!command.page.empty())
        write_grade_page({before.string(), command.out}, command.choices, command.page,
                         command.common, optimized_json(result, given, options, command.objective));
    if (!input.trusted)
        say(fmt::format("{}: the fit should not be trusted, nor should these angles: {}",
                        input.file, input.notes.back()),
            command.common.quiet);
    if (!result.gained)
        say(fmt::format("a gain of {:g} was not reached: ask for less, or allow more --range",
                        command.gain),
            command.common.quiet);
    say(fmt::format("next: culet info {} --cutting-sheet sheet.html (to cut it)", command.out),
        command.common.quiet);
    return input.trusted && result.gained ? exit_good : exit_untrusted;
}

}  // namespace

void add_command_optimize(CLI::App& program, int& exit_code) {
    auto command = std::make_shared<OptimizeCommand>();
    CLI::App* optimize = program.add_subcommand(
        "optimize", "better angles for a cut: its index settings and meets are kept");
    add_optimize_options(*optimize, *command);
    optimize->footer(
        "Examples:\n"
        "  culet optimize design.asc --material quartz -o better.asc --page out/better\n"
        "  culet optimize design.asc --index 1.54 --objective brilliance=2,tilt=1 -o better.asc\n"
        "  culet optimize stone.toml --recut --gain 2 -o recut.asc");
    optimize->callback([optimize, command, &exit_code] {
        command->choices.given = as_given(*optimize);
        exit_code = run_optimize(*command);
    });
}

}  // namespace culet
