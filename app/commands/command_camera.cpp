// culet camera BOARD... -o CAMERA.toml: a camera's geometry from photographs of a printed board.

#include <fmt/format.h>

#include <memory>

#include "app/program/options.h"
#include "app/program/terminal.h"
#include "compare/photo/calibration_board.h"
#include "stone/text/errors.h"
#include "stone/text/output_file.h"

namespace culet {

namespace {

struct CameraArguments {
    CommonOptions common;
    std::vector<std::string> photos;
    std::string out, board;
    BoardShape shape;
};

int run_camera(const CameraArguments& a) {
    if (a.board.empty() && a.photos.empty())
        throw InputError("name photographs of the board, or write one with --board board.svg");
    if (!a.photos.empty() && a.out.empty())
        throw InputError("name the camera file to write with -o CAMERA.toml");
    require_writable(a.out);
    if (!a.board.empty()) {
        if (!a.board.ends_with(".svg"))
            throw InputError(std::filesystem::path(a.board), "a board is written as .svg");
        write_text(a.board, board_svg(a.shape));
        say(fmt::format("{}: {} x {} squares of {:g} mm, to be printed at 100 %", a.board,
                        a.shape.columns, a.shape.rows, a.shape.square_mm),
            a.common.quiet);
    }
    if (a.photos.empty()) return exit_good;
    const LensCalibration found = calibrate_lens({a.photos.begin(), a.photos.end()}, a.shape,
                                                 progress_line("calibrating", a.common.quiet));
    write_text(a.out, lens_toml(found.lens, ""));
    for (const std::string& note : found.notes) say("note: " + note, a.common.quiet);
    const Lens& lens = found.lens;
    say(fmt::format("focal length {:.1f} ± {:.1f} px, principal point {:.1f}, {:.1f} ± {:.1f} px, "
                    "the board's corners fit to {:.2f} px rms in {} pictures",
                    lens.focal_x, found.focal_sigma_px, lens.principal_x, lens.principal_y,
                    found.principal_sigma_px, lens.residual_px, lens.pictures),
        a.common.quiet);
    if (found.doubt.empty()) {
        say(fmt::format("next: culet photo PHOTO... -o stone.exr --camera {}", a.out),
            a.common.quiet);
        return exit_good;
    }
    say("not to be trusted: " + found.doubt, a.common.quiet);
    return exit_untrusted;
}

}  // namespace

void add_command_camera(CLI::App& program, int& exit_code) {
    auto a = std::make_shared<CameraArguments>();
    CLI::App* command = program.add_subcommand(
        "camera", "a camera's focal length and distortion, from photographs of a printed board");
    command->add_option("BOARD", a->photos, "photographs of the board, ten or more, tilted");
    command->add_option("-o,--output", a->out, "camera file, for culet photo --camera")
        ->type_name("CAMERA.toml");
    command->add_option("--board", a->board, "write the board to print")->type_name("FILE.svg");
    command->add_option("--columns", a->shape.columns, "squares across")->capture_default_str();
    command->add_option("--rows", a->shape.rows, "squares down")->capture_default_str();
    command->add_option("--square-mm", a->shape.square_mm, "width of a square as printed")
        ->capture_default_str();
    add_common(*command, a->common);
    command->footer(
        "Examples:\n"
        "  culet camera --board board.svg\n"
        "  culet camera board-*.jpg -o camera.toml\n"
        "Exit codes: 0 good; 1 written, but the pictures do not determine it well; 2 could not be "
        "done.");
    command->callback([a, &exit_code] { exit_code = run_camera(*a); });
}

}  // namespace culet
