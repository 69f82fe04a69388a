// culet convert IN OUT

#include <fmt/format.h>

#include "app/commands/scene_export.h"
#include "app/input/export_input.h"
#include "app/input/readings_form.h"
#include "app/program/file_kinds.h"
#include "app/program/options.h"
#include "app/program/terminal.h"
#include "render/export/exported_stone.h"
#include "render/scene/stone_scene.h"
#include "stone/export/export_frame.h"
#include "stone/file_kind.h"
#include "stone/gemcad/gemcad_io.h"
#include "stone/material/material_io.h"
#include "stone/mesh/mesh_io.h"
#include "stone/solid/checks.h"
#include "stone/solid_input.h"
#include "stone/stone_io.h"
#include "stone/text/errors.h"
#include "stone/text/output_file.h"
#include "stone/text/text_scan.h"

namespace culet {

namespace {

struct ConvertOptions {
    CommonOptions common;
    std::filesystem::path in, out;
    CutReading cut;
    std::string width;  // empty: not scaled
    std::string material, clearance;
};

bool is_for_other_programs(const std::filesystem::path& out) {
    const std::string ending = extension_of(out);
    return ending == "glb" || ending == "gltf" || ending == "step" || ending == "stp" ||
           ending == "3mf";
}

void say_of(const std::filesystem::path& file, const std::vector<std::string>& notes, bool quiet) {
    for (const std::string& note : notes) say(fmt::format("{}: {}", file.string(), note), quiet);
}

void say_next(const ConvertOptions& options) {
    const std::string ending = extension_of(options.out), out = options.out.string();
    std::string next = fmt::format("open {} in the program that it is for", out);
    if (is_cut(options.out))
        next = fmt::format("culet info {} --cutting-sheet sheet.html (to cut it)", out);
    else if (!options.clearance.empty())
        next = fmt::format("subtract the solid of {} from the metal in your CAD program", out);
    else if (mesh_format(options.out))
        next = fmt::format("culet render {} --material NAME -o stone.png (a picture)", out);
    else if (ending == "pov")
        next = fmt::format("povray +I{}", out);
    else if (ending == "xml")
        next = fmt::format("mitsuba -m scalar_rgb {}", out);
    else if (ending == "pbrt")
        next = fmt::format("pbrt {}", out);
    say("next: " + next, options.common.quiet);
}

// In mm, with the girdle's plane at z = 0 and the table up.
int convert_for_others(const ConvertOptions& options) {
    ExportChoices choices{options.common.set, options.cut, options.material, {}};
    if (!options.width.empty()) choices.width_mm = length_mm(options.width, "--width");
    ExportInput input = read_for_export(options.in, choices);
    if (!options.clearance.empty()) {
        input.stone.solid =
            grown_outward(input.stone.solid, length_mm(options.clearance, "--clearance"));
        input.stone.name += " seat";
    }
    const ExportedStone written = exported(input.stone, input.has_material, options.out);
    write_text(options.out, written.bytes);
    const bool quiet = options.common.quiet;
    say_of(options.in, input.notes, quiet);
    say_of(options.in, input.details, quiet || !options.common.verbose);
    say_of(options.out, written.notes, quiet);
    say_next(options);
    return exit_good;
}

int convert_scene(const ConvertOptions& options) {
    StoneScene choices;
    choices.material = options.material;
    if (!options.width.empty()) choices.width_mm = length_mm(options.width, "--width");
    for (const std::string& note :
         export_scene(options.in, options.common.set, choices, options.out))
        say(note, options.common.quiet);
    say_next(options);
    return exit_good;
}

// A solid, or the stone of a stone file as drawn; not moved.
ExportInput converted_input(const ConvertOptions& options) {
    ExportInput input;
    if (kind_of(options.in, options.common.set) == FileKind::stone && is_cut(options.out)) {
        StoneFile stone = read_stone(options.in, options.common.set);
        input.stone = std::move(stone.stone);
        input.has_material = stone.has_material;
        input.notes = std::move(stone.notes);
        input.details = std::move(stone.details);
    } else {
        require_kind(options.in, {FileKind::solid}, "culet convert");
        SolidInput solid = load_solid(options.in, options.cut);
        input.stone.solid = std::move(solid.solid);
        input.notes = std::move(solid.notes);
        input.details = std::move(solid.details);
    }
    if (!options.material.empty()) {
        input.stone.material = material_called(options.material);
        input.has_material = true;
    }
    if (!options.width.empty())
        scale_to_width(input.stone.solid, length_mm(options.width, "--width"));
    return input;
}

int convert(const ConvertOptions& options) {
    const bool grows = !options.clearance.empty(), to_cut = is_cut(options.out);
    const bool to_scene = is_for_renderers(options.out),
               to_others = is_for_other_programs(options.out);
    if (grows && (to_scene || (!to_others && !mesh_format(options.out))))
        throw InputError("--clearance is for meshes, .glb, .gltf, .3mf and .step");
    if (to_scene) return convert_scene(options);
    if (to_others || grows) return convert_for_others(options);
    if (!options.material.empty() && !to_cut)
        throw InputError("--material is for .asc, .gem, .gcs, .glb, .gltf, .pov, .xml and .pbrt");
    if (!options.common.set.empty() && !to_cut) {
        throw InputError(
            "--set changes keys of a stone or scene: the output must end in .asc, .gem, .gcs, "
            ".pov, .xml, .pbrt, .glb, .gltf or .step");
    }
    if (!mesh_format(options.out) && !to_cut) {
        throw InputError(
            options.out,
            "cannot be written: the name must end in .obj, .off, .ply, .stl, .asc, "
            ".gem, .gcs, .glb, .gltf, .3mf, .step or .stp, or for a renderer in .pov, .xml "
            "(Mitsuba) or .pbrt");
    }
    if (!options.width.empty() && extension_of(options.out) == "gcs")
        throw InputError("--width: a .gcs has no size, Gem Cut Studio shows every stone alike");
    const ExportInput input = converted_input(options);
    // A bent or dented mesh may still be worth converting: it is written as it is.
    const std::vector<Fault> faults =
        find_faults(input.stone.solid, {.planarity = k_largest_miss, .must_be_convex = false});
    const ExportedStone written = exported(input.stone, input.has_material, options.out);
    write_text(options.out, written.bytes);
    // Only now: if nothing could be written, only the error is reported.
    const bool quiet = options.common.quiet;
    say_of(options.in, input.notes, quiet);
    say_of(options.in, input.details, quiet || !options.common.verbose);
    for (const Fault& fault : faults) {
        say(fmt::format("culet: warning: {}: {}: {}", options.in.string(), name_of(fault.kind),
                        fault.what),
            quiet);
    }
    say_of(options.out, written.notes, quiet);
    say_next(options);
    return faults.empty() ? exit_good : exit_untrusted;
}

}  // namespace

void add_command_convert(CLI::App& program, int& exit_code) {
    auto options = std::make_shared<ConvertOptions>();
    CLI::App* command =
        program.add_subcommand("convert",
                               "between mesh and cut formats (GemCad, Gem Cut Studio); to glTF and "
                               "STEP; a scene to POV-Ray, Mitsuba or PBRT");
    command
        ->add_option(
            "IN", options->in,
            "mesh (.obj .off .ply .stl .glb .gltf .step), cut (.asc .gem .gcs), stone file or "
            "scene (.toml)")
        ->required();
    command
        ->add_option(
            "OUT", options->out,
            ".obj, .off, .ply, .stl; cuts .asc, .gem, .gcs; for Blender and the web .glb "
            "or .gltf; for CAD "
            ".step; for printers .3mf; for renderers .pov, .xml (Mitsuba 3) or .pbrt (PBRT-v4)")
        ->required();
    command
        ->add_option("--meet-tolerance", options->cut.meet_tolerance,
                     "meets of a cut that miss by less than this fraction of its width become one "
                     "corner (0: none)")
        ->check(CLI::Range(0.0, 0.1))
        ->type_name("FRACTION")
        ->capture_default_str();
    command
        ->add_option("--width", options->width,
                     "scale the stone to this width (W of culet info): the output is in mm")
        ->type_name("6.5mm");
    command
        ->add_option("--material", options->material,
                     "of the stone in .asc, .gem and .gcs (its index), .glb, .gltf, .pov, .xml and "
                     ".pbrt: a name of the "
                     "catalogue or a "
                     "material file")
        ->type_name("NAME");
    command
        ->add_option("--clearance", options->clearance,
                     "enlarge a convex stone by this length on every side, to cut its seat")
        ->type_name("0.05mm");
    add_common(*command, options->common, true);
    command->footer(
        "Names, planes and all digits are kept as far as the format can hold them. A mesh with "
        "faults is converted as it is, with a warning and exit code 1. Cuts are read back before "
        "they count as written; what their format cannot keep is named on stderr. What another "
        "renderer cannot draw is named on stderr and in its file.\n"
        "Examples:\n"
        "  culet convert design.asc design.obj\n"
        "  culet convert --width 6.5mm design.asc stone.obj\n"
        "  culet convert design.gcs design.asc\n"
        "  culet convert scan.stl scan.ply\n"
        "  culet convert fitted.obj recut.asc --material tourmaline_green\n"
        "  culet convert --width 6.5mm --material diamond design.asc stone.glb\n"
        "  culet convert --clearance 0.05mm fitted.obj seat.step\n"
        "  culet convert scene.toml scene.pov --set render.depth=9\n"
        "  culet convert scene.toml scene.pbrt\n"
        "  culet convert fitted.obj scene.xml --material sapphire_blue");
    command->callback([options, &exit_code] { exit_code = convert(*options); });
}

}  // namespace culet
