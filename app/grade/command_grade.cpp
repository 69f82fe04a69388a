// culet grade STONE|CUT...: what the cut does with light.

#include "app/grade/command_grade.h"

#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/grade/graded.h"
#include "app/input/study_scene.h"
#include "app/program/options.h"
#include "app/program/terminal.h"
#include "compare/study/graded_design.h"
#include "page/grade_page.h"
#include "page/quantity.h"
#include "render/grade/grade_figures.h"
#include "stone/numbers/units.h"
#include "stone/progress/check_stop.h"
#include "stone/text/errors.h"
#include "stone/text/output_file.h"

namespace culet {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t k_most_designs = 8;

struct GradeCommand {
    CommonOptions common;
    std::vector<std::string> files;
    std::string out, json, tilts = "-30:30:2";
    GradeChoices choices;
    std::optional<double> index;
    std::string report;
    double head_deg = 10;
    int draws = 30;
    int size = 320;
    bool page_alone = false;  ///< no summary
    std::string optimized_json;
};

GradeOptions options_of(const GradeCommand& command) {
    GradeOptions options = grade_options(command.head_deg, command.tilts);
    options.seed = command.common.seed;
    options.threads = command.common.threads;
    return options;
}

// One object; several designs are in the list "designs".
std::string json_of(const std::vector<Graded>& all) {
    if (all.size() == 1) return all.front().json;
    nlohmann::ordered_json json{{"schema", 1}, {"designs", nlohmann::ordered_json::array()}};
    for (const Graded& one : all)
        json["designs"].push_back(nlohmann::ordered_json::parse(one.json));
    return json.dump(1) + "\n";
}

void print_summary(const Graded& graded) {
    const auto line = [&](const GradeFigure& figure) {
        const auto sigma = graded.sigma.figures.find(figure.name);
        return sigma == graded.sigma.figures.end()
                   ? fmt::format("  {:<42}{:>9.3f}", figure.words, figure.value)
                   : fmt::format("  {:<42}{:>9}", figure.words,
                                 plain_signs(quantity(figure.value, sigma->second, "")));
    };
    std::string text = fmt::format("{}, index {:.4f}\n", graded.input.name, graded.grade.index.n);
    for (const GradeFigure& figure : figures_of(graded.grade)) text += line(figure) + "\n";
    text += fmt::format(
        "  {}, {} (heads {})\n", counted_of_eight(graded.grade.hearts.count, "heart"),
        counted_of_eight(graded.grade.arrows.count, "arrow"), graded.grade.arrows.list.size());
    for (std::size_t i = 0; i < std::min<std::size_t>(graded.costs.size(), 3); ++i) {
        const FacetCost& cost = graded.costs[i];
        text +=
            fmt::format("  {} costs {:.2f} % of light return ({:+.2f} degrees off its tier)\n",
                        graded.input.stone.solid.facets[static_cast<std::size_t>(cost.facet)].name,
                        cost.cost, degrees(cost.off));
    }
    print_lines(text);
}

void write_page(const GradeCommand& command, const std::vector<Graded>& all) {
    const fs::path folder = command.out;
    GradeView view;
    view.version = CULET_VERSION;
    view.command = command.choices.given;
    view.optimized_json = command.optimized_json;
    std::size_t number = 0;
    for (const Graded& one : all) {
        const GradeInput& input = one.input;
        view.designs.push_back(graded_design(
            {input.stone, input.has_material, one.grade, one.json}, folder,
            fmt::format("{}", ++number), {command.head_deg, command.size, command.common.threads}));
    }
    write_text(folder / "report.html", grade_page(view));
    write_text(folder / "grade.json", json_of(all));
    say(fmt::format("page: {}; next: open it in a browser", (folder / "report.html").string()),
        command.common.quiet);
}

int run_grade(GradeCommand command) {
    // Designs of many facets take a while to read.
    const Progress goes_on = [](double) { return !interrupted(); };
    const StopScope stops(goes_on);
    const GradeOptions options = options_of(command);
    command.choices.index = command.index;
    command.choices.report = command.report;
    command.choices.overrides = command.common.set;
    command.choices.quiet = command.common.quiet;
    if (command.files.size() > k_most_designs)
        throw InputError(fmt::format("at most {} designs side by side", k_most_designs));
    if (!command.report.empty() && command.files.size() > 1)
        throw InputError("--report is of one stone: grade it alone");
    std::vector<GradeInput> inputs;
    for (const std::string& file : command.files) {
        for (GradeInput& input : load_for_grade(file, command.choices, !command.out.empty()))
            inputs.push_back(std::move(input));
    }
    if (!command.out.empty()) {
        const fs::path folder = study_folder(command.out);
        require_writable(folder / "report.html");
    }
    require_writable(command.json);
    std::vector<Graded> all;
    for (GradeInput& input : inputs) {
        for (const std::string& note : input.notes)
            say(fmt::format("{}: {}", input.name, note), !command.common.verbose);
        const bool as_drawn = input.as_drawn;
        try {
            all.push_back(
                grade_input(std::move(input), options, command.draws, command.common.quiet));
        } catch (const InputError& error) {
            // Facets drawn by hand need not be planar, and the user asked for the fitted stone.
            if (!as_drawn) throw;
            say(fmt::format("the mesh as drawn is left out: {}", error.what()),
                command.common.quiet);
        }
    }
    if (!command.out.empty()) write_page(command, all);
    if (!command.json.empty()) write_text(command.json, json_of(all));
    bool trusted = true;
    for (const Graded& one : all) {
        if (command.json != "-" && !command.page_alone) print_summary(one);
        trusted = trusted && one.input.trusted;
        if (!one.input.trusted) {
            say(fmt::format("{}: the fit should not be trusted, nor should this grade: {}",
                            one.input.file, one.input.notes.back()),
                command.common.quiet);
        }
    }
    return trusted ? exit_good : exit_untrusted;
}

}  // namespace

void write_grade_page(const std::vector<std::string>& files, const GradeChoices& choices,
                      const fs::path& folder, const CommonOptions& common,
                      const std::string& optimized_json) {
    GradeCommand command;
    command.common = common;
    command.files = files;
    command.out = folder.string();
    command.choices = choices;
    command.index = choices.index;
    command.page_alone = true;
    command.optimized_json = optimized_json;
    run_grade(command);
}

void add_command_grade(CLI::App& program, int& exit_code) {
    auto command = std::make_shared<GradeCommand>();
    CLI::App* grade = program.add_subcommand(
        "grade",
        "what a cut does with light: light return, tilt curves, ASET, hearts and arrows, fire");
    grade
        ->add_option("stone", command->files,
                     "stones, meshes, cut designs or names of standard cuts, side by side")
        ->required()
        ->type_name("STONE|CUT...");
    grade->add_option("-o,--output", command->out, "folder for the page, pictures and grade.json")
        ->type_name("DIR");
    grade->add_option("--json", command->json, "all figures (- is stdout)")->type_name("FILE");
    grade
        ->add_option("--material", command->choices.material,
                     "material by name or file (designs: their own index without it)")
        ->type_name("NAME");
    grade->add_option("--index", command->index, "refractive index, instead of the material's")
        ->type_name("N");
    grade->add_option("--head", command->head_deg, "half angle of the viewer's head, degrees (10)")
        ->type_name("DEG");
    grade
        ->add_option("--tilts", command->tilts, "tilts, degrees: FROM:TO:STEP or a list (-30:30:2)")
        ->type_name("TILTS");
    grade
        ->add_option("--report", command->report,
                     "report of the stone's fit: every figure with its sigma")
        ->type_name("FIT.json");
    grade->add_option("--draws", command->draws, "random stones for sigmas (30)")
        ->check(CLI::Range(2, 100000))
        ->type_name("N");
    grade->add_option("--size", command->size, "side of the page's pictures, pixels (320)")
        ->check(CLI::Range(32, 2048))
        ->type_name("N");
    add_common(*grade, command->common, true);
    grade->footer(
        "Examples:\n"
        "  culet grade design.asc --material diamond -o out/grade\n"
        "  culet grade design.asc --index 1.54 --tilts -30:30:1 --json grade.json\n"
        "  culet grade old.asc new.asc --material quartz -o out/compared\n"
        "  culet grade stone.toml -o out/grade");
    grade->callback([grade, command, &exit_code] {
        command->choices.given = as_given(*grade);
        exit_code = run_grade(*command);
    });
}

}  // namespace culet
