// culet study SCENE.toml|STONE.toml -o DIR: what accuracy costs in time.

#include <fmt/format.h>

#include <memory>
#include <optional>
#include <system_error>

#include "app/input/study_scene.h"
#include "app/program/file_kinds.h"
#include "app/program/options.h"
#include "app/program/terminal.h"
#include "fit/study/study.h"
#include "page/study_page.h"
#include "stone/stone_io.h"
#include "stone/text/errors.h"
#include "stone/text/output_file.h"
#include "stone/text/toml_file.h"

namespace culet {

namespace fs = std::filesystem;

namespace {

struct StudyCommand {
    CommonOptions common;
    std::string input, out, json, only;
    int draws = 8, size = 0, runs = 5;
    std::optional<double> budget;
    const CLI::Option *draws_given = nullptr, *only_given = nullptr, *size_given = nullptr,
                      *runs_given = nullptr;
};

void refuse(const StudyCommand& command, const CLI::Option* given, const char* kind) {
    if (given->count() == 0) return;
    throw InputError(command.input,
                     fmt::format("{} is for studies of {}", given->get_name(), kind));
}

void refuse_outlines(const std::vector<Reading>& readings) {
    for (const Reading& reading : readings) {
        if (reading.kind != ReadingKind::silhouette && reading.kind != ReadingKind::line) continue;
        throw InputError(reading.file, reading.line,
                         "a study simulates readings, which it cannot do for outlines and lines: "
                         "take the [[silhouette]] and [[line]] tables out; hold_out tells how well "
                         "outlines fit");
    }
}

void write_study(const StudyCommand& command, const Study& study, const std::string& json,
                 const std::string& title, const StudyOptions& options, const fs::path& folder) {
    write_text(folder / "study.json", json);
    write_text(folder / "time.csv", study_time_csv(study));
    write_text(folder / "limit.csv", study_limit_csv(study));
    write_text(folder / "time.svg", study_time_chart(json));
    write_text(folder / "limit.svg", study_limit_chart(json));
    write_text(folder / "report.html",
               study_page({json, title, CULET_VERSION,
                           fmt::format("culet study {} -o {} --seed {} --draws {} --budget {:g}",
                                       command.input, command.out, options.seed, options.draws,
                                       options.budget_seconds)}));
}

int run_study(const StudyCommand& command) {
    require_kind(command.input, {FileKind::scene, FileKind::stone}, "culet study",
                 command.common.set);
    const TomlTable root = read_toml(command.input, command.common.set);
    const bool is_stone = root.kind("stone") == TomlTable::Kind::table;
    if (!is_stone && (root.has("stone") || root.has("camera") || root.has("mesh"))) {
        refuse(command, command.draws_given, "stones");
        refuse(command, command.only_given, "stones");
        return study_scene_file({command.common, command.input, command.out, command.json,
                                 command.size, command.runs, command.budget.value_or(120)});
    }
    refuse(command, command.size_given, "scenes");
    refuse(command, command.runs_given, "scenes");
    StoneFile file = read_stone(command.input, command.common.set);
    for (const std::string& detail : file.details) say(detail, !command.common.verbose);
    FitInput input = fit_input(file.stone, read_readings(command.input, command.common.set));
    input.notes.insert(input.notes.begin(), file.notes.begin(), file.notes.end());
    for (const std::string& note : input.notes) say(note, command.common.quiet);
    if (input.readings.empty()) {
        throw InputError(command.input, "has no readings: there is nothing to study");
    }
    refuse_outlines(input.readings);
    StudyOptions options;
    options.fit = read_fit_options(command.input, command.common.set);
    options.seed = command.common.seed;
    options.draws = command.draws;
    options.budget_seconds = command.budget.value_or(60);
    options.times = command.only != "limit";
    options.limits = command.only != "time";

    const fs::path folder = study_folder(command.out);
    require_writable(folder / "study.json");
    require_writable(command.json);

    const Study study = [&] {
        try {
            return study_fit(input.stone, input.readings, options,
                             progress_line("study", command.common.quiet));
        } catch (const InputError& error) {
            throw InputError(file.mesh_file, error.what());
        }
    }();
    const std::string json = study_json(study);
    write_study(command, study, json, file.stone.name, options, folder);
    if (!command.json.empty()) write_text(command.json, json);
    if (command.json != "-") print_lines(study_table(json));
    say(fmt::format("{}: {}", name_of(study.status), study.message), command.common.quiet);
    if (!study.limit_message.empty()) {
        say(fmt::format("limit: {}", study.limit_message), command.common.quiet);
    }
    if (!study.left_out.empty()) {
        say(fmt::format("{} rows were not reached within {:g} s; raise --budget, or lower --draws",
                        study.left_out.size(), options.budget_seconds),
            command.common.quiet);
    }
    say(fmt::format("pages: {}; next: open it in a browser", (folder / "report.html").string()),
        command.common.quiet);
    return study.usable() ? exit_good : exit_untrusted;
}

}  // namespace

fs::path study_folder(const fs::path& folder) {
    std::error_code problem;
    if (fs::exists(folder, problem) && !fs::is_directory(folder, problem)) {
        throw InputError(folder, "is a file: -o names the folder for the results");
    }
    fs::create_directories(folder, problem);
    if (problem) throw InputError(folder, fmt::format("cannot be made: {}", problem.message()));
    return folder;
}

void add_command_study(CLI::App& program, int& exit_code) {
    auto command = std::make_shared<StudyCommand>();
    CLI::App* study = program.add_subcommand(
        "study",
        "what accuracy costs in time: of a scene's pictures; of a stone's fit, and how near it "
        "comes to the theoretical limit");
    study->add_option("file", command->input, "scene, or stone file with its readings")
        ->required()
        ->type_name("SCENE.toml|STONE.toml");
    study->add_option("-o,--output", command->out, "folder for study.json, tables, charts, page")
        ->required()
        ->type_name("DIR");
    study->add_option("--json", command->json, "study.json here too (- is stdout)")
        ->type_name("FILE");
    study
        ->add_option("--budget", command->budget,
                     "seconds of processor time (scenes 120, stones 60; 0: no limit)")
        ->check(CLI::Range(0.0, 1e9))
        ->type_name("S");
    command->size_given =
        study
            ->add_option("--size", command->size,
                         "scenes: longer side of the pictures, pixels (64 to 256, as the budget "
                         "allows; never more than the scene's)")
            ->check(CLI::Range(16, 8192))
            ->type_name("N");
    command->runs_given =
        study->add_option("--runs", command->runs, "scenes: how often drawings are timed (5)")
            ->check(CLI::Range(1, 1000))
            ->type_name("N");
    command->draws_given =
        study->add_option("--draws", command->draws, "stones: how often readings are simulated (8)")
            ->check(CLI::Range(1, 100000))
            ->type_name("N");
    command->only_given =
        study->add_option("--only", command->only, "stones: only time or only limit")
            ->check(CLI::IsMember({"time", "limit"}))
            ->type_name("HALF");
    add_common(*study, command->common, true);
    study->footer(
        "Examples:\n"
        "  culet study samples/studies/diamond.toml -o out/diamond --budget 600\n"
        "  culet study samples/dravite-step/stone.toml -o out/study\n"
        "  culet study stone.toml -o out/study --draws 50 --budget 600 --seed 7");
    study->callback([command, &exit_code] { exit_code = run_study(*command); });
}

}  // namespace culet
