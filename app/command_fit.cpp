// culet fit STONE.toml -o FITTED.obj [--report FIT.json]

#include <fmt/format.h>

#include <memory>

#include "app/options.h"
#include "app/terminal.h"
#include "fit/fit.h"
#include "fit/mending.h"
#include "stone/errors.h"
#include "stone/output_file.h"
#include "stone/stone_io.h"

namespace culet {

namespace {

struct FitCommand {
    CommonOptions common;
    std::string stone, output, report;
    int iterations = 0;
};

int run_fit(const FitCommand& command) {
    require_writable(command.output);
    require_writable(command.report);
    StoneFile file = read_stone(command.stone, command.common.set);
    for (const std::string& note : file.notes) say(note, !command.common.verbose);
    if (file.density_g_cm3) file.stone.material.density_g_cm3 = file.density_g_cm3;
    const Mended mesh = mended(file.stone);
    file.stone = mesh.stone;
    for (const std::string& note : mesh.notes) say(note, command.common.quiet);
    const auto written = read_readings(command.stone, command.common.set);
    const auto readings = bind_readings(written, file.stone);
    FitOptions options = read_fit_options(command.stone, command.common.set);
    if (command.iterations > 0) options.iterations = command.iterations;

    FitResult result = [&] {
        try {
            return fit_stone(file.stone, readings, options,
                             progress_line("fit", command.common.quiet));
        } catch (const InputError& error) {
            throw InputError(file.mesh_file, error.what());
        }
    }();
    result.notes.insert(result.notes.begin(), mesh.notes.begin(), mesh.notes.end());
    write_solid(result.solid, command.output);
    if (!command.report.empty()) write_text(command.report, fit_report(result));
    say(fmt::format("{}: {}", name_of(result.status), result.message), command.common.quiet);
    say(fmt::format("{} facets, {} corners, planar to {:.1e} {}, {} steps, {:.2f} s",
                    result.solid.facets.size(), result.solid.vertices.size(), result.planarity_max,
                    name_of(result.unit), result.iterations, result.seconds),
        !command.common.verbose);
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
    fit->add_option("-o,--output", command->output, "fitted mesh (.obj .off .ply .stl .asc)")
        ->required()
        ->type_name("FITTED");
    fit->add_option("--report,--json", command->report,
                    "readings, residuals, uncertainties, suspects (- is stdout)")
        ->type_name("FIT.json");
    fit->add_option("--iterations", command->iterations, "most steps of the last stage")
        ->check(CLI::Range(1, 1000000))
        ->type_name("N");
    add_common(*fit, command->common, true);
    fit->footer(
        "Examples:\n"
        "  culet fit stone.toml -o fitted.obj --report fit.json\n"
        "  culet fit stone.toml -o fitted.obj --set fit.meets=soft");
    fit->callback([command, &exit_code] { exit_code = run_fit(*command); });
}

}  // namespace culet
