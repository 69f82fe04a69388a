// culet run JOB.toml -o DIR: fit, render and compare in one run, with one report.

#include <fmt/format.h>

#include <memory>
#include <system_error>

#include "app/commands/compare_options.h"
#include "app/commands/run_certificate.h"
#include "app/program/file_kinds.h"
#include "app/program/options.h"
#include "app/program/report_viewer.h"
#include "app/program/terminal.h"
#include "compare/calibration/picture_comparison.h"
#include "compare/photo/rendered_photo.h"
#include "compare/report/report.h"
#include "compare/report/scores_json.h"
#include "fit/fit.h"
#include "render/image/image_io.h"
#include "render/render.h"
#include "render/scene/scene_io.h"
#include "render/scene/shown_picture.h"
#include "stone/stone_io.h"
#include "stone/text/errors.h"
#include "stone/text/output_file.h"
#include "stone/text/toml_file.h"

namespace culet {

namespace {

namespace fs = std::filesystem;

struct RunOptions {
    CommonOptions common;
    std::string job, out;
};

struct Job {
    std::string name;
    fs::path stone, scene, photo, mask;  ///< empty: skip that step
    fs::path picture;                    ///< an existing render, instead of the scene
    bool simulated = false, start = false;
    CertificateJob certificate;
};

void read_compare(const TomlTable& compare, Job& job) {
    compare.refuse_unknown({"photo", "render", "mask", "simulated", "start"});
    if (const auto photo = compare.path("photo")) job.photo = *photo;
    if (const auto picture = compare.path("render")) job.picture = *picture;
    if (const auto mask = compare.path("mask")) job.mask = *mask;
    job.simulated = compare.boolean("simulated").value_or(false);
    job.start = compare.boolean("start").value_or(false) && !job.stone.empty();
    if (job.scene.empty() && job.picture.empty()) {
        compare.fail("",
                     "[compare] needs a render: add [render] with scene = \"scene.toml\", or "
                     "render = \"picture.exr\" for one that is there already");
    }
    if (!job.scene.empty() && !job.picture.empty()) {
        compare.fail("render", "the job renders a picture itself: leave out this or [render]");
    }
    if (!job.picture.empty() && job.photo.empty()) {
        compare.fail("", "[compare] needs photo = \"photo.png\" to compare the render with");
    }
}

Job read_job(const fs::path& file, const std::vector<std::string>& overrides) {
    const TomlTable root = read_toml(file, overrides);
    root.refuse_unknown({"name", "fit", "render", "compare", "certificate"});
    Job job;
    job.name = root.text("name").value_or(file.stem().string());
    if (const auto fit = root.table("fit")) {
        fit->refuse_unknown({"stone"});
        if (!fit->has("stone")) fit->fail("", "[fit] needs stone = \"stone.toml\"");
        job.stone = *fit->path("stone");
    }
    if (const auto render = root.table("render")) {
        render->refuse_unknown({"scene"});
        if (!render->has("scene")) render->fail("", "[render] needs scene = \"scene.toml\"");
        job.scene = *render->path("scene");
    }
    if (const auto compare = root.table("compare")) read_compare(*compare, job);
    if (const auto certificate = root.table("certificate")) {
        if (job.stone.empty()) certificate->fail("", "a certificate needs [fit]: add it");
        job.certificate = read_certificate(*certificate);
    }
    if (job.stone.empty() && job.scene.empty() && job.picture.empty()) {
        root.fail("",
                  "a job needs a [fit] table with stone = \"stone.toml\", a [render] table with "
                  "scene = \"scene.toml\", or both");
    }
    return job;
}

// Read and checked before any output.
struct JobInput {
    StoneFile file;
    FitInput fit;
    FitOptions fit_options;
    Scene scene;
    Photo photo, picture;
    CompareOptions compare_options;
};

JobInput read_input(const Job& job, const CommonOptions& common) {
    JobInput input;
    if (!job.stone.empty()) {
        StoneFile& file = input.file = read_stone(job.stone);
        if (!job.scene.empty()) require_material(file, job.stone);
        input.fit = fit_input(file.stone, read_readings(job.stone));
        input.fit.notes.insert(input.fit.notes.begin(), file.notes.begin(), file.notes.end());
        file.stone = input.fit.stone;
        input.fit_options = read_fit_options(job.stone);
    }
    if (!job.scene.empty()) {
        Scene& scene = input.scene =
            read_scene(job.scene, {}, job.stone.empty() ? nullptr : &input.file.stone);
        scene.settings.threads = common.threads;
        scene.settings.seed = common.seed;
        if (!scene.names_tolerance) scene.settings.allowed_ns = k_run_budget_ns;
    }
    if (!job.photo.empty()) {
        input.photo = read_photo(job.photo, job.mask);
        if (!job.picture.empty()) input.picture = read_photo(job.picture);
        input.compare_options.simulated = job.simulated;
        input.compare_options.seed = common.seed;
    }
    return input;
}

struct JobResult {
    std::optional<FitResult> fit;
    std::optional<RenderResult> rendered, started;
    std::optional<Comparison> comparison;
};

void draw(const Job& job, const JobInput& input, JobResult& made, bool quiet) {
    const Scene& scene = input.scene;
    for (const std::string& note : scene.notes) say(note, quiet);
    made.rendered = render(scene, progress_line("rendering", quiet));
    const RenderStats& stats = made.rendered->stats;
    for (const std::string& note : stats.notes) say(note, quiet);
    if (job.start) {
        Scene before = scene;
        before.stone.solid = input.file.stone.solid;
        made.started = render(before, progress_line("rendering the starting mesh", quiet));
    }
    say(fmt::format("render: {} x {} pixels in {:.1f} s, error bound {:.2g} of the mean",
                    made.rendered->picture.width, made.rendered->picture.height,
                    stats.seconds_setup + stats.seconds_shade, stats.error_bound),
        quiet);
}

JobResult make(const Job& job, JobInput& input, bool quiet) {
    JobResult made;
    if (!job.stone.empty()) {
        made.fit = fit_stone(input.fit, input.fit_options, progress_line("fitting", quiet));
        say(fmt::format("fit: {}: {}", name_of(made.fit->status), made.fit->message), quiet);
        input.scene.stone.solid = made.fit->solid;
    }
    if (!job.scene.empty()) draw(job, input, made, quiet);
    if (!job.photo.empty()) {
        made.comparison =
            compare(input.photo, made.rendered ? photo_of(made.rendered->picture) : input.picture,
                    input.compare_options, progress_line("comparing", quiet));
        say(fmt::format("compare: {}: {}", verdict_words(made.comparison->verdict),
                        made.comparison->reason),
            quiet);
    }
    return made;
}

void put_pictures(const Scene& scene, const JobResult& made, const fs::path& folder) {
    write_picture(made.rendered->picture, folder / "render.exr");
    // For viewing only: the linear values are in the EXR.
    const PngLook look = look_for(scene, made.rendered->picture);
    write_picture(made.rendered->picture, folder / "render.png", look);
    write_text(folder / "stats.json", stats_json(made.rendered->stats));
    if (made.started) write_picture(made.started->picture, folder / "start.png", look);
}

Report report_of(const RunOptions& options, const Job& job, const JobInput& input,
                 const JobResult& made) {
    Report report;
    report.title = job.name;
    report.version = CULET_VERSION;
    report.command = fmt::format("culet run {} -o {}", options.job, options.out);
    report.files = {{"job", options.job}};
    if (made.fit) {
        report.files.push_back({"stone", job.stone.string()});
        report.certificate = "certificate.html";
        report.fit_json = fit_report(*made.fit);
        report.fitted = made.fit->solid;
        report.length_unit = name_of(input.file.stone.unit);
    }
    if (made.rendered) {
        report.files.push_back({"scene", job.scene.string()});
        report.stats_json = stats_json(made.rendered->stats);
        report.settings = read_text(job.scene);
        report.fitted_render = photo_of(made.rendered->picture);
    }
    if (made.started) {
        report.starting = input.file.stone.solid;
        report.starting_render = photo_of(made.started->picture);
    }
    if (made.comparison) {
        report.files.push_back(
            {job.simulated ? "simulated photograph" : "photograph", job.photo.string()});
        if (!made.rendered) report.files.push_back({"render", job.picture.string()});
        report.scores_json =
            scores_json(*made.comparison,
                        {job.photo.string(), made.rendered ? "render.exr" : job.picture.string(),
                         job.mask.string()});
        report.comparison = made.comparison;
    }
    return report;
}

void put_certificate(const Job& job, const JobInput& input, const JobResult& made,
                     const std::string& fit_json, const fs::path& folder, bool quiet) {
    CertificateJob certificate = job.certificate;
    Certificate& page = certificate.certificate;
    page.name = input.file.stone.name.empty() ? job.name : input.file.stone.name;
    if (input.file.has_material) page.material = input.file.stone.material.name;
    page.fit_json = fit_json;
    page.stone = made.fit->solid;
    if (made.rendered) page.picture_png = read_text(folder / "render.png");
    write_certificate(std::move(certificate), folder, quiet);
}

// Shows the stone in the job's scene, or face up without one.
std::string viewer_of(const Job& job, const JobInput& input, const JobResult& made,
                      const std::string& fit_json) {
    ViewSource source;
    source.file = job.scene.empty() ? job.stone : job.scene;
    if (source.file.empty()) return {};
    Stone fitted;
    if (made.fit) {
        fitted = input.file.stone;
        fitted.solid = made.fit->solid;
        source.stone = &fitted;
        source.catalogue = &input.file.stone.solid;
        source.fit_json = fit_json;
    }
    return viewer_for_report(source, job.name);
}

int run_job(const RunOptions& options) {
    const bool quiet = options.common.quiet;
    require_kind(options.job, {FileKind::job}, "culet run", options.common.set);
    const Job job = read_job(options.job, options.common.set);
    JobInput input = read_input(job, options.common);
    const fs::path folder = options.out;
    std::error_code problem;
    if (fs::exists(folder, problem) && !fs::is_directory(folder, problem)) {
        throw InputError(folder, "is a file: -o names the folder for the results");
    }
    fs::create_directories(folder, problem);
    if (problem) throw InputError(folder, fmt::format("cannot be made: {}", problem.message()));
    require_writable(folder / "report.html");

    const JobResult made = make(job, input, quiet);
    Report report = report_of(options, job, input, made);
    report.viewer_html = viewer_of(job, input, made, report.fit_json);
    if (made.fit) {
        write_solid(made.fit->solid, folder / "fitted.obj");
        write_text(folder / "fit.json", report.fit_json);
    }
    if (made.rendered) put_pictures(input.scene, made, folder);
    if (made.comparison) write_text(folder / "scores.json", report.scores_json);
    if (made.fit) put_certificate(job, input, made, report.fit_json, folder, quiet);
    write_report(report, folder / "report.html");
    print_lines((folder / "report.html").string());
    say(fmt::format("next: open {} in a browser", (folder / "report.html").string()), quiet);
    const bool trusted =
        (!made.fit || made.fit->usable()) && (!made.comparison || made.comparison->usable());
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
