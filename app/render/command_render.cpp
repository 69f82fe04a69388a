// culet render SCENE|STONE -o IMAGE: one picture of a scene or of a stone alone.

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>

#include "app/program/terminal.h"
#include "app/render/movie.h"
#include "app/render/picture_output.h"
#include "app/render/render_frames.h"
#include "app/render/render_options.h"
#include "app/render/render_words.h"
#include "app/render/saved_plan.h"
#include "refine/fit_uncertainty.h"
#include "render/engine/engine.h"
#include "render/planner/explain.h"
#include "render/planner/quick_picture.h"
#include "render/planner/verify.h"
#include "render/render.h"
#include "render/uncertainty/picture_uncertainty.h"
#include "stone/numbers/quantile.h"
#include "stone/text/errors.h"
#include "stone/text/output_file.h"

namespace culet {

namespace {

// `--effects dispersion,absorption` is a list in the scene file.
std::string effects_setting(const std::string& words) {
    if (words == "auto" || words == "all" || words == "none") return "\"" + words + "\"";
    std::string list = "[\"";
    for (char c : words) list += c == ',' ? "\", \"" : std::string(1, c);
    return list + "\"]";
}

// "400" or "600,400" as the scene's key.
std::string size_setting(const std::string& text) {
    const std::vector<double> size =
        numbers_in(text, 1, 2, "--size is a picture's side in pixels, or WIDTH,HEIGHT");
    return fmt::format("camera.size=[{},{}]", size.front(), size.back());
}

std::vector<std::string> settings_of(const RenderOptions& options) {
    std::vector<std::string> settings = options.common.set;
    if (!options.engine.empty()) settings.push_back("render.engine=\"" + options.engine + "\"");
    if (!options.effects.empty())
        settings.push_back("render.effects=" + effects_setting(options.effects));
    if (options.depth) settings.push_back(fmt::format("render.depth={}", *options.depth));
    if (options.tolerance)
        settings.push_back(fmt::format("render.tolerance={}", *options.tolerance));
    if (!options.check.empty()) settings.push_back("render.check=\"" + options.check + "\"");
    if (!options.size.empty()) settings.push_back(size_setting(options.size));
    return settings;
}

Frames frames_of(const RenderOptions& options) {
    return {options.frames.value_or(1), options.turn_deg, options.out,
            options.exposure,           options.tonemap,  options.spectral};
}

// Prints the scene's notes.
Scene scene_of(const RenderOptions& options, const SavedPlan* plan = nullptr) {
    std::vector<std::string> settings = settings_of(options);
    if (plan != nullptr)
        settings.insert(settings.begin(), plan->settings.begin(), plan->settings.end());
    Scene scene = read_any_scene(options.scene, settings, options.stone);
    scene.settings.threads = options.common.threads;
    scene.settings.seed = options.common.seed;
    scene.settings.spectral = options.spectral;
    scene.settings.ray_table = options.table;
    for (const std::string& note : scene.notes) say(note, options.common.quiet);
    return scene;
}

int explain_plan(const RenderOptions& options) {
    require_writable(options.stats);
    const Scene scene = scene_of(options);
    if (!engine_of(scene.settings).approaches_truth())
        throw InputError(
            fmt::format("--explain shows the plan; engine {} has none", scene.settings.engine));
    if (scene.has_objects())
        throw InputError(
            "--explain shows the plan, and scenes with objects or several stones have none: they "
            "are drawn with their own settings (docs/objects.md)");
    const ScenePlan plan = plan_to_explain(scene, progress_line("planning", options.common.quiet));
    if (options.stats != "-") print_lines(explain(plan));
    if (!options.stats.empty()) write_text(options.stats, plan_json(plan));
    return exit_good;
}

// Writes drafts of the picture to the file while somebody watches at a terminal.
class Drafts {
public:
    Drafts(const RenderOptions& options, const PictureOutput& output, const Scene& scene)
        : options_(options),
          output_(output),
          scene_(scene),
          wanted_(!options.common.quiet && output.goes_to_a_file() && isatty(STDERR_FILENO) != 0) {}

    void first() {
        if (!wanted_) return;
        const auto start = std::chrono::steady_clock::now();
        write(draw_quickly(scene_, progress_line("a first picture", false)));
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
        const bool time_limited = scene_.settings.allowed_ns > 0;
        say(fmt::format("{} holds a first picture, after {:.1f} s; a better one {}", options_.out,
                        took.count(),
                        time_limited ? fmt::format("usually takes about {} s", k_usual_seconds)
                                     : std::string("follows")),
            false);
    }
    PictureSink better() {
        if (!wanted_) return {};
        return [this](const RenderResult& result) { write(result); };
    }
    bool any() const { return any_; }

private:
    void write(const RenderResult& result) {
        output_.write(result.picture, {{"culet:draft", "yes"}});
        any_ = true;
    }

    const RenderOptions& options_;
    const PictureOutput& output_;
    const Scene& scene_;
    bool wanted_, any_ = false;
};

void require_sense(const RenderOptions& options) {
    if (options.out.empty() && options.stats.empty())
        throw InputError("render needs -o IMAGE, --stats FILE, or --explain");
    if (!options.table.empty() && options.frames)
        throw InputError("a ray table is of one view: leave out --table, or --frames");
    if (options.out == "-" && options.stats == "-")
        throw InputError("stdout takes the picture or the stats, not both");
    if (!options.uncertainty.empty() && !options.out.ends_with(".exr"))
        throw InputError("--uncertainty adds layers to an OpenEXR picture: -o IMAGE.exr");
    if (!options.plan.empty() &&
        std::any_of(options.common.set.begin(), options.common.set.end(),
                    [](const std::string& set) { return set.starts_with("render."); }))
        throw InputError("--plan says how to draw: leave out --set render...., or --plan");
}

// Adds layers of the uncertainty that the stone's fit leaves.
void add_uncertainty(const RenderOptions& options, const Scene& scene,
                     const StoneUncertainty& uncertainty, RenderResult& result) {
    const bool quiet = options.common.quiet;
    const PictureUncertainty found =
        picture_uncertainty(scene, plan_drawn(scene, result.stats), uncertainty, options.draws,
                            progress_line("drawing stones from the uncertainty", quiet));
    add_layers(found, result.picture);
    std::vector<float> relative;
    const std::size_t pixels = result.picture.pixels();
    for (std::size_t p = 0; p < pixels; ++p) {
        const float* mean = found.mean.data() + 3 * p;
        const double light = luminance({mean[0], mean[1], mean[2]});
        if (found.sigma_luminance[p] > 0 && light > 0)
            relative.push_back(found.sigma_luminance[p] / static_cast<float>(light));
    }
    say(fmt::format("the readings' uncertainty changes half of the stone's pixels by more than "
                    "{:.0f} % (one sigma, {} draws{}); culet compare PHOTO {} shows where a "
                    "photograph lies within it",
                    relative.empty() ? 0 : 100 * double(quantile(relative, 0.5)), found.draws,
                    found.correlated ? "" : ", facets taken as independent", options.out),
        quiet);
    if (found.left_out > 0)
        say(fmt::format("{} random stones do not close and are left out", found.left_out), quiet);
    if (uncertainty.unknown > 0)
        say(fmt::format("{} facets have no uncertainty in {} and count as known exactly",
                        uncertainty.unknown, options.uncertainty),
            quiet);
}

// All frames of a turntable (returns the first), or the single picture.
RenderResult draw(const RenderOptions& options, const Scene& scene,
                  const std::optional<SavedPlan>& saved,
                  const std::optional<StoneUncertainty>& uncertainty, const PictureOutput& output,
                  Drafts& drafts) {
    const bool quiet = options.common.quiet;
    const auto picture = [&](const Scene& now) {
        const Progress progress = progress_line("rendering", quiet);
        RenderResult result = saved ? render_as_planned(now, saved->of(now), progress)
                                    : render(now, progress, drafts.better());
        if (options.verify) result.stats.verification = verify(now, result, 128, progress);
        return result;
    };
    if (options.frames) return draw_frames(frames_of(options), scene, picture, quiet);
    if (!saved && engine_of(scene.settings).approaches_truth()) drafts.first();
    RenderResult result = picture(scene);
    if (uncertainty) add_uncertainty(options, scene, *uncertainty, result);
    output.write(result.picture,
                 {{"culet:scene", std::filesystem::path(options.scene).filename().string()},
                  {"culet:seed", std::to_string(options.common.seed)}});
    return result;
}

std::string next_step(const RenderOptions& options) {
    if (is_movie(options.out)) return fmt::format("open {} in a film player", options.out);
    if (options.frames)
        return fmt::format("look at {}; with -o turn.mp4 they become a film",
                           frame_name(options.out, 0));
    if (options.out.ends_with(".exr"))
        return fmt::format("culet compare PHOTO {} -o report (against a photograph)", options.out);
    return fmt::format("open {}; culet view {} -o stone.html makes a page in which it turns",
                       options.out, options.scene);
}

int run_render(const RenderOptions& options) {
    if (options.explain) return explain_plan(options);
    require_sense(options);
    if (options.frames) require_frames(frames_of(options));
    PictureOutput output(options.frames ? "" : options.out, options.spectral);
    require_writable(options.stats);
    std::optional<SavedPlan> saved;
    if (!options.plan.empty()) saved = read_saved_plan(options.plan);
    Scene scene = scene_of(options, saved ? &*saved : nullptr);
    if (!options.table.empty() && scene.settings.engine != k_raytable_engine)
        throw InputError("--table is for ray tables: add --engine raytable");
    std::optional<StoneUncertainty> uncertainty;
    if (!options.uncertainty.empty())
        uncertainty = uncertainty_in(options.uncertainty, scene.stone);
    output.look_as(options.exposure, options.tonemap, scene);
    const bool nears_truth = engine_of(scene.settings).approaches_truth();
    if (options.verify && !nears_truth)
        throw InputError(fmt::format(
            "--verify compares a picture with the reference, which cannot judge engine {}",
            scene.settings.engine));
    if (options.verify && scene.has_objects())
        throw InputError(
            "--verify compares some pixels with the reference; with objects or several stones the "
            "reference is as noisy as the picture: say --set render.samples=256");
    const bool time_limited = !saved && allow_usual_time(scene);

    const bool quiet = options.common.quiet;
    Drafts drafts(options, output, scene);
    RenderResult result;
    try {
        result = draw(options, scene, saved, uncertainty, output, drafts);
    } catch (const Interrupted&) {
        if (!drafts.any()) throw;
        say(fmt::format("interrupted; {} holds a coarse picture", options.out), false);
        return exit_interrupted;
    }
    const RenderStats& stats = result.stats;
    for (const std::string& note : stats.notes) say(note, quiet);
    if (nears_truth) print_accuracy(stats, scene.settings.check, time_limited, quiet);
    if (!options.stats.empty()) write_text(options.stats, stats_json(stats));
    if (stats.verification) say_verified(*stats.verification, quiet);
    if (options.common.verbose && !quiet) say_all_about(stats);
    if (!options.out.empty() && options.out != "-") say("next: " + next_step(options), quiet);
    return usable(stats, time_limited) ? exit_good : exit_untrusted;
}

}  // namespace

void add_command_render(CLI::App& program, int& exit_code) {
    auto options = std::make_shared<RenderOptions>();
    CLI::App* command =
        program.add_subcommand("render", "a picture of a scene or a stone, with polarised light");
    add_render_options(*command, *options);
    command->footer(
        "Examples:\n"
        "  culet render stone.obj --material sapphire_blue -o stone.png\n"
        "  culet render design.asc --material diamond --light aset --size 300 -o aset.png\n"
        "  culet render scene.toml -o picture.exr --stats stats.json\n"
        "  culet render scene.toml --explain --tolerance 0.03\n"
        "  culet render scene.toml -o frame.png --engine beams\n"
        "  culet render samples/instruments/conoscope.toml -o conoscope.png --exposure 2");
    command->callback([options, &exit_code] { exit_code = run_render(*options); });
}

}  // namespace culet
