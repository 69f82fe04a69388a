// culet run JOB.toml -o DIR: fit, render and compare in one go, with one report.

#include <fmt/format.h>

#include <memory>
#include <system_error>

#include "app/file_kinds.h"
#include "app/options.h"
#include "app/terminal.h"
#include "compare/compare.h"
#include "compare/rendered_photo.h"
#include "compare/report.h"
#include "fit/fit.h"
#include "fit/mending.h"
#include "render/exposure.h"
#include "render/image_io.h"
#include "render/render.h"
#include "render/scene_io.h"
#include "stone/errors.h"
#include "stone/output_file.h"
#include "stone/stone_io.h"
#include "stone/toml_file.h"

namespace culet {

namespace {

namespace fs = std::filesystem;

struct RunOptions {
    CommonOptions common;
    std::string job, out;
};

struct Job {
    std::string name;
    fs::path stone, scene, photo, mask;
    bool simulated = false, start = false;
};

Job read_job(const fs::path& file, const std::vector<std::string>& overrides) {
    const TomlTable root = read_toml(file, overrides);
    root.refuse_unknown({"name", "fit", "render", "compare"});
    Job job;
    job.name = root.text("name").value_or(file.stem().string());
    const auto fit = root.table("fit");
    if (!fit) root.fail("", "a job needs a [fit] table with stone = \"stone.toml\"");
    fit->refuse_unknown({"stone"});
    if (!fit->has("stone")) fit->fail("", "[fit] needs stone = \"stone.toml\"");
    job.stone = *fit->path("stone");
    const auto render = root.table("render");
    if (!render) root.fail("", "a job needs a [render] table with scene = \"scene.toml\"");
    render->refuse_unknown({"scene"});
    if (!render->has("scene")) render->fail("", "[render] needs scene = \"scene.toml\"");
    job.scene = *render->path("scene");
    if (const auto compare = root.table("compare")) {
        compare->refuse_unknown({"photo", "mask", "simulated", "start"});
        if (const auto photo = compare->path("photo")) job.photo = *photo;
        if (const auto mask = compare->path("mask")) job.mask = *mask;
        job.simulated = compare->boolean("simulated").value_or(false);
        job.start = compare->boolean("start").value_or(false);
    }
    return job;
}

int run_job(const RunOptions& options) {
    const bool quiet = options.common.quiet;
    require_kind(options.job, {FileKind::job}, "culet run", options.common.set);
    const Job job = read_job(options.job, options.common.set);

    // Everything that can be wrong with the inputs is found before the first output is written.
    StoneFile file = read_stone(job.stone);
    require_material(file, job.stone);
    if (file.density_g_cm3) file.stone.material.density_g_cm3 = file.density_g_cm3;
    const auto written = read_readings(job.stone);
    const Mended mesh = mended(file.stone, written);
    file.stone = mesh.stone;
    std::vector<std::string> notes = mesh.notes;
    const auto readings = bind_readings(written, file.stone, &notes);
    const FitOptions fit_options = read_fit_options(job.stone);
    Scene scene = read_scene(job.scene, {}, &file.stone);
    scene.settings.threads = options.common.threads;
    scene.settings.seed = options.common.seed;
    if (!scene.names_tolerance) scene.settings.allowed_ns = k_usual_allowance_ns;
    Photo photo;
    CompareOptions compare_options;
    if (!job.photo.empty()) {
        photo = read_photo(job.photo);
        if (!job.mask.empty())
            compare_options.mask = read_mask(job.mask, photo.width, photo.height);
        compare_options.simulated = job.simulated;
        compare_options.seed = options.common.seed;
    }
    const fs::path folder = options.out;
    std::error_code problem;
    if (fs::exists(folder, problem) && !fs::is_directory(folder, problem)) {
        throw InputError(folder, "is a file: -o names the folder for the results");
    }

    fs::create_directories(folder, problem);
    if (problem) throw InputError(folder, fmt::format("cannot be made: {}", problem.message()));
    require_writable(folder / "report.html");

    FitResult fit = fit_stone(file.stone, readings, fit_options, progress_line("fitting", quiet));
    fit.notes.insert(fit.notes.begin(), notes.begin(), notes.end());
    say(fmt::format("fit: {}: {}", name_of(fit.status), fit.message), quiet);

    scene.stone.solid = fit.solid;
    for (const std::string& note : scene.notes) say(note, quiet);
    const RenderResult rendered = render(scene, progress_line("rendering", quiet));
    for (const std::string& note : rendered.stats.notes) say(note, quiet);
    std::optional<RenderResult> started;
    if (job.start) {
        Scene before = scene;
        before.stone.solid = file.stone.solid;
        started = render(before, progress_line("rendering the starting mesh", quiet));
    }
    say(fmt::format("render: {} x {} pixels in {:.1f} s, error bound {:.2g} of the mean",
                    rendered.picture.width, rendered.picture.height,
                    rendered.stats.seconds_setup + rendered.stats.seconds_shade,
                    rendered.stats.error_bound),
        quiet);

    std::optional<Comparison> comparison;
    if (!job.photo.empty()) {
        comparison = compare(photo, photo_of(rendered.picture), compare_options,
                             progress_line("comparing", quiet));
        say(fmt::format("compare: {}: {}", name_of(comparison->verdict), comparison->reason),
            quiet);
    }

    const std::string fit_text = fit_report(fit), stats_text = stats_json(rendered.stats);
    write_solid(fit.solid, folder / "fitted.obj");
    write_text(folder / "fit.json", fit_text);
    write_picture(rendered.picture, folder / "render.exr");
    // For people to look at: the linear values are in the EXR.
    PngLook look;
    look.exposure = exposure_for_stone(rendered.picture);
    write_picture(rendered.picture, folder / "render.png", look);
    write_text(folder / "stats.json", stats_text);
    if (started) write_picture(started->picture, folder / "start.png", look);

    Report report;
    report.title = job.name;
    report.version = CULET_VERSION;
    report.command = fmt::format("culet run {} -o {}", options.job, options.out);
    report.files = {
        {"job", options.job}, {"stone", job.stone.string()}, {"scene", job.scene.string()}};
    report.fit_json = fit_text;
    report.fitted = fit.solid;
    report.length_unit = name_of(file.stone.unit);
    report.stats_json = stats_text;
    report.settings = read_text(job.scene);
    if (job.start) {
        report.starting = file.stone.solid;
        report.starting_render = photo_of(started->picture);
        report.fitted_render = photo_of(rendered.picture);
    }
    if (comparison) {
        report.files.push_back(
            {job.simulated ? "simulated photograph" : "photograph", job.photo.string()});
        report.scores_json =
            scores_json(*comparison, {job.photo.string(), "render.exr", job.mask.string()});
        write_text(folder / "scores.json", report.scores_json);
        report.comparison = std::move(comparison);
    }
    write_report(report, folder / "report.html");
    fmt::print("{}\n", (folder / "report.html").string());

    const bool trusted = fit.usable() && (!report.comparison || report.comparison->usable());
    return trusted ? exit_good : exit_untrusted;
}

}  // namespace

void add_command_run(CLI::App& program, int& exit_code) {
    auto options = std::make_shared<RunOptions>();
    CLI::App* command =
        program.add_subcommand("run", "fit, render and compare in one go, with one report");
    command->add_option("job", options->job, "job file (TOML)")->required()->type_name("JOB.toml");
    command->add_option("-o,--output", options->out, "folder for the results")
        ->required()
        ->type_name("DIR");
    add_common(*command, options->common, true);
    command->footer(
        "Examples:\n"
        "  culet run samples/real-brilliant/job.toml -o out/real-brilliant\n"
        "  culet run job.toml -o out --set compare.start=true");
    command->callback([options, &exit_code] { exit_code = run_job(*options); });
}

}  // namespace culet
