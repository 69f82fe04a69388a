// culet info FILE: what a file contains, and what is wrong with it.

#include <fmt/format.h>

#include "app/describe/cutting_sheet_file.h"
#include "app/describe/describe.h"
#include "app/describe/material_list.h"
#include "app/input/readings_form.h"
#include "app/program/file_kinds.h"
#include "app/program/options.h"
#include "app/program/terminal.h"
#include "stone/design/design.h"
#include "stone/file_kind.h"
#include "stone/solid_input.h"
#include "stone/stone_io.h"
#include "stone/text/errors.h"
#include "stone/text/output_file.h"
#include "stone/text/text_scan.h"
#include "stone/text/toml_file.h"

namespace culet {

namespace {

using Json = nlohmann::ordered_json;

struct InfoOptions {
    CommonOptions common;
    DescribeOptions describe;
    std::filesystem::path json, other;
    FormOptions form;
    std::string width;
    SheetOptions sheet;
};

// For a mesh, a cut design or a stone file.
std::vector<std::string> form_of(const InfoOptions& options) {
    const std::filesystem::path& file = options.describe.file;
    FormOptions form = options.form;
    const auto take_gear = [&](const Solid& solid) {
        // The teeth of a wheel that is turned against the stone would be wrong, so none are given.
        if (solid.design) form.gear = solid.design->gear_offset == 0 ? solid.design->gear : 0;
        if (options.describe.cutting.gear != 0) form.gear = options.describe.cutting.gear;
    };
    if (is_solid_file(file)) {
        Stone stone;
        stone.name = file.stem().string();
        stone.convex = !options.describe.may_be_concave;
        SolidInput input = load_solid(file, options.describe.cut);
        stone.solid = std::move(input.solid);
        take_gear(stone.solid);
        if (options.describe.width_mm > 0) scale_to_width(stone.solid, options.describe.width_mm);
        std::vector<std::string> lines = write_form(form, std::move(stone), false, file);
        if (options.describe.width_mm > 0 && !options.form.stone.empty()) {
            lines.push_back(fmt::format(
                "{} names the mesh as it is: the fit scales it to the lengths that were read "
                "(culet convert --width writes a scaled one)",
                options.form.stone.string()));
        }
        return lines;
    }
    const bool is_stone =
        extension_of(file) == "toml" &&
        read_toml(file, options.common.set).kind("stone") == TomlTable::Kind::table;
    if (!is_stone) {
        throw InputError(file, "--readings is for a stone: a mesh, a cut design or a stone file");
    }
    if (!options.form.stone.empty())
        throw InputError(file, "--stone: this is a stone file already");
    StoneFile read = read_stone(file, options.common.set);
    take_gear(read.stone.solid);
    return write_form(form, read.stone, read.has_material, read.mesh_file);
}

int info(InfoOptions options) {
    options.describe.facet_table = options.common.verbose;
    options.describe.overrides = options.common.set;
    require_form(options.form);
    if (!options.width.empty()) {
        if (!is_solid_file(options.describe.file)) {
            throw InputError(options.describe.file, "--width scales a mesh or a cut design");
        }
        options.describe.width_mm = length_mm(options.width, "--width");
    }
    if (options.describe.cutting.gear != 0 && options.sheet.out.empty() &&
        options.form.readings.empty())
        options.describe.cutting_list = true;
    if (!options.sheet.report.empty() && options.sheet.out.empty() && !options.describe.style)
        throw InputError("--report goes with --cutting-sheet or --style: give both");
    if (options.describe.style) options.describe.report = options.sheet.report;
    if (options.describe.style && !is_solid_file(options.describe.file))
        throw InputError(options.describe.file, "--style is for a mesh or a cut design");
    if (options.describe.cutting_list && !is_solid_file(options.describe.file)) {
        throw InputError(options.describe.file, "--cutting-list is of a mesh or a cut design");
    }
    const Description about = options.other.empty()
                                  ? describe_file(options.describe)
                                  : describe_difference(options.describe, options.other);
    Json object{{"schema", 1}, {"file", options.describe.file.string()}};
    object.update(about.object);
    object["notes"] = about.notes;
    object["faults"] = Json::array();
    for (const Fault& fault : about.faults) {
        object["faults"].push_back({{"kind", name_of(fault.kind)}, {"what", fault.what}});
    }
    const std::vector<std::string> form =
        options.form.readings.empty() ? std::vector<std::string>() : form_of(options);
    if (!options.json.empty()) {
        // Names in a file need not be UTF-8; JSON must be.
        write_text(options.json, object.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
    }
    for (const std::string& line : form) say(line, options.common.quiet);
    if (!options.sheet.out.empty()) write_cutting_sheet(options.sheet, options.describe);
    if (options.json != "-" && options.form.readings != "-" && options.sheet.out != "-") {
        for (const std::string& line : about.lines) fmt::print("{}\n", safe_for(stdout, line));
        for (const std::string& note : about.notes)
            fmt::print("note: {}\n", safe_for(stdout, note));
        for (const Fault& fault : about.faults) {
            fmt::print("fault: {}: {}\n", name_of(fault.kind), safe_for(stdout, fault.what));
        }
        std::fflush(stdout);
    }
    const bool alike = options.other.empty() || about.object["differences"].empty();
    return about.faults.empty() && alike ? exit_good : exit_untrusted;
}

Description describe_job_file(const TomlTable& root) {
    Description about;
    about.object["format"] = "job";
    about.lines.push_back(fmt::format("{}: a job, for culet run", root.file().string()));
    for (const auto& [part, key] :
         {std::pair("fit", "stone"), std::pair("render", "scene"), std::pair("compare", "photo")}) {
        const auto table = root.table(part);
        if (!table || !table->has(key)) continue;
        const std::filesystem::path path = *table->path(key);
        if (!std::filesystem::exists(path))
            table->fail(key, fmt::format("no such file: {}", path.string()));
        about.object[part] = path.string();
        about.lines.push_back(fmt::format("{:<8} {}", part, path.string()));
    }
    return about;
}

}  // namespace

Description describe_file(const DescribeOptions& options) {
    if (is_solid_file(options.file)) return describe_solid_file(options);
    if (extension_of(options.file) == "rays") return describe_ray_table(options);
    switch (kind_of(options.file, options.overrides)) {
        case FileKind::job:
            return describe_job_file(read_toml(options.file, options.overrides));
        case FileKind::stone:
            return describe_stone_file(options);
        case FileKind::material:
            return describe_material_file(options);
        case FileKind::scene:
            return describe_scene_file(options);
        case FileKind::picture:
            return describe_image_file(options);
        case FileKind::unknown:
            if (extension_of(options.file) == "toml") return describe_scene_file(options);
            break;
        default:
            break;
    }
    require_file(options.file);
    if (const std::string other = foreign_kind_of(options.file); !other.empty())
        throw InputError(options.file, other);
    throw InputError(
        options.file,
        "is of an unknown kind: info reads meshes and cuts (.obj .off .ply .stl .glb "
        ".step .asc .gem .gcs), stones, scenes and materials (.toml), pictures (.exr .hdr .png "
        ".jpg), and ray tables (.rays)");
}

namespace {

void add_solid_options(CLI::App& command, InfoOptions& options) {
    command
        .add_option("--meet-tolerance", options.describe.cut.meet_tolerance,
                    "meets of a cut that miss by less than this fraction of its width become one "
                    "corner (0: none)")
        ->check(CLI::Range(0.0, 0.1))
        ->type_name("FRACTION")
        ->capture_default_str();
    command
        .add_option("--width", options.width,
                    "describe a mesh or cut design at this width (W), in mm")
        ->type_name("6.5mm");
    command.add_flag("--cutting-list", options.describe.cutting_list,
                     "of a mesh or cut design: angle and index settings, tier by tier");
    command
        .add_option("--cutting-sheet", options.sheet.out,
                    "of a mesh or cut design, to be printed: drawings, angles, index settings, "
                    "what each tier is cut to")
        ->type_name("SHEET.html|.txt");
    command
        .add_option("--report", options.sheet.report,
                    "report of the stone's fit: angles of the cutting sheet, and proportions, with "
                    "their sigmas")
        ->type_name("FIT.json");
    command
        .add_option_function<std::string>(
            "--style",
            [&options](const std::string& style) {
                options.describe.style = style == "gia"   ? ReportStyle::gia
                                         : style == "ags" ? ReportStyle::ags
                                                          : ReportStyle::plain;
            },
            "of a mesh or cut design: all proportions by the trade's definitions, beside "
            "them as GIA or AGS round them")
        ->check(CLI::IsMember({"plain", "gia", "ags"}));
    command
        .add_option("--gear", options.describe.cutting.gear,
                    "teeth of the index wheel of cutting list and form (the design's own, or 96)")
        ->check(CLI::Range(1.0, 1e6))
        ->type_name("TEETH");
    command
        .add_option("--goniometer", options.describe.cutting.shown_deg,
                    "step of your machine's scale, degrees: facets of a tier that differ by less "
                    "are cut alike (0.1)")
        ->check(CLI::Range(0.001, 5.0))
        ->type_name("DEG");
    add_form_options(command, options.form);
    command
        .add_option("--material", options.form.material,
                    "for the weight in the form, and the stone file")
        ->type_name("NAME");
    command.add_flag("--may-be-concave", options.describe.may_be_concave,
                     "a stone that is not convex is not a fault");
}

}  // namespace

void add_command_info(CLI::App& program, int& exit_code) {
    auto options = std::make_shared<InfoOptions>();
    CLI::App* command =
        program.add_subcommand("info", "what a file holds, and what is wrong with it");
    auto materials = std::make_shared<std::optional<std::string>>();
    auto page = std::make_shared<std::filesystem::path>();
    command->add_option("FILE", options->describe.file,
                        "mesh, cut, stone, scene, job, material, picture or ray table");
    command
        ->add_option_function<std::vector<std::string>>(
            "--materials",
            [materials](const std::vector<std::string>& words) {
                *materials = words.empty() ? std::string() : words.front();
            },
            "list the catalogue of materials, or those that WORD names: indices, birefringence, "
            "density, colour")
        ->expected(0, 1)
        ->type_name("[WORD]");
    command->add_option("-o,--output", *page, "the list of materials as a page with colour fields")
        ->type_name("LIST.html");
    command->add_option("--json", options->json, "write one object there (-: stdout)")
        ->type_name("FILE");
    add_solid_options(*command, *options);
    CLI::Option* diff = command
                            ->add_option("--diff", options->other,
                                         "compare with this mesh or cut design: gear, tiers, "
                                         "angles, index settings, depths, notes")
                            ->type_name("DESIGN");
    for (const char* other : {"--width", "--cutting-list", "--cutting-sheet", "--gear",
                              "--goniometer", "--readings", "--material", "--may-be-concave"})
        diff->excludes(other);
    add_common(*command, options->common, true);
    command->footer(
        "-v lists every facet. Exit code 1 when there are faults, or with --diff differences.\n"
        "Examples:\n"
        "  culet info design.asc\n"
        "  culet info old.asc --diff new.gcs\n"
        "  culet info --materials garnet\n"
        "  culet info --materials -o materials.html --json materials.json\n"
        "  culet info hand.obj -v --json hand.json\n"
        "  culet info design.asc --width 6.5mm --material sapphire_blue --readings form.csv");
    command->callback([options, materials, page, &exit_code] {
        if (*materials) return list_materials({**materials, options->json, *page});
        if (!page->empty())
            throw InputError("-o writes the list of materials: give --materials, or --json FILE");
        if (options->describe.file.empty()) throw InputError("name a file, or use --materials");
        exit_code = info(*options);
    });
}

}  // namespace culet
