// culet fit STONE.toml -o FITTED.obj [--report FIT.json]

#include <fmt/format.h>

#include <memory>

#include "app/program/file_kinds.h"
#include "app/program/options.h"
#include "app/program/terminal.h"
#include "fit/findings/summary.h"
#include "fit/fit.h"
#include "page/drawing.h"
#include "page/fit_paint.h"
#include "stone/stone_io.h"
#include "stone/text/errors.h"
#include "stone/text/output_file.h"

namespace culet {

namespace {

struct FitCommand {
    CommonOptions common;
    std::string stone, output, report, drawing, paint = "residual", from;
    int iterations = 0, starts = 0;
    bool find_symmetry = false, allow_topology = false;
};

// A solid that was fitted before, if it has the mesh's facets.
Solid earlier_fit(const std::string& name, const Solid& mesh) {
    Solid solid = read_solid(name).solid;
    require_earlier_result(solid, mesh, name);
    return solid;
}

void draw(const FitCommand& command, const std::string& title, const FitResult& result,
          const std::string& report) {
    const FitPaint paint =
        fit_paint(result.solid, report,
                  command.paint == "sigma" ? FitColour::uncertainty : FitColour::residual);
    write_text(command.drawing,
               drawing_svg(title, fmt::format("{}: {}", name_of(result.status), result.message),
                           result.solid, paint.facets, paint.legend));
}

std::string next_step(const FitCommand& command, const FitResult& result) {
    if (result.status == FitStatus::not_converged)
        return fmt::format("correct what is named above, then culet fit {} again", command.stone);
    if (result.status == FitStatus::undetermined)
        return fmt::format("read what is named above, then culet fit {} again", command.stone);
    if (result.status == FitStatus::contradictory)
        return fmt::format("correct the readings named above, then culet fit {} -o {} --from {}",
                           command.stone, command.output, command.output);
    return fmt::format(
        "culet grade {0} (how it returns light), culet info {0} --cutting-sheet sheet.html (to cut "
        "it again), or culet render {0} --material NAME -o stone.png (a picture)",
        command.output);
}

int run_fit(const FitCommand& command) {
    require_solid_name(command.output);
    require_writable(command.output);
    require_writable(command.report);
    require_writable(command.drawing);
    require_kind(command.stone, {FileKind::stone}, "culet fit", command.common.set);
    StoneFile file = read_stone(command.stone, command.common.set);
    for (const std::string& detail : file.details) say(detail, !command.common.verbose);
    FitInput input = fit_input(file.stone, read_readings(command.stone, command.common.set));
    input.notes.insert(input.notes.begin(), file.notes.begin(), file.notes.end());
    FitOptions options = read_fit_options(command.stone, command.common.set);
    if (command.iterations > 0) options.iterations = command.iterations;
    if (command.starts > 0) options.starts = command.starts;
    options.find_symmetry = options.find_symmetry || command.find_symmetry;
    options.allow_topology = options.allow_topology || command.allow_topology;
    if (!command.from.empty()) options.start = earlier_fit(command.from, input.stone.solid);

    const FitResult result = [&] {
        try {
            return fit_stone(input, options, progress_line("fit", command.common.quiet));
        } catch (const InputError& error) {
            throw InputError(file.mesh_file, error.what());
        }
    }();
    say_notes(command.output, write_solid(result.solid, command.output), command.common.quiet);
    const std::string report = fit_report(result);
    if (!command.report.empty()) write_text(command.report, report);
    if (!command.drawing.empty()) {
        draw(command, file.stone.name.empty() ? command.stone : file.stone.name, result, report);
    }
    std::string prefix = fmt::format("{}: ", name_of(result.status));
    for (const std::string& sentence : fit_summary(result)) {
        say(prefix + sentence, command.common.quiet);
        prefix.clear();
    }
    say(fmt::format("{} facets, {} corners, planar to {:.1e} {}, {} steps, {:.2f} s",
                    result.solid.facets.size(), result.solid.vertices.size(),
                    result.checks.planarity_max, name_of(result.unit), result.log.iterations,
                    result.log.seconds),
        !command.common.verbose);
    say("next: " + next_step(command, result), command.common.quiet);
    return result.usable() ? exit_good : exit_untrusted;
}

}  // namespace

void add_command_fit(CLI::App& program, int& exit_code) {
    auto command = std::make_shared<FitCommand>();
    CLI::App* fit =
        program.add_subcommand("fit", "fit a hand-made mesh of a stone to its measurements");
    fit->add_option("stone", command->stone, "stone file with its readings")
        ->required()
        ->type_name("STONE.toml");
    fit->add_option("-o,--output", command->output,
                    "fitted mesh (.obj .off .ply .stl .asc .gem .gcs)")
        ->required()
        ->type_name("FITTED");
    fit->add_option("--report,--json", command->report,
                    "readings, residuals, uncertainties, suspects (- is stdout)")
        ->type_name("FIT.json");
    fit->add_option("--drawing", command->drawing,
                    "crown, pavilion and girdle views with facet names (- is stdout)")
        ->type_name("DRAWING.svg");
    fit->add_option("--paint", command->paint,
                    "what its colours show: residual (default) or sigma, how sure each facet is")
        ->check(CLI::IsMember({"residual", "sigma"}))
        ->type_name("WHAT");
    fit->add_option("--iterations", command->iterations, "most steps of the last stage")
        ->check(CLI::Range(1, 1000000))
        ->type_name("N");
    fit->add_option("--starts", command->starts,
                    "most starts to try when the first does not explain the readings (7)")
        ->check(CLI::Range(1, 1000000))
        ->type_name("N");
    fit->add_option("--from", command->from,
                    "an earlier result of the same stone, to go on from after an edit")
        ->type_name("FITTED");
    fit->add_flag("--find-symmetry", command->find_symmetry,
                  "propose the stone's symmetry and tell how well the readings support it");
    fit->add_flag("--allow-topology", command->allow_topology,
                  "change or drop edges and facets that the readings deny; changes are listed");
    add_common(*fit, command->common, true);
    fit->footer(
        "Examples:\n"
        "  culet fit stone.toml -o fitted.obj --report fit.json\n"
        "  culet fit stone.toml -o fitted.obj --drawing fitted.svg --find-symmetry\n"
        "  culet fit stone.toml -o again.obj --from fitted.obj --set fit.meets=soft");
    fit->callback([command, &exit_code] { exit_code = run_fit(*command); });
}

}  // namespace culet
