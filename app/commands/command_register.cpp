// culet register PHOTO SCENE.toml -o POSED.toml

#include <fmt/format.h>

#include <memory>

#include "app/program/file_kinds.h"
#include "app/program/options.h"
#include "app/program/terminal.h"
#include "compare/photo/photo.h"
#include "compare/pose/find_pose.h"
#include "render/scene/scene_io.h"
#include "stone/numbers/units.h"
#include "stone/text/errors.h"
#include "stone/text/output_file.h"
#include "stone/text/toml_file.h"

namespace culet {

namespace {

struct RegisterArguments {
    CommonOptions common;
    std::string photo, scene, out, overlay, json, mask;
    double facet_error_deg = 0.2, search_deg = 35, focal_error = 20, principal_point_error = 0,
           within_deg = 10, within_px = 0, doubt_percent = 0.1;
    bool mirrored = false, not_mirrored = false;
};

PoseOptions options_of(const RegisterArguments& a) {
    PoseOptions options;
    options.facet_error = radians(a.facet_error_deg);
    options.search = radians(a.search_deg);
    options.focal_error = a.focal_error / 100;
    options.principal_point_error = a.principal_point_error / 100;
    options.limits.angle = radians(a.within_deg);
    options.limits.shift_px = a.within_px;
    options.limits.error_probability = a.doubt_percent / 100;
    options.both_chiralities = a.mirrored;
    options.threads = a.common.threads;
    return options;
}

int run_register(const RegisterArguments& a) {
    require_kind(a.photo, {FileKind::picture}, "culet register", {});
    require_kind(a.scene, {FileKind::scene}, "culet register", a.common.set);
    const Photo photo = read_photo(a.photo, a.mask);
    say_notes(a.photo, photo.notes, a.common.quiet);
    const Scene scene = read_scene(a.scene, a.common.set);
    const PoseOptions options = options_of(a);
    for (const std::string& file : {a.out, a.overlay, a.json}) require_writable(file);
    const FoundPose pose = find_pose(photo, scene.stone.solid, scene.camera, options,
                                     progress_line("registering", a.common.quiet));

    std::vector<std::string> overrides = a.common.set;
    const CameraSettings camera = camera_settings(pose.camera);
    overrides.insert(overrides.end(), camera.overrides.begin(), camera.overrides.end());
    const std::filesystem::path out(a.out);
    const std::string text = rewritten_toml(a.scene, overrides, camera.without, out.parent_path());
    const std::string json = pose_json(pose);
    if (!a.overlay.empty()) write_text(a.overlay, pose_overlay(photo, scene.stone.solid, pose));
    if (!a.json.empty()) write_text(a.json, json);
    write_text(out, text);
    for (const std::string& words : pose_words(pose)) say(words, a.common.quiet);
    if (pose.usable())
        say(fmt::format("next: culet compare {} {} -o report", a.photo, a.out), a.common.quiet);
    return pose.usable() ? exit_good : exit_untrusted;
}

// How far off the camera and the model may be, and how sure the pose must be.
void add_tolerances(CLI::App& command, RegisterArguments& a) {
    command
        .add_option("--search-deg", a.search_deg,
                    "how far the rough camera's view may be off (default 35)")
        ->check(CLI::Range(1.0, 180.0));
    command
        .add_option("--facet-error-deg", a.facet_error_deg,
                    "how far the model's facets may be tilted, one sigma (default 0.2)")
        ->check(CLI::Range(0.001, 5.0));
    command
        .add_option("--focal-error", a.focal_error,
                    "of the rough camera's focal length, percent; 0: it is exact (default 20)")
        ->check(CLI::Range(0.0, 100.0));
    command
        .add_option("--principal-point-error", a.principal_point_error,
                    "percent of the picture's width; 0: it is as given (default)")
        ->check(CLI::Range(0.0, 100.0));
    command
        .add_option("--within-deg", a.within_deg,
                    "refuse a view less sure than this (degrees, 99 %; default 10)")
        ->check(CLI::Range(0.001, 90.0));
    command
        .add_option("--within-px", a.within_px,
                    "refuse a place less sure than this (pixels, 99 %; default 3 % of the stone's "
                    "diameter, but no less than 1)")
        ->check(CLI::Range(0.001, 1e6));
    command
        .add_option(
            "--doubt", a.doubt_percent,
            "refuse a pose more likely to be wrong than this (percent; default 0.1; 100 takes any)")
        ->check(CLI::Range(1e-6, 100.0));
}

}  // namespace

void add_command_register(CLI::App& program, int& exit_code) {
    auto arguments = std::make_shared<RegisterArguments>();
    RegisterArguments& a = *arguments;
    CLI::App* command = program.add_subcommand(
        "register", "finds the camera that took a photograph of a stone, from a rough one");
    command->add_option("PHOTO", a.photo, "photograph: PNG, JPEG, TIFF, EXR or HDR")->required();
    command->add_option("SCENE", a.scene, "scene file (TOML) with the stone and a rough camera")
        ->required()
        ->type_name("SCENE.toml");
    command->add_option("-o,--output", a.out, "the scene with the camera that was found")
        ->required()
        ->type_name("POSED.toml");
    command
        ->add_option("--overlay", a.overlay,
                     "the photograph with the stone's edges as the camera sees them, and, ten "
                     "times enlarged, the distances to the photograph's edges")
        ->type_name("PNG");
    command->add_option("--json", a.json, "the pose for programs; - is stdout")->type_name("FILE");
    command
        ->add_option("--mask", a.mask, "picture of the photograph's size, white where the stone is")
        ->type_name("FILE");
    add_tolerances(*command, a);
    command->add_flag("--mirrored", a.mirrored, "the photograph may be mirrored: try it both ways");
    command->add_flag("--not-mirrored", a.not_mirrored, "it is not mirrored (default)")
        ->excludes("--mirrored");
    add_common(*command, a.common, true);
    command->footer(
        "Examples:\n"
        "  culet register photo.jpg scene.toml -o posed.toml --overlay overlay.png\n"
        "  culet render posed.toml -o render.exr && culet compare photo.jpg render.exr -o report\n"
        "Exit codes: 0 found; 1 refused, with the outputs that show why; 2 could not be done.");
    command->callback([arguments, &exit_code] { exit_code = run_register(*arguments); });
}

}  // namespace culet
