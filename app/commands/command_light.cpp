// culet light PHOTO... -o ENV.exr: an environment from mirror-ball photographs.

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>

#include "app/commands/near_light_options.h"
#include "app/program/options.h"
#include "app/program/terminal.h"
#include "compare/light_probe/ball_series.h"
#include "compare/light_probe/light_probe.h"
#include "compare/photo/lens.h"
#include "render/image/image_io.h"
#include "render/scene/environment_layout.h"
#include "stone/numbers/units.h"
#include "stone/text/errors.h"
#include "stone/text/output_file.h"

namespace culet {

namespace {

struct LightArguments {
    CommonOptions common;
    std::vector<std::string> photos;
    std::vector<std::vector<std::string>> views;
    std::vector<std::string> balls, exposures;
    NearLightWords near;
    std::string out, cube, picture, json, distance, reflectance, towards, camera, table;
    bool moved = false;
    double photographer_deg = 10;
    double turned_deg = 0;
    int width = 0, passes = 20;
    const CLI::Option* turned_given = nullptr;
};

ProbeOptions probe_options(const LightArguments& a) {
    ProbeOptions options;
    if (a.distance == "inf" || a.distance == "infinity") {
        options.distance = std::numeric_limits<double>::infinity();
    } else if (!a.distance.empty()) {
        options.distance = numbers_in(a.distance, 1, 1, "--distance is in ball radii, or inf")[0];
        if (!(options.distance > 1)) {
            throw InputError(
                fmt::format("--distance {}: the camera is outside the ball, more than "
                            "1 radius from its middle",
                            a.distance));
        }
    }
    if (!a.reflectance.empty()) {
        const auto values = numbers_in(a.reflectance, 1, 3, "--reflectance is R or R,G,B");
        if (values.size() == 2) throw InputError("--reflectance is one number or three");
        for (std::size_t c = 0; c < 3; ++c) {
            options.reflectance[c] = values[values.size() == 3 ? c : 0];
            if (!(options.reflectance[c] > 0 && options.reflectance[c] <= 1))
                throw InputError("--reflectance is over 0 and at most 1: chrome has about 0.6");
        }
    }
    if (!a.towards.empty()) {
        const auto values =
            numbers_in(a.towards, 2, 2, "--towards is AZIMUTH,ELEVATION in degrees");
        options.towards_azimuth = radians(values[0]);
        options.towards_elevation = radians(values[1]);
        if (std::abs(values[1]) > 90)
            throw InputError("--towards: the elevation is between -90 (down) and 90 degrees");
    }
    if (!(a.photographer_deg >= 0 && a.photographer_deg <= 60))
        throw InputError("--photographer is a half angle of 0 to 60 degrees");
    options.photographer = {radians(a.photographer_deg), radians(1.6 * a.photographer_deg)};
    if (a.turned_given->count() > 0) options.turned = radians(a.turned_deg);
    if (a.width != 0 && (a.width < 16 || a.width > 8192 || a.width % 2 != 0))
        throw InputError("--width is an even number of pixels, 16 to 8192");
    options.width = a.width;
    options.passes = a.passes;
    options.moved = a.moved;
    if (a.moved && options.turned)
        throw InputError("--turned is the camera's, which stands still with --moved: not both");
    options.near_lights = near_requests(a.near);
    options.ball_radius = a.near.ball_radius;
    if (!options.near_lights.empty() && a.table.empty()) {
        throw InputError(
            "near lights are not in the environment map: have them written as a [light] table with "
            "--table LIGHT.toml");
    }
    return options;
}

void give_balls(const LightArguments& a, std::vector<ProbeView>& views) {
    if (a.balls.empty()) return;
    if (a.balls.size() != 1 && a.balls.size() != views.size()) {
        throw InputError(
            fmt::format("--ball was given {} times for {} views: once for all, or once "
                        "for each",
                        a.balls.size(), views.size()));
    }
    for (std::size_t v = 0; v < views.size(); ++v) {
        const std::string& text = a.balls[a.balls.size() == 1 ? 0 : v];
        if (text == "find") continue;
        const auto values =
            numbers_in(text, 3, 3, "--ball is X,Y,RADIUS in pixels from the top left, or find");
        views[v].ball = BallCircle{values[0], values[1], values[2]};
    }
}

Picture picture_of(const EnvironmentMap& map, Picture::Environment kind) {
    Picture picture;
    picture.width = map.width;
    picture.height = map.height;
    picture.rgb = map.rgb;
    picture.environment = kind;
    return picture;
}

void write_light(const LightArguments& a, const LightProbe& probe, const ProbeOptions& given) {
    const Picture lat_long = picture_of(probe.light.map, Picture::Environment::lat_long);
    write_picture(lat_long, a.out);
    if (!a.cube.empty()) {
        const EnvironmentMap cube = cube_of_lat_long(probe.light.map, probe.light.map.width / 4);
        write_picture(picture_of(cube, Picture::Environment::cube), a.cube);
    }
    if (!a.picture.empty()) write_text(a.picture, coverage_png(probe));
    if (!a.table.empty()) {
        const std::filesystem::path beside = std::filesystem::absolute(a.table).parent_path();
        const std::filesystem::path map = std::filesystem::absolute(a.out);
        const std::filesystem::path way = map.lexically_relative(beside);
        write_text(a.table, light_toml(probe, (way.empty() ? map : way).generic_string()));
    }
    if (!a.json.empty()) write_text(a.json, light_json(probe, given));
}

void say_light(const LightProbe& probe, bool quiet) {
    for (const ProbeViewResult& view : probe.views) {
        say(fmt::format("{}: ball at {:.1f},{:.1f} with radius {:.1f} px, {:.0f} radii away ({})",
                        view.name, view.circle.x, view.circle.y, view.circle.radius, view.distance,
                        view.distance_from),
            quiet);
    }
    for (const NearLight& light : probe.near_lights) {
        if (!light.usable()) continue;
        say(fmt::format(
                "near light: {:.4g} x {:.4g}, {:.4g} away{}, radiance {:.4g}, {:.4g}, {:.4g}",
                2 * glm::length(light.window.u), 2 * glm::length(light.window.v), light.distance,
                light.from == "parallax"
                    ? fmt::format(" ± {:.2g}", light.distance_sigma)
                    : fmt::format(" ({})", light.from == "distance" ? "given" : light.from),
                light.radiance[0], light.radiance[1], light.radiance[2]),
            quiet);
    }
    for (std::size_t v = 0; v < probe.alignments.size(); ++v) {
        say(fmt::format("{}: {:.2f} degrees from the first camera; correlation {:.3f}; half of "
                        "what both show agrees within {:.2f} stops",
                        probe.views[v + 1].name, degrees(probe.views[v + 1].turned),
                        probe.alignments[v].correlation, probe.alignments[v].residual),
            quiet);
    }
    if (!probe.alignments.empty())
        say(fmt::format(
                "two views differ by less than {:.2f} stops over half of what they show, by "
                "{:.2f} on average",
                probe.middle_disagreement, probe.mean_disagreement),
            quiet);
}

int run_light(const LightArguments& a) {
    for (const std::string& file : {a.out, a.cube, a.picture, a.json, a.table})
        require_writable(file);
    for (const std::string& file : {a.out, a.cube}) {
        if (!file.empty() && !file.ends_with(".exr") && !file.ends_with(".hdr"))
            throw InputError(std::filesystem::path(file), "light is written as .exr or .hdr");
    }
    const ProbeOptions given = probe_options(a);
    BallSeries series;
    series.files.assign(a.photos.begin(), a.photos.end());
    for (const auto& view : a.views) {
        if (!view.empty()) series.views.emplace_back(view.begin(), view.end());
    }
    for (const std::string& text : a.exposures) series.exposures.push_back(parse_exposure(text));
    if (!a.camera.empty()) series.lens = read_lens(a.camera);
    ReadSeries read =
        read_ball_series(series, progress_line("reading photographs", a.common.quiet));
    give_balls(a, read.views);
    const LightProbe probe =
        light_probe(read.views, given, progress_line("finding the light", a.common.quiet));
    write_light(a, probe, given);
    say_light(probe, a.common.quiet);
    for (const std::string& note : read.notes) say("note: " + note, a.common.quiet);
    for (const std::string& note : probe.notes) say("note: " + note, a.common.quiet);
    if (!probe.usable()) say("not to be trusted: " + probe.doubt, a.common.quiet);
    if (probe.usable())
        say(fmt::format("next: {} in the scene, then culet compare PHOTO SCENE.toml -o report",
                        a.table.empty() ? fmt::format("light.environment = \"{}\"", a.out)
                                        : fmt::format("the [light] table of {}", a.table)),
            a.common.quiet);
    return probe.usable() ? exit_good : exit_untrusted;
}

void add_view_options(CLI::App& command, LightArguments& a) {
    command.add_option("PHOTO", a.photos,
                       "photographs: one view, or two to six from places up to 90 degrees from "
                       "the next; several exposures of a view are told apart by their EXIF data");
    command.add_option("-o,--output", a.out, "lat-long environment, .exr or .hdr")
        ->required()
        ->type_name("ENV");
    command
        .add_option("--view", a.views,
                    "photographs of one view (once a view), where they cannot be told apart")
        ->type_name("PHOTO...");
    command
        .add_option("--exposure", a.exposures,
                    "exposures in the order of the photographs: seconds (1/125) or stops (-2EV)")
        ->delimiter(',')
        ->type_name("LIST");
    command
        .add_option("--ball", a.balls,
                    "the ball's outline in pixels from the top left, once or once a view "
                    "(otherwise found)")
        ->type_name("X,Y,RADIUS")
        ->allow_extra_args(false);
    command
        .add_option("--distance", a.distance,
                    "from the camera to the ball's middle, in radii of the ball, or inf (otherwise "
                    "from EXIF, or from two views)")
        ->type_name("RADII");
    command
        .add_option("--reflectance", a.reflectance,
                    "share of light that the ball reflects (chrome 0.6, steel 0.57); otherwise 1")
        ->type_name("R[,G,B]");
    command
        .add_option("--towards", a.towards,
                    "where the first camera looked in the stone's frame, degrees: azimuth, "
                    "elevation; straight down with the picture's top towards +y is 90,-90")
        ->type_name("AZ,EL");
    a.turned_given = command
                         .add_option("--turned", a.turned_deg,
                                     "how far the camera went round for the second view, "
                                     "counter-clockwise from above (otherwise found)")
                         ->type_name("DEGREES");
    command
        .add_option("--camera", a.camera,
                    "camera file: take out the lens's distortion, and use its focal length")
        ->type_name("FILE");
}

}  // namespace

void add_command_light(CLI::App& program, int& exit_code) {
    auto a = std::make_shared<LightArguments>();
    CLI::App* command = program.add_subcommand(
        "light", "photographs of a mirror ball to the light around it, as an environment");
    add_view_options(*command, *a);
    add_near_light_options(*command, a->near);
    command->add_flag("--moved", a->moved,
                      "the camera stood still and the ball was moved: later views show only how "
                      "far near lights are");
    command
        ->add_option("--table", a->table,
                     "the scene's [light] table: the environment and the near lights")
        ->type_name("FILE");
    command
        ->add_option("--photographer", a->photographer_deg,
                     "half angle around the camera, filled from the other view")
        ->type_name("DEGREES")
        ->capture_default_str();
    command
        ->add_option("--width", a->width,
                     "of the environment, pixels (otherwise as the ball allows)")
        ->type_name("PIXELS");
    command->add_option("--sharpen", a->passes, "passes that undo the blur of resampling")
        ->check(CLI::Range(0, 100))
        ->type_name("N")
        ->capture_default_str();
    command->add_option("--cube", a->cube, "the same as a cube map, six squares in a column")
        ->type_name("FILE");
    command->add_option("--picture", a->picture, "PNG of coverage and of the views' disagreement")
        ->type_name("FILE");
    command->add_option("--json", a->json, "what was found, for programs; - is stdout")
        ->type_name("FILE");
    add_common(*command, a->common);
    command->footer(
        "Examples:\n"
        "  culet light front-*.dng side-*.dng -o room.exr --picture room.png --reflectance 0.6\n"
        "  culet light a.exr b.exr -o room.exr --ball 512,380,300 --ball 506,384,299 "
        "--distance 25\n"
        "  culet light here.exr there.exr --moved --camera camera.toml --near 498,402 "
        "--ball-radius 10 -o room.exr --table light.toml\n"
        "Exit codes: 0 good; 1 the views do not fit together in one way only, or disagree, or a "
        "near light's distance cannot be told; 2 could not be done.");
    command->callback([a, &exit_code] { exit_code = run_light(*a); });
}

}  // namespace culet
