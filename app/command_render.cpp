// culet render SCENE|STONE -o IMAGE: one picture, of a scene or of a stone alone.

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <memory>
#include <optional>

#include "app/options.h"
#include "app/picture_output.h"
#include "app/terminal.h"
#include "render/planner/explain.h"
#include "render/planner/quick_picture.h"
#include "render/planner/verify.h"
#include "render/render.h"
#include "render/scene/light_presets.h"
#include "render/scene/stone_scene.h"
#include "stone/errors.h"
#include "stone/output_file.h"

namespace culet {

namespace {

// What k_usual_allowance_ns is for people.
constexpr int k_usual_seconds = 10;

struct RenderOptions {
    CommonOptions common;
    std::string scene, out, stats, engine, effects, exposure, size, tonemap = "none";
    StoneScene stone;
    std::optional<int> depth;
    std::optional<double> tolerance;
    bool spectral = false, explain = false, verify = false;
};

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
    if (!options.size.empty()) settings.push_back(size_setting(options.size));
    return settings;
}

// As the file and the command line say; what there is to note about it is said.
Scene scene_of(const RenderOptions& options) {
    Scene scene = read_any_scene(options.scene, settings_of(options), options.stone);
    scene.settings.threads = options.common.threads;
    scene.settings.seed = options.common.seed;
    scene.settings.spectral = options.spectral;
    for (const std::string& note : scene.notes) say(note, options.common.quiet);
    return scene;
}

int explain_plan(const RenderOptions& options) {
    require_writable(options.stats);
    const ScenePlan plan =
        plan_to_explain(scene_of(options), progress_line("planning", options.common.quiet));
    if (options.stats != "-") print_lines(explain(plan));
    if (!options.stats.empty()) write_text(options.stats, plan_json(plan));
    return exit_good;
}

// How near the picture is, where that was left to culet.
void say_how_near(const RenderStats& stats, bool quiet) {
    if (std::isnan(stats.error_bound)) {
        say(fmt::format(
                "a rough picture, nobody knows how near: one that is checked takes more than "
                "about {} s; --tolerance 0.2 draws it",
                k_usual_seconds),
            quiet);
        return;
    }
    if (!stats.allowed_tolerance) return;
    const bool finest = stats.error_bound <= RenderSettings().tolerance;
    say(fmt::format("within {:.2g} of the mean radiance{}", stats.error_bound,
                    finest ? std::string()
                           : fmt::format(", which about {} s allow: --tolerance {:g} for a finer "
                                         "picture",
                                         k_usual_seconds, RenderSettings().tolerance)),
        quiet);
}

void say_all_about(const RenderStats& stats) {
    for (const EffectDecision& decision : stats.effects) {
        say(fmt::format("{:<14}{:<4} {}", name_of(decision.effect), decision.on ? "on" : "off",
                        decision.why),
            false);
    }
    say(fmt::format(
            "{} rays, {} beams in {:.2f} s; remainder {:.2g}, cut {:.2g}, error bound "
            "{:.2g} of the mean",
            stats.rays, stats.beams,
            stats.seconds_setup + stats.seconds_build + stats.seconds_shade + stats.seconds_check,
            stats.remainder, stats.cut, stats.error_bound),
        false);
}

// Pictures on their way to the file, for who watches at a terminal.
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
        const bool paced = scene_.settings.allowed_ns > 0;
        say(fmt::format("{} holds a first picture, after {:.1f} s; a better one {}", options_.out,
                        took.count(),
                        paced ? fmt::format("takes about {} s at most", k_usual_seconds)
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

int run_render(const RenderOptions& options) {
    if (options.explain) return explain_plan(options);
    if (options.out.empty() && options.stats.empty())
        throw InputError("render needs -o IMAGE, --stats FILE, or --explain");
    if (options.out == "-" && options.stats == "-")
        throw InputError("stdout takes the picture or the stats, not both");
    PictureOutput output(options.out, options.spectral);
    require_writable(options.stats);
    Scene scene = scene_of(options);
    output.look_as(options.exposure, options.tonemap, scene);
    if (!scene.names_tolerance && leaves_something_open(scene.settings))
        scene.settings.allowed_ns = k_usual_allowance_ns;

    const bool quiet = options.common.quiet;
    Drafts drafts(options, output, scene);
    RenderResult result;
    try {
        drafts.first();
        result = render(scene, progress_line("rendering", quiet), drafts.better());
        if (options.verify) result.stats.verification = verify(scene, result);
    } catch (const Interrupted&) {
        if (!drafts.any()) throw;
        say(fmt::format("interrupted; {} holds a coarse picture", options.out), false);
        return exit_interrupted;
    }
    for (const std::string& note : result.stats.notes) say(note, quiet);
    say_how_near(result.stats, quiet);
    const std::string stats = stats_json(result.stats);
    output.write(result.picture,
                 {{"culet:scene", std::filesystem::path(options.scene).filename().string()},
                  {"culet:seed", std::to_string(options.common.seed)}});
    if (!options.stats.empty()) write_text(options.stats, stats);
    if (options.verify) {
        const Verification& found = *result.stats.verification;
        say(fmt::format("measured error {:.2g} of the mean radiance at {} pixels (their own noise "
                        "{:.2g}), error bound {:.2g}",
                        found.measured, found.pixels, found.noise, found.bound),
            quiet);
    }
    if (options.common.verbose && !quiet) say_all_about(result.stats);
    const bool trusted = !options.verify || result.stats.verification->holds();
    if (!trusted) say("the error bound does not hold", quiet);
    // A rough picture, for want of time.
    if (scene.settings.allowed_ns > 0 && std::isnan(result.stats.error_bound))
        return exit_untrusted;
    return trusted ? exit_good : exit_untrusted;
}

void add_stone_options(CLI::App& command, StoneScene& stone) {
    command.add_option("--material", stone.material, "of the stone, instead of its own")
        ->type_name("NAME");
    std::string presets;
    for (const LightPreset& preset : light_presets())
        presets += fmt::format("{}{}", presets.empty() ? "" : ", ", preset.name);
    command
        .add_option("--light", stone.light,
                    presets +
                        ", or the views polariscope, conoscope, dichroscope; a stone without "
                        "a scene: jeweller")
        ->type_name("PRESET");
    command
        .add_option("--width", stone.width_mm,
                    "of a stone without a scene, mm; a design without a size: 6.5")
        ->type_name("MM");
}

}  // namespace

void add_command_render(CLI::App& program, int& exit_code) {
    auto options = std::make_shared<RenderOptions>();
    CLI::App* command =
        program.add_subcommand("render", "a picture of a scene or a stone, with polarised light");
    command
        ->add_option("scene", options->scene,
                     "scene or stone file, or a mesh (.obj .off .ply .stl) or cut design (.asc "
                     ".gem), which is shown face up")
        ->required()
        ->type_name("SCENE.toml|STONE");
    command
        ->add_option("-o,--output", options->out,
                     "picture: .exr (linear), .hdr or .png; - is stdout, as PNG")
        ->type_name("IMAGE");
    add_stone_options(*command, options->stone);
    command->add_option("--size", options->size, "of the picture in pixels: 400 or 600,400")
        ->type_name("PIXELS");
    command
        ->add_option("--stats,--json", options->stats,
                     "what was simulated, left out and how long it took (JSON; - is stdout)")
        ->type_name("STATS.json");
    command->add_option("--engine", options->engine, "auto, reference, beams or preview");
    command->add_option("--effects", options->effects,
                        "auto, all, none, or a list: dispersion,absorption,...");
    command->add_option("--depth", options->depth, "faces on a path at most (0: by tolerance)");
    command->add_option("--tolerance", options->tolerance,
                        "of the picture's mean radiance; not given: what about 10 s allow");
    command->add_flag("--explain", options->explain,
                      "print what would be simulated, left out, and why; draw nothing");
    command->add_flag("--verify", options->verify,
                      "hold some pixels against the reference with everything on");
    command->add_flag("--spectral", options->spectral,
                      "Stokes parameters S0 to S3 at every wavelength in the .exr");
    command
        ->add_option("--exposure", options->exposure,
                     "for .png: a factor on linear light, or auto: to the stone (which jeweller, "
                     "daylight, lightbox and darkfield are shown with; else 1)")
        ->type_name("auto|FACTOR");
    command->add_option("--tonemap", options->tonemap, "for .png: none or reinhard")
        ->check(CLI::IsMember({"none", "reinhard"}));
    add_common(*command, options->common, true);
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
