#include <fmt/format.h>

#include <memory>

#include "app/options.h"
#include "app/terminal.h"
#include "compare/compare.h"
#include "compare/report.h"
#include "stone/errors.h"
#include "stone/output_file.h"

namespace culet {

namespace {

namespace fs = std::filesystem;

struct CompareArguments {
    CommonOptions common;
    std::string photo, render, folder, json, mask;
    bool simulated = false;
};

/// The folder for the outputs; taken away again if nothing was put into it.
class OutputFolder {
public:
    explicit OutputFolder(const fs::path& folder) : folder_(folder) {
        std::error_code error;
        if (fs::exists(folder, error) && !fs::is_directory(folder, error)) {
            throw InputError(folder, "is a file: name a folder with -o DIR");
        }
        made_ = fs::create_directories(folder, error);
        if (error) {
            throw InputError(folder, fmt::format("cannot be made: {}", error.message()));
        }
    }
    ~OutputFolder() {
        std::error_code ignored;
        if (made_) fs::remove(folder_, ignored);  // fails, as it should, when it is not empty
    }
    OutputFolder(const OutputFolder&) = delete;
    OutputFolder& operator=(const OutputFolder&) = delete;

private:
    fs::path folder_;
    bool made_ = false;
};

std::string command_line(const CompareArguments& a) {
    std::string line = fmt::format("culet compare {} {} -o {}", a.photo, a.render, a.folder);
    if (!a.json.empty()) line += " --json " + a.json;
    if (!a.mask.empty()) line += " --mask " + a.mask;
    if (a.simulated) line += " --simulated";
    return line + fmt::format(" --seed {}", a.common.seed);
}

Report report_of(const CompareArguments& a, const Comparison& comparison, const std::string& json,
                 const std::string& version) {
    Report report;
    report.title = fmt::format("{} against {}", fs::path(a.photo).filename().string(),
                               fs::path(a.render).filename().string());
    report.version = version;
    report.command = command_line(a);
    report.files = {{a.simulated ? "simulated photograph" : "photograph", a.photo},
                    {"render", a.render}};
    if (!a.mask.empty()) report.files.push_back({"mask", a.mask});
    report.comparison = comparison;
    report.scores_json = json;
    return report;
}

int run_compare(const CompareArguments& a, const std::string& version) {
    const Photo photo = read_photo(a.photo), render = read_photo(a.render);
    CompareOptions options;
    if (!a.mask.empty()) options.mask = read_mask(a.mask, photo.width, photo.height);
    options.simulated = a.simulated;
    options.seed = a.common.seed;
    options.threads = a.common.threads;
    const Comparison comparison =
        compare(photo, render, options, progress_line("comparing", a.common.quiet));
    const std::string json = scores_json(comparison, {a.photo, a.render, a.mask});
    const std::string page = report_page(report_of(a, comparison, json, version));

    const OutputFolder folder(a.folder);
    const fs::path page_file = fs::path(a.folder) / "report.html";
    if (!a.json.empty()) write_text(a.json, json);
    write_text(page_file, page);

    say(fmt::format("{}: {}", name_of(comparison.verdict), comparison.reason), a.common.quiet);
    if (a.common.verbose) {
        for (const Score& score : comparison.scores) {
            say(fmt::format("  {:14} {:>9}   chance {:.3f} ± {:.3f}", score.key,
                            score.value ? fmt::format("{:.4f}", *score.value) : "none",
                            score.null_mean, score.null_sd),
                a.common.quiet);
        }
        for (const std::string& warning : comparison.registration.warnings) {
            say("  " + warning, a.common.quiet);
        }
    }
    say(fmt::format("report: {}", page_file.string()), a.common.quiet);
    return comparison.usable() ? exit_good : exit_untrusted;
}

}  // namespace

void add_command_compare(CLI::App& program, int& exit_code) {
    auto arguments = std::make_shared<CompareArguments>();
    CLI::App* command = program.add_subcommand(
        "compare",
        "registers a render with a photograph by the stone's outline, scores it, and writes "
        "DIR/report.html");
    command->add_option("PHOTO", arguments->photo, "photograph: PNG, JPEG, TIFF, EXR or HDR")
        ->required();
    command->add_option("RENDER", arguments->render, "render; best the .exr, which is linear")
        ->required();
    command->add_option("-o,--output", arguments->folder, "folder for the report; made if missing")
        ->required()
        ->type_name("DIR");
    command->add_option("--json", arguments->json, "scores for programs; - is stdout")
        ->type_name("FILE");
    command
        ->add_option("--mask", arguments->mask,
                     "picture of the photograph's size, white where the stone is")
        ->type_name("FILE");
    command->add_flag("--simulated", arguments->simulated,
                      "the photograph was computed: say so wherever it appears");
    add_common(*command, arguments->common);
    command->footer(
        "Examples:\n"
        "  culet compare photo.jpg render.exr -o report\n"
        "  culet compare photo.tif render.exr -o report --mask stone.png --json scores.json\n"
        "Exit codes: 0 compared, whatever the verdict (match, partial, no_evidence); 1 refused: "
        "the outlines do not fit; 2 could not be done.");
    command->callback([&program, arguments, &exit_code] {
        std::string version = program.version();
        if (version.starts_with("culet ")) version.erase(0, 6);
        exit_code = run_compare(*arguments, version);
    });
}

}  // namespace culet
