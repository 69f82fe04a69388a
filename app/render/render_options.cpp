#include "app/render/render_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "render/image/film_look.h"
#include "render/scene/engine_name.h"
#include "render/scene/light_presets.h"

namespace culet {

namespace {

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
                        "a scene: photograph")
        ->type_name("PRESET");
    command
        .add_option("--width", stone.width_mm,
                    "of a stone without a scene, mm; a design without a size: 6.5")
        ->type_name("MM");
}

// Options that a scene's [render] has too; a plan sets all of them.
void add_settings(CLI::App& command, RenderOptions& options, CLI::Option* plan) {
    command
        .add_option("--engine", options.engine, fmt::format("{}", fmt::join(engine_names(), ", ")))
        ->excludes(plan);
    command
        .add_option("--table", options.table,
                    "ray table of the engine raytable: written where there is none, else "
                    "read, for other lights and body colours without tracing")
        ->type_name("FILE.rays")
        ->excludes(plan);
    command
        .add_option("--effects", options.effects,
                    "auto, all, none, or a list: dispersion,absorption,...")
        ->excludes(plan);
    command.add_option("--depth", options.depth, "faces on a path at most (0: by tolerance)")
        ->excludes(plan);
    command
        .add_option("--tolerance", options.tolerance,
                    "as a fraction of the mean radiance (default: what 3 s allow)")
        ->excludes(plan);
    command
        .add_option("--check", options.check,
                    "full: drawn until it is within the tolerance; estimate: drawn once, and "
                    "compared with the reference; none: drawn once")
        ->check(CLI::IsMember({"none", "estimate", "full"}))
        ->excludes(plan);
}

void add_uncertainty(CLI::App& command, RenderOptions& options, CLI::Option* frames) {
    CLI::Option* const uncertainty =
        command
            .add_option("--uncertainty", options.uncertainty,
                        "report of the stone's fit: the .exr gets the layers mean, sigma and "
                        "bands, of random stones within the readings' errors")
            ->type_name("FIT.json")
            ->excludes(frames);
    command.add_option("--draws", options.draws, "stones drawn from the uncertainty")
        ->needs(uncertainty)
        ->check(CLI::Range(2, 100000))
        ->capture_default_str();
}

// How a .png shows the light.
void add_film(CLI::App& command, RenderOptions& options) {
    command
        .add_option("--exposure", options.exposure,
                    "for .png: a factor on linear light, or auto: by the stone (default for "
                    "jeweller, photograph, daylight, lightbox and darkfield; else 1)")
        ->type_name("auto|FACTOR");
    command
        .add_option("--tonemap", options.tonemap,
                    fmt::format("for .png: {} (not given: as the scene's [film] says)",
                                fmt::join(tone_map_names(), ", ")))
        ->check(CLI::IsMember(tone_map_names()));
}

}  // namespace

void add_render_options(CLI::App& command, RenderOptions& options) {
    command
        .add_option(
            "scene", options.scene,
            "scene or stone file, or a mesh (.obj .off .ply .stl .glb .step) or cut design (.asc "
            ".gem .gcs), which is shown face up")
        ->required()
        ->type_name("SCENE.toml|STONE");
    command
        .add_option("-o,--output", options.out,
                    "picture: .exr (linear), .hdr or .png; - is stdout, as PNG")
        ->type_name("IMAGE");
    add_stone_options(command, options.stone);
    command.add_option("--size", options.size, "of the picture in pixels: 400 or 600,400")
        ->type_name("PIXELS");
    command
        .add_option("--stats,--json", options.stats,
                    "what was simulated, left out and how long it took (JSON; - is stdout)")
        ->type_name("STATS.json");
    CLI::Option* const plan =
        command
            .add_option("--plan", options.plan,
                        "STATS.json of an earlier picture of the same stone and light: drawn with "
                        "its settings, nothing is chosen or checked anew")
            ->type_name("STATS.json");
    add_settings(command, options, plan);
    CLI::Option* const frames = command
                                    .add_option("--frames", options.frames,
                                                "a turntable of so many pictures, -o "
                                                "frame-####.png or turn.mp4: planned and checked "
                                                "once, for the first")
                                    ->check(CLI::Range(1, 100000));
    command.add_option("--turn", options.turn_deg, "degrees that the stone turns in all frames")
        ->needs(frames);
    command.add_flag("--explain", options.explain,
                     "print what would be simulated, left out, and why; draw nothing");
    command.add_flag("--verify", options.verify,
                     "compare some pixels with the reference, every effect on");
    add_uncertainty(command, options, frames);
    command.add_flag("--spectral", options.spectral,
                     "Stokes parameters S0 to S3 at every wavelength in the .exr");
    add_film(command, options);
    add_common(command, options.common, true);
}

}  // namespace culet
