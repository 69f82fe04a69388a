#include "app/batch/batch_work.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <nlohmann/json.hpp>

#include "app/grade/graded.h"
#include "compare/report/report.h"
#include "compare/study/graded_design.h"
#include "fit/findings/summary.h"
#include "fit/fit.h"
#include "render/grade/grade_figures.h"
#include "render/image/image_io.h"
#include "render/render.h"
#include "render/scene/framing.h"
#include "render/scene/light_presets.h"
#include "render/scene/shown_picture.h"
#include "render/scene/stone_scene.h"
#include "stone/file_kind.h"
#include "stone/stone_io.h"
#include "stone/text/errors.h"
#include "stone/text/output_file.h"

namespace culet {

namespace fs = std::filesystem;

namespace {

using RecordJson = nlohmann::ordered_json;

constexpr int k_picture_side = 96;

void write_record(const RecordJson& record, const fs::path& folder) {
    write_text(folder / k_job_record,
               record.dump(1, ' ', false, RecordJson::error_handler_t::replace) + "\n");
}

RecordJson record_of(const BatchJob& job, const std::string& fingerprint) {
    return {{"schema", 1},        {"name", job.name},
            {"stone", job.stone}, {"fingerprint", fingerprint},
            {"status", "failed"}, {"exit_code", exit_internal},
            {"message", ""}};
}

GradeChoices choices_of(const BatchJob& job, const BatchSettings& settings) {
    GradeChoices choices;
    choices.material = job.material.empty() ? settings.material : job.material;
    choices.index = job.index ? job.index : settings.index;
    choices.overrides = settings.set;
    choices.overrides.insert(choices.overrides.end(), job.set.begin(), job.set.end());
    choices.quiet = true;
    choices.command = "culet batch";
    return choices;
}

void add_worst_reading(const FitResult& result, RecordJson& fit) {
    const FittedReading* worst = nullptr;
    for (const FittedReading& reading : result.readings) {
        if (std::isfinite(reading.normalized) &&
            (worst == nullptr || std::abs(reading.normalized) > std::abs(worst->normalized)))
            worst = &reading;
    }
    fit["worst_normalized"] = worst == nullptr ? 0 : std::abs(worst->normalized);
    fit["worst_reading"] = worst == nullptr ? "" : worst->id;
}

RecordJson fit_figures(const FitResult& result) {
    RecordJson fit{{"facets", result.solid.facets.size()},
                   {"readings", result.readings.size()},
                   {"chi2", result.statistics.chi2},
                   {"dof", result.statistics.dof},
                   {"chi2_limit", result.statistics.chi2_limit}};
    add_worst_reading(result, fit);
    fit["suspects"] = result.findings.suspects.size();
    fit["left_out"] = result.findings.doubts.size();
    fit["planarity_max"] = result.checks.planarity_max;
    return fit;
}

RecordJson grade_row(const Graded& graded) {
    RecordJson row{
        {"material", graded.input.has_material ? graded.input.stone.material.id : std::string()},
        {"index", graded.grade.index.n}};
    for (const GradeFigure& figure : figures_of(graded.grade)) {
        row[figure.name] = figure.value;
        const auto sigma = graded.sigma.figures.find(figure.name);
        if (sigma != graded.sigma.figures.end()) row["sigma." + figure.name] = sigma->second;
    }
    row["hearts"] = graded.grade.hearts.count;
    row["arrows"] = graded.grade.arrows.count;
    return row;
}

// A small picture: in the usual light for pictures, clear, in one wavelength.
void draw_small(const GradeInput& input, double index, const fs::path& file) {
    Scene scene;
    scene.stone = input.stone;
    scene.stone.material = Material();
    scene.stone.material.index[0].n = index;
    const LightPreset& preset = *find_light_preset(k_usual_light);
    scene.lights = *light_preset(preset.name);
    scene.light_preset = preset.name;
    scene.film = preset.film;
    scene.camera.width = scene.camera.height = k_picture_side;
    frame_stone(scene.stone.solid, preset.facing, scene.camera);
    RenderSettings& render_settings = scene.settings;
    render_settings.engine = k_beam_engine;
    render_settings.check = Check::none;
    render_settings.threads = 1;
    render_settings.effects_auto = false;
    render_settings.effects.fill(false);
    const RenderResult drawn = render(scene);
    write_picture(drawn.picture, file, look_for(scene, drawn.picture));
}

struct JobInWork {
    const BatchJob& job;
    const BatchSettings& settings;
    GradeChoices choices;
    fs::path folder;
    RecordJson record;
    bool trusted = true;
};

// Nothing for a stone without readings.
std::optional<GradeInput> fit_job(JobInWork& work) {
    const fs::path file = work.job.stone;
    if (kind_of(file, work.choices.overrides) != FileKind::stone) return {};
    const std::vector<WrittenReading> readings = read_readings(file, work.choices.overrides);
    if (readings.empty()) return {};
    StoneFile stone = read_stone(file, work.choices.overrides);
    FitResult result = [&] {
        try {
            return fit_stone(fit_input(stone.stone, readings),
                             read_fit_options(file, work.choices.overrides));
        } catch (const InputError& error) {
            throw InputError(stone.mesh_file, error.what());
        }
    }();
    // The same bytes at every time and place.
    result.log.seconds = std::numeric_limits<double>::quiet_NaN();
    write_solid(result.solid, work.folder / "fitted.obj");
    const std::string report = fit_report(result);
    write_text(work.folder / "fit.json", report);
    if (work.settings.pages) {
        Report page;
        page.title = stone.stone.name.empty() ? work.job.name : stone.stone.name;
        page.version = CULET_VERSION;
        page.command = "culet batch";
        page.files = {{"stone", work.job.stone}};
        page.fit_json = report;
        page.fitted = result.solid;
        page.length_unit = name_of(result.unit);
        write_report(page, work.folder / "fit.html");
    }
    work.record["status"] = name_of(result.status);
    work.record["message"] = result.message;
    work.record["summary"] = fit_summary(result);
    work.record["fit"] = fit_figures(result);
    work.trusted = result.usable();
    GradeInput input;
    input.file = work.job.stone;
    input.name = stone.stone.name.empty() ? work.job.name : stone.stone.name;
    input.has_material = stone.has_material;
    input.notes = stone.notes;
    input.stone = stone.stone;
    take_fit(result, input);
    return input;
}

void grade_job(JobInWork& work, GradeInput input) {
    GradeOptions options = grade_options(work.settings.head_deg, work.settings.tilts);
    options.seed = work.settings.seed;
    options.threads = 1;
    const Graded graded = grade_input(std::move(input), options, work.settings.draws, true);
    write_text(work.folder / "grade.json", graded.json);
    work.record["grade"] = grade_row(graded);
    draw_small(graded.input, graded.grade.index.n, work.folder / "stone.png");
    if (!work.settings.pages) return;
    GradeView view;
    view.version = CULET_VERSION;
    view.command = "culet batch";
    view.designs.push_back(
        graded_design({graded.input.stone, graded.input.has_material, graded.grade, graded.json},
                      work.folder, "1", {work.settings.head_deg, 320, 1}));
    write_text(work.folder / "grade.html", grade_page(view));
}

void do_job(JobInWork& work) {
    std::optional<GradeInput> fitted = fit_job(work);
    if (fitted) {
        const bool has_index =
            fitted->has_material || !work.choices.material.empty() || work.choices.index;
        if (!has_index) {
            work.record["message"] =
                work.record["message"].get<std::string>() + "; not graded: it names no material";
            return;
        }
        try {
            make_ready(work.choices, *fitted);
            grade_job(work, std::move(*fitted));
        } catch (const InputError& error) {
            // An untrusted fit may not give a stone; a good fit must be gradable.
            if (work.trusted) throw;
            work.record["message"] = fmt::format(
                "{}; not graded: {}", work.record["message"].get<std::string>(), error.what());
        }
        return;
    }
    work.record["status"] = "graded";
    grade_job(work, std::move(load_for_grade(work.job.stone, work.choices, false).front()));
}

int fail(RecordJson& record, int code, const std::string& message) {
    record["status"] = "failed";
    record["exit_code"] = code;
    record["message"] = message;
    return code;
}

}  // namespace

int work_on_job(const BatchList& list, const BatchJob& job, const BatchSettings& settings,
                const std::string& fingerprint, const fs::path& folder) {
    JobInWork work{
        job, settings, choices_of(job, settings), fs::absolute(folder), record_of(job, fingerprint),
        true};
    // A material file on the command line is relative to where the command was given.
    if (job.material.empty() && fs::path(settings.material).extension() == ".toml")
        work.choices.material = fs::absolute(settings.material).string();
    fs::current_path(list.folder);
    int code = exit_internal;
    try {
        do_job(work);
        code = work.trusted ? exit_good : exit_untrusted;
        work.record["exit_code"] = code;
    } catch (const InputError& error) {
        code = fail(work.record, exit_impossible, error.what());
    } catch (const std::bad_alloc&) {
        code = fail(work.record, exit_impossible, "not enough memory for this input");
    } catch (const Interrupted&) {
        throw;
    } catch (const std::exception& error) {
        code = fail(work.record, exit_internal,
                    fmt::format("{} (an error in culet itself: please report it)", error.what()));
    }
    write_record(work.record, work.folder);
    return code;
}

void write_failure(const BatchJob& job, const std::string& fingerprint, int exit_code,
                   const std::string& message, const fs::path& folder) {
    RecordJson record = record_of(job, fingerprint);
    fail(record, exit_code, message);
    write_record(record, folder);
}

}  // namespace culet
