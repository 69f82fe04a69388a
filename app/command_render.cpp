#include <fmt/format.h>

#include <memory>
#include <optional>

#include "app/options.h"
#include "app/terminal.h"
#include "render/image_io.h"
#include "render/render.h"
#include "render/scene_io.h"
#include "stone/errors.h"
#include "stone/output_file.h"

namespace culet {

namespace {

struct RenderOptions {
    CommonOptions common;
    std::string scene, out, stats, engine, effects, tonemap = "none";
    std::optional<int> depth;
    std::optional<double> tolerance;
    double exposure = 1;
    bool spectral = false, explain = false, verify = false;
};

// As the file and the command line say; what there is to note about it is said.
Scene scene_of(const RenderOptions& options, const std::vector<std::string>& settings) {
    Scene scene = read_scene(options.scene, settings);
    scene.settings.threads = options.common.threads;
    scene.settings.seed = options.common.seed;
    scene.settings.spectral = options.spectral;
    for (const std::string& note : scene.notes) say(note, options.common.quiet);
    return scene;
}

// `--effects dispersion,absorption` is a list in the scene file.
std::string effects_setting(const std::string& words) {
    if (words == "auto" || words == "all" || words == "none") return "\"" + words + "\"";
    std::string list = "[\"";
    for (char c : words) list += c == ',' ? "\", \"" : std::string(1, c);
    return list + "\"]";
}

int run_render(const RenderOptions& options) {
    std::vector<std::string> settings = options.common.set;
    if (!options.engine.empty()) settings.push_back("render.engine=\"" + options.engine + "\"");
    if (!options.effects.empty())
        settings.push_back("render.effects=" + effects_setting(options.effects));
    if (options.depth) settings.push_back(fmt::format("render.depth={}", *options.depth));
    if (options.tolerance)
        settings.push_back(fmt::format("render.tolerance={}", *options.tolerance));
    if (options.explain) {
        require_writable(options.stats);
        const ScenePlan plan = plan_to_explain(scene_of(options, settings),
                                               progress_line("planning", options.common.quiet));
        if (options.stats != "-") fmt::print("{}", explain(plan));
        if (!options.stats.empty()) write_text(options.stats, plan_json(plan));
        return exit_good;
    }
    if (options.out.empty()) throw InputError("render needs -o IMAGE, or --explain");
    const std::string extension = std::filesystem::path(options.out).extension().string();
    if (extension != ".exr" && extension != ".png" && extension != ".hdr") {
        throw InputError(options.out, "pictures are written as .exr, .png or .hdr");
    }
    if (options.spectral && extension != ".exr") {
        throw InputError(options.out, "spectral planes need an .exr file");
    }
    require_writable(options.out);
    require_writable(options.stats);
    const Scene scene = scene_of(options, settings);

    RenderResult result = render(scene, progress_line("rendering", options.common.quiet));
    if (options.verify) result.stats.verification = verify(scene, result);
    for (const std::string& note : result.stats.notes) say(note, options.common.quiet);
    PngLook look;
    look.exposure = options.exposure;
    look.tone_map = options.tonemap == "reinhard" ? ToneMap::reinhard : ToneMap::none;
    const std::string stats = stats_json(result.stats);
    write_picture(result.picture, options.out, look,
                  {{"culet:scene", std::filesystem::path(options.scene).filename().string()},
                   {"culet:seed", std::to_string(options.common.seed)}});
    if (!options.stats.empty()) write_text(options.stats, stats);
    if (options.verify) {
        const Verification& found = *result.stats.verification;
        say(fmt::format("measured error {:.2g} of the mean radiance at {} pixels (their own noise "
                        "{:.2g}), error bound {:.2g}",
                        found.measured, found.pixels, found.noise, found.bound),
            options.common.quiet);
    }
    if (options.common.verbose) {
        for (const EffectDecision& decision : result.stats.effects) {
            say(fmt::format("{:<14}{:<4} {}", name_of(decision.effect), decision.on ? "on" : "off",
                            decision.why),
                options.common.quiet);
        }
        say(fmt::format("{} rays, {} beams in {:.2f} s; remainder {:.2g}, cut {:.2g}, error bound "
                        "{:.2g} of "
                        "the mean",
                        result.stats.rays, result.stats.beams,
                        result.stats.seconds_setup + result.stats.seconds_build +
                            result.stats.seconds_shade + result.stats.seconds_check,
                        result.stats.remainder, result.stats.cut, result.stats.error_bound),
            options.common.quiet);
    }
    const bool trusted = !options.verify || result.stats.verification->holds();
    if (!trusted) say("the error bound does not hold", options.common.quiet);
    return trusted ? exit_good : exit_untrusted;
}

}  // namespace

void add_command_render(CLI::App& program, int& exit_code) {
    auto options = std::make_shared<RenderOptions>();
    CLI::App* command = program.add_subcommand("render", "render a scene with polarised light");
    command->add_option("scene", options->scene, "scene file (TOML)")
        ->required()
        ->type_name("SCENE.toml");
    command->add_option("-o,--output", options->out, "picture: .exr (linear), .hdr or .png")
        ->type_name("IMAGE");
    command
        ->add_option("--stats,--json", options->stats,
                     "what was simulated, left out and how long it took (JSON; - is stdout)")
        ->type_name("STATS.json");
    command->add_option("--engine", options->engine, "auto, reference, beams or preview");
    command->add_option("--effects", options->effects,
                        "auto, all, none, or a list: dispersion,absorption,...");
    command->add_option("--depth", options->depth, "faces on a path at most (0: by tolerance)");
    command->add_option("--tolerance", options->tolerance, "of the picture's mean radiance");
    command->add_flag("--explain", options->explain,
                      "print what would be simulated, left out, and why; draw nothing");
    command->add_flag("--verify", options->verify,
                      "hold some pixels against the reference with everything on");
    command->add_flag("--spectral", options->spectral,
                      "Stokes parameters S0 to S3 at every wavelength in the .exr");
    command->add_option("--exposure", options->exposure, "factor on linear light, for .png")
        ->check(CLI::PositiveNumber);
    command->add_option("--tonemap", options->tonemap, "for .png: none or reinhard")
        ->check(CLI::IsMember({"none", "reinhard"}));
    add_common(*command, options->common, true);
    command->footer(
        "Examples:\n"
        "  culet render scene.toml -o picture.exr --stats stats.json\n"
        "  culet render scene.toml -o quick.png --set render.samples=4 --set "
        "camera.size=[200,200]\n"
        "  culet render scene.toml --explain --tolerance 0.03\n"
        "  culet render scene.toml -o frame.png --engine beams\n"
        "  culet render samples/instruments/conoscope.toml -o conoscope.png --exposure 2");
    command->callback([options, &exit_code] { exit_code = run_render(*options); });
}

}  // namespace culet
