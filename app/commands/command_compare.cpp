#include <fmt/format.h>

#include <memory>

#include "app/commands/compare_options.h"
#include "app/program/file_kinds.h"
#include "app/program/report_viewer.h"
#include "app/program/terminal.h"
#include "compare/calibration/picture_comparison.h"
#include "compare/calibration/scene_comparison.h"
#include "compare/calibration/several.h"
#include "compare/report/report.h"
#include "compare/report/scores_json.h"
#include "compare/report/several_page.h"
#include "refine/fit_uncertainty.h"
#include "render/scene/scene_io.h"
#include "stone/solid_input.h"
#include "stone/text/errors.h"
#include "stone/text/output_file.h"

namespace culet {

namespace {

namespace fs = std::filesystem;

/// Removed again if nothing was written to it.
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
        if (made_) fs::remove(folder_, ignored);  // fails, as intended, if the folder is not empty
    }
    OutputFolder(const OutputFolder&) = delete;
    OutputFolder& operator=(const OutputFolder&) = delete;

private:
    fs::path folder_;
    bool made_ = false;
};

CompareOptions options_of(const CompareArguments& a) {
    CompareOptions options;
    options.simulated = a.simulated;
    options.seed = a.common.seed;
    options.threads = a.common.threads;
    return options;
}

struct Compared {
    Comparison comparison;
    std::optional<CalibratedVerdict> calibrated;
    std::string json;
    Report report;
};

Report report_of(const CompareArguments& a, const std::string& photo, const Comparison& comparison,
                 const std::string& json, const std::string& version) {
    Report report;
    report.title = fmt::format("{} against {}", fs::path(photo).filename().string(),
                               fs::path(a.against()).filename().string());
    report.version = version;
    report.command = a.given;
    report.files = {{a.simulated ? "simulated photograph" : "photograph", photo},
                    {a.against_scene() ? "scene" : "render", a.against()}};
    if (!a.mask.empty()) report.files.push_back({"mask", a.mask});
    for (const std::string& mask : a.ignored) report.files.push_back({"left out", mask});
    report.comparison = comparison;
    report.scores_json = json;
    return report;
}

Compared compare_with_render(const CompareArguments& a, const std::string& version) {
    const Photo photo = read_photo(a.pictures.front(), a.mask, a.ignored),
                render = read_photo(a.against());
    Compared result;
    result.comparison =
        compare(photo, render, options_of(a), progress_line("comparing", a.common.quiet));
    result.json = scores_json(result.comparison, {a.pictures.front(), a.against(), a.mask});
    result.report = report_of(a, a.pictures.front(), result.comparison, result.json, version);
    return result;
}

// Read once for all photographs.
struct SceneExtras {
    std::optional<Solid> start;
    std::optional<StoneUncertainty> uncertainty;
};

Compared compare_with_scene(const CompareArguments& a, const std::string& photo_file,
                            const Scene& scene, const SceneExtras& extras,
                            const std::string& version) {
    const Photo photo = read_photo(photo_file, a.mask, a.ignored);
    SceneCompareOptions options;
    options.compare = options_of(a);
    options.find_pose = !a.keep_pose;
    options.calibrate = a.calibrate;
    options.budget_seconds = a.budget;
    options.draws = a.draws;
    options.cache = a.cache.empty() ? fs::path(a.folder) / "cache" : fs::path(a.cache);
    options.start = extras.start;
    options.uncertainty = extras.uncertainty;
    SceneComparison compared = culet::compare_with_scene(
        photo, scene, options,
        progress_line(a.calibrate ? "comparing and calibrating" : "comparing", a.common.quiet));
    Compared result;
    result.comparison = std::move(compared.comparison);
    CompareSources sources{photo_file, a.against(), a.mask};
    sources.pose = compared.pose ? pose_json(*compared.pose) : "";
    result.calibrated = std::move(compared.calibrated);
    result.json = scores_json(result.comparison, sources, result.calibrated);
    result.report = report_of(a, photo_file, result.comparison, result.json, version);
    result.report.calibrated = result.calibrated;
    result.report.stats_json = stats_json(compared.stats);
    result.report.settings = read_text(a.against());
    ViewSource source;
    source.file = a.against();
    source.overrides = a.common.set;
    source.before = a.start;
    result.report.viewer_html = viewer_for_report(source, result.report.title);
    if (compared.pose) {
        result.report.pose_overlay_png = pose_overlay(photo, scene.stone.solid, *compared.pose);
        result.report.pose_used = compared.pose_used;
    }
    return result;
}

void say_result(const CompareArguments& a, const Comparison& comparison, bool calibrated) {
    // A calibration's reason is a complete sentence.
    say(calibrated ? comparison.reason + "."
                   : fmt::format("{}: {}", verdict_words(comparison.verdict), comparison.reason),
        a.common.quiet);
    if (!comparison.pose_note.empty()) say("pose: " + comparison.pose_note, a.common.quiet);
    if (comparison.within)
        say(fmt::format("{:.0f} % of the pixels agree with the readings within one sigma, {:.0f} % "
                        "within two (68 and 95 % if all else is right)",
                        100 * comparison.within->within_one, 100 * comparison.within->within_two),
            a.common.quiet);
    if (!a.common.verbose) return;
    for (const Score& score : comparison.scores) {
        say(fmt::format("  {:14} {:>9}   chance {:.3f} ± {:.3f}", score.key,
                        score.value ? fmt::format("{:.4f}", *score.value) : "none", score.null_mean,
                        score.null_sd),
            a.common.quiet);
    }
    for (const std::string& warning : comparison.registration.warnings) {
        say("  " + warning, a.common.quiet);
    }
    for (const std::string& note : comparison.notes) say("  " + note, a.common.quiet);
}

void check_asked(const CompareArguments& a) {
    if (a.pictures.size() < 2) {
        throw InputError(
            "compare takes a photograph and a render or a scene file: "
            "culet compare PHOTO RENDER -o DIR");
    }
    require_photographs_first(a.pictures, a.simulated, a.common.set);
    if (!a.against_scene()) {
        if (a.photographs() > 1) {
            throw InputError(
                fmt::format("several photographs have several poses, and {} is one picture: give "
                            "the scene file "
                            "(.toml) as the last of them",
                            a.against()));
        }
        if (a.calibrate) {
            throw InputError(
                "--calibrate draws the stone anew: give the scene file (.toml) instead "
                "of a render");
        }
    }
    if (!a.uncertainty.empty() && !a.against_scene()) {
        throw InputError(
            "--uncertainty draws stones anew: give the scene file (.toml) instead of a render, or "
            "a render with its layers (culet render --uncertainty)");
    }
    if (!a.mask.empty() && a.photographs() > 1) {
        throw InputError("--mask belongs to one photograph: compare them one by one");
    }
}

int compare_several(const CompareArguments& a, const Scene& scene, const SceneExtras& extras,
                    const std::string& version, const fs::path& page_file) {
    std::vector<PhotographRow> rows;
    std::vector<std::string> pages;
    for (std::size_t i = 0; i < a.photographs(); ++i) {
        const std::string& file = a.pictures[i];
        Compared one = compare_with_scene(a, file, scene, extras, version);
        say(file, a.common.quiet);
        say_result(a, one.comparison, one.calibrated.has_value());
        pages.push_back(report_page(one.report));
        rows.push_back({fs::path(file).filename().string(),
                        fmt::format("photograph-{}.html", i + 1), one.json,
                        std::move(one.comparison), std::move(one.calibrated)});
    }
    const SeveralPhotographs several = together(rows);
    const std::string json = several_json(several, rows);
    const std::string page =
        several_page(several, rows, fs::path(a.against()).stem().string() + " and its photographs",
                     version, a.given);
    if (!a.json.empty()) write_text(a.json, json);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        write_text(fs::path(a.folder) / rows[i].page, pages[i]);
    }
    write_text(page_file, page);
    say(fmt::format("{}: {}", verdict_words(several.verdict), several.reason), a.common.quiet);
    say(fmt::format("report: {}; next: open it in a browser", page_file.string()), a.common.quiet);
    return several.verdict == Verdict::refused ? exit_untrusted : exit_good;
}

int run_compare(const CompareArguments& a, const std::string& version) {
    check_asked(a);
    std::optional<Scene> scene;
    SceneExtras extras;
    if (a.against_scene()) {
        scene = read_scene(a.against(), a.common.set);
        for (const std::string& note : scene->notes) say(note, a.common.quiet);
        scene->settings.threads = a.common.threads;
        if (!a.start.empty()) extras.start = load_solid(a.start).solid;
        if (!a.uncertainty.empty())
            extras.uncertainty = uncertainty_in(a.uncertainty, scene->stone);
    }
    if (!a.json.empty()) require_writable(a.json);
    const OutputFolder folder(a.folder);
    const fs::path page_file = fs::path(a.folder) / "report.html";
    require_writable(page_file);

    if (a.photographs() > 1) return compare_several(a, *scene, extras, version, page_file);
    const Compared one = scene ? compare_with_scene(a, a.pictures.front(), *scene, extras, version)
                               : compare_with_render(a, version);
    const std::string page = report_page(one.report);
    if (!a.json.empty()) write_text(a.json, one.json);
    write_text(page_file, page);
    say_result(a, one.comparison, one.calibrated.has_value());
    say(fmt::format("report: {}; next: open it in a browser", page_file.string()), a.common.quiet);
    return one.comparison.usable() ? exit_good : exit_untrusted;
}

}  // namespace

void add_command_compare(CLI::App& program, int& exit_code) {
    auto arguments = std::make_shared<CompareArguments>();
    CLI::App* command = program.add_subcommand(
        "compare",
        "registers a render with a photograph by the stone's outline, or finds the pose of a "
        "scene's stone in it, scores it, and writes DIR/report.html");
    add_compare_options(*command, *arguments);
    command->footer(
        "Examples:\n"
        "  culet compare photo.jpg render.exr -o report\n"
        "  culet compare photo.tif render.exr -o report --mask stone.png --json scores.json\n"
        "  culet compare photo.jpg scene.toml -o report --calibrate\n"
        "  culet compare photo.jpg scene.toml -o report --uncertainty fit.json\n"
        "  culet compare face-up.tif tilted.tif scene.toml -o report --calibrate --budget 120\n"
        "Exit codes: 0 compared, whatever the verdict (match, partial, no_evidence); 1 refused: "
        "the outlines do not fit; 2 could not be done.");
    command->callback([&program, command, arguments, &exit_code] {
        arguments->given = as_given(*command);
        std::string version = program.version();
        if (version.starts_with("culet ")) version.erase(0, 6);
        exit_code = run_compare(*arguments, version);
    });
}

}  // namespace culet
