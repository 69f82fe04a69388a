// culet refine STONE.toml PHOTO... SCENE.toml -o REFINED.obj [--report FIT.json]

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <set>

#include "app/program/file_kinds.h"
#include "app/program/options.h"
#include "app/program/terminal.h"
#include "fit/findings/summary.h"
#include "refine/refine.h"
#include "render/scene/scene_io.h"
#include "stone/numbers/units.h"
#include "stone/numbers/upper_median.h"
#include "stone/stone_io.h"
#include "stone/text/errors.h"
#include "stone/text/output_file.h"

namespace culet {

namespace {

namespace fs = std::filesystem;

struct RefineArguments {
    CommonOptions common;
    std::vector<std::string> files;  ///< the stone, its photographs, the scene
    std::vector<std::string> masks;
    std::string output, report;
    bool keep_pose = false;
};

std::vector<RefinePhotograph> photographs_of(const RefineArguments& a) {
    const std::size_t count = a.files.size() - 2;
    if (!a.masks.empty() && a.masks.size() != count) {
        throw InputError(
            fmt::format("--mask is given {} times for {} photographs: give one for "
                        "each, in their order",
                        a.masks.size(), count));
    }
    std::vector<RefinePhotograph> photographs;
    std::set<std::string> names;
    for (std::size_t i = 1; i + 1 < a.files.size(); ++i) {
        std::string name = fs::path(a.files[i]).filename().string();
        // Photographs of the same name, from two folders.
        while (!names.insert(name).second) name += "'";
        RefinePhotograph& photograph = photographs.emplace_back();
        photograph.name = name;
        photograph.photo = read_photo(a.files[i], a.masks.empty() ? "" : a.masks[i - 1]);
        say_notes(a.files[i], photograph.photo.notes, a.common.quiet);
    }
    return photographs;
}

double usual_sigma_deg(const FitResult& fit) {
    std::vector<double> sigmas;
    for (const FittedFacet& facet : fit.facets) {
        if (facet.area > 0 && std::isfinite(facet.sigma_inclination)) {
            sigmas.push_back(degrees(facet.sigma_inclination));
        }
    }
    return sigmas.empty() ? 0 : upper_median(sigmas);
}

int run_refine(const RefineArguments& a) {
    if (a.files.size() < 3) {
        throw InputError(
            "refine takes a stone, photographs of it and the scene of their light: culet refine "
            "STONE.toml PHOTO... SCENE.toml -o REFINED.obj");
    }
    require_kind(a.files.front(), {FileKind::stone}, "culet refine");
    require_kind(a.files.back(), {FileKind::scene}, "culet refine");
    require_solid_name(a.output);
    require_writable(a.output);
    require_writable(a.report);
    StoneFile file = read_stone(a.files.front());
    require_material(file, a.files.front());
    FitInput input = fit_input(file.stone, read_readings(a.files.front()));
    input.notes.insert(input.notes.begin(), file.notes.begin(), file.notes.end());
    RefineOptions options;
    options.fit = read_fit_options(a.files.front());
    options.find_pose = !a.keep_pose;
    options.threads = a.common.threads;
    Scene scene = read_scene(a.files.back(), {}, &input.stone);
    scene.settings.threads = a.common.threads;
    scene.settings.seed = a.common.seed;
    const RefineResult result =
        refine(input, photographs_of(a), scene, options, progress_line("refining", a.common.quiet));
    say_notes(a.output, write_solid(result.after.solid, a.output), a.common.quiet);
    if (!a.report.empty()) write_text(a.report, fit_report(result.after));
    std::string prefix = fmt::format("{}: ", name_of(result.after.status));
    for (const std::string& sentence : fit_summary(result.after)) {
        say(prefix + sentence, a.common.quiet);
        prefix.clear();
    }
    say(fmt::format(
            "inclinations: median sigma {:.2g} degrees, by the readings alone {:.2g} degrees",
            usual_sigma_deg(result.after), usual_sigma_deg(result.before)),
        a.common.quiet);
    for (const FittedReading& reading : result.after.readings) {
        if (!reading.photograph) continue;
        for (const std::string& line : photograph_words(reading.id, *reading.photograph)) {
            say(line, a.common.quiet);
        }
    }
    say(fmt::format("next: culet render {0} --material NAME -o stone.png, or culet grade {0}",
                    a.output),
        a.common.quiet);
    return result.after.usable() ? exit_good : exit_untrusted;
}

}  // namespace

void add_command_refine(CLI::App& program, int& exit_code) {
    auto arguments = std::make_shared<RefineArguments>();
    CLI::App* command = program.add_subcommand(
        "refine", "facet angles from photographs in known light, together with the readings");
    command
        ->add_option("FILES", arguments->files,
                     "stone file with its readings, photographs of the stone, and the scene file "
                     "of their light (its stone is not used)")
        ->required()
        ->expected(1, 1000)
        ->type_name("STONE.toml PHOTO... SCENE.toml");
    command
        ->add_option("-o,--output", arguments->output,
                     "refined mesh (.obj .off .ply .stl .asc .gem .gcs)")
        ->required()
        ->type_name("REFINED");
    command
        ->add_option("--report,--json", arguments->report,
                     "report of the fit, with the photographs among its readings (- is stdout)")
        ->type_name("FIT.json");
    command
        ->add_option("--mask", arguments->masks,
                     "picture of a photograph's size, white where the stone is; one for each "
                     "photograph, in their order")
        ->type_name("MASK")
        ->allow_extra_args(false);
    command->add_flag("--keep-pose", arguments->keep_pose,
                      "the scene's camera is that of every photograph: no pose is looked for");
    add_common(*command, arguments->common, false);
    command->footer(
        "Examples:\n"
        "  culet refine stone.toml face-up.png tilted.png scene.toml -o refined.obj\n"
        "  culet refine stone.toml photo-*.png scene.toml -o refined.obj --report fit.json\n"
        "Exit codes: as culet fit: 0 converged; 1 not to be trusted; 2 could not be done.");
    command->callback([arguments, &exit_code] { exit_code = run_refine(*arguments); });
}

}  // namespace culet
