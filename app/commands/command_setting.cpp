// culet setting STONE -o setting.obj: the metal that holds a stone.

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/input/readings_form.h"
#include "app/program/file_kinds.h"
#include "app/program/options.h"
#include "app/program/terminal.h"
#include "render/scene/setting_scene.h"
#include "render/scene/stone_scene.h"
#include "stone/file_kind.h"
#include "stone/mesh/mesh_io.h"
#include "stone/setting/setting.h"
#include "stone/solid/checks.h"
#include "stone/solid_input.h"
#include "stone/stone_io.h"
#include "stone/text/errors.h"
#include "stone/text/name_suggestions.h"
#include "stone/text/output_file.h"
#include "stone/text/text_scan.h"

namespace culet {

namespace {

constexpr int k_most_prongs = 24;

struct SettingCommand {
    CommonOptions common;
    std::filesystem::path stone, out, scene, json;
    std::string style = "prong", metal = "gold", material;
    std::string ring, prong_diameter, clearance;  // as written; empty: default
    int prongs = -1;
    bool no_shank = false;
    int smoothness = SettingOptions{}.smoothness;
};

struct StoneToSet {
    Stone stone;
    bool is_file = false;  // a stone file, not a mesh
    bool has_size = true;
    std::vector<std::string> notes;
};

StoneToSet load(const SettingCommand& command) {
    StoneToSet loaded;
    if (kind_of(command.stone, command.common.set) == FileKind::stone) {
        StoneFile file = read_stone(command.stone, command.common.set);
        if (!command.scene.empty() && command.material.empty())
            require_material(file, command.stone);
        loaded.stone = std::move(file.stone);
        loaded.notes = std::move(file.notes);
        loaded.is_file = true;
    } else {
        SolidInput input = load_solid(command.stone);
        loaded.stone.solid = std::move(input.solid);
        loaded.notes = std::move(input.notes);
        loaded.stone.convex = is_convex(loaded.stone.solid);
        loaded.has_size = has_size(loaded.stone.solid);
    }
    const CheckLimits limits{.planarity = k_largest_miss, .must_be_convex = false};
    const std::vector<Fault> faults = find_faults(loaded.stone.solid, limits);
    if (!faults.empty()) {
        throw InputError(command.stone,
                         fmt::format("cannot be set: {}: {} (culet info lists all faults)",
                                     name_of(faults.front().kind), faults.front().what));
    }
    return loaded;
}

SettingOptions options_of(const SettingCommand& command, const StoneToSet& loaded) {
    SettingOptions options;
    const double unit = mm_per(loaded.stone.unit);
    const auto length = [unit](const std::string& text, const std::string& name) {
        const double value = length_mm(text, name) / unit;
        if (!(value > 0)) throw InputError(fmt::format("{} must be above 0", name));
        return value;
    };
    if (command.style == "bezel" || command.prongs == 0) options.style = SettingStyle::bezel;
    if (command.prongs > 0) options.prongs = command.prongs;
    if (!command.prong_diameter.empty())
        options.prong_diameter = length(command.prong_diameter, "--prong-diameter");
    if (!command.clearance.empty()) options.clearance = length(command.clearance, "--clearance");
    options.ring_diameter /= unit;
    if (!command.ring.empty()) {
        options.ring_diameter = length(command.ring, "--ring");
    } else if (!loaded.has_size) {
        options.ring_diameter *= outline_width(loaded.stone.solid) / k_usual_width_mm;
    }
    options.shank = !command.no_shank;
    options.smoothness = command.smoothness;
    return options;
}

std::string report_json(const Setting& setting, std::size_t triangles) {
    const SettingOptions& options = setting.options;
    const bool prong = options.style == SettingStyle::prong;
    nlohmann::ordered_json json = {{"schema", 1},
                                   {"style", prong ? "prong" : "bezel"},
                                   {"prongs", options.prongs},
                                   {"prong_diameter", *options.prong_diameter},
                                   {"clearance", *options.clearance},
                                   {"least_gap", setting.clearance},
                                   {"girdle_height", setting.girdle_height}};
    json["ring_diameter"] =
        options.shank ? nlohmann::ordered_json(options.ring_diameter) : nlohmann::ordered_json();
    json["triangles"] = triangles;
    for (const SettingPart& part : setting.parts)
        json["parts"].push_back(
            {{"name", part.name}, {"triangles", part.shell.triangles.size()}, {"gap", part.gap}});
    return json.dump(2) + "\n";
}

void say_result(const SettingCommand& command, const StoneToSet& loaded, const Setting& setting,
                std::size_t triangles) {
    const bool quiet = command.common.quiet;
    for (const std::string& note : loaded.notes)
        say(fmt::format("{}: {}", command.stone.string(), note), quiet);
    if (!loaded.has_size)
        say(fmt::format("{} has no size: the metal is proportioned as for a width of {:g} mm "
                        "(culet convert --width 6.5mm gives it a size)",
                        command.stone.filename().string(), k_usual_width_mm),
            quiet);
    const SettingOptions& made = setting.options;
    const std::string_view unit = name_of(loaded.stone.unit);
    const std::string holds =
        made.style == SettingStyle::bezel
            ? fmt::format("bezel from a wire of {:.3g} {}", *made.prong_diameter, unit)
            : fmt::format("{} prongs of {:.3g} {}", made.prongs, *made.prong_diameter, unit);
    say(fmt::format("{}: {}{}, {:.3g} {} from the stone; {} closed shells, {} triangles",
                    command.out.string(), holds,
                    made.shank ? fmt::format(", ring of {:.3g} {} inside", made.ring_diameter, unit)
                               : std::string(", no shank"),
                    setting.clearance, unit, setting.parts.size(), triangles),
        quiet || command.json == "-");
    say(command.scene.empty()
            ? std::string("next: add --scene ring.toml for a scene to render")
            : fmt::format("next: culet render {} -o ring.png", command.scene.string()),
        quiet);
}

int run_setting(const SettingCommand& command) {
    const Metal& metal = metal_named(command.metal);
    if (!mesh_format(command.out))
        throw InputError(command.out,
                         "cannot be written: a setting ends in .obj, .off, .ply or .stl");
    for (const auto& file : {command.out, command.scene, command.json}) require_writable(file);
    // Distinguish catalogue names from files as scenes do.
    if (!command.material.empty() && extension_of(command.material) != "toml")
        catalogue_material(command.material);
    if (command.style == "bezel" && command.prongs > 0)
        throw InputError("a bezel has no prongs: leave out --prongs, or say --style prong");
    require_kind(command.stone, {FileKind::solid, FileKind::stone}, "culet setting",
                 command.common.set);
    const StoneToSet loaded = load(command);
    if (!command.scene.empty() && !loaded.is_file && command.material.empty()) {
        throw InputError(command.stone,
                         "names no material, and the scene needs one: --material diamond, say "
                         "(culet info --materials lists them)");
    }
    const Setting setting =
        make_setting(loaded.stone.solid, loaded.stone.up, options_of(command, loaded));
    const Solid mesh = mesh_of(setting);
    std::string scene;
    if (!command.scene.empty()) {
        SettingScene files;
        files.scene = command.scene;
        files.stone = command.stone;
        files.is_stone_file = loaded.is_file;
        files.material = command.material;
        files.convex = loaded.stone.convex;
        files.setting = command.out;
        files.metal = metal;
        files.made_by = "A stone in its setting, made by culet setting.";
        scene = setting_scene(files, setting);
    }
    write_surface(mesh, command.out);
    if (!command.scene.empty()) write_text(command.scene, scene);
    if (!command.json.empty()) write_text(command.json, report_json(setting, mesh.facets.size()));
    say_result(command, loaded, setting, mesh.facets.size());
    return exit_good;
}

void add_metal_options(CLI::App& command, SettingCommand& options) {
    command.add_option("--style", options.style, "prong or bezel")
        ->check(CLI::IsMember({"prong", "bezel"}))
        ->capture_default_str();
    command
        .add_option("--prongs", options.prongs,
                    "how many, 2 to 24; 0: a bezel. Default: one at each corner; round and oval "
                    "stones 6, cushions 4")
        ->check([](const std::string& text) {
            const int count = std::atoi(text.c_str());
            return count == 0 || (count >= 2 && count <= k_most_prongs)
                       ? std::string()
                       : fmt::format("{} is neither 0 (a bezel) nor 2 to {}", text, k_most_prongs);
        })
        ->type_name("N");
    command
        .add_option("--prong-diameter", options.prong_diameter,
                    "of the wire; default: an eighth of the stone's width")
        ->type_name("0.8mm");
    command
        .add_option("--clearance", options.clearance,
                    "between metal and stone; default: a five-hundredth of the stone's width")
        ->type_name("0.01mm");
    command.add_option("--ring", options.ring, "inner diameter of the shank; default: 17mm")
        ->type_name("17mm");
    command.add_flag("--no-shank", options.no_shank, "the head alone, without a ring");
    command
        .add_option("--smoothness", options.smoothness,
                    "flat sides of a round wire, a multiple of 4: 8 is coarse, 48 fine")
        ->check(CLI::Range(8, 128))
        ->check([](const std::string& text) {
            return std::atoi(text.c_str()) % 4 == 0 ? std::string()
                                                    : "--smoothness is a multiple of 4";
        })
        ->type_name("N")
        ->capture_default_str();
}

}  // namespace

void add_command_setting(CLI::App& program, int& exit_code) {
    auto options = std::make_shared<SettingCommand>();
    CLI::App* command = program.add_subcommand(
        "setting", "the metal that holds a stone: prongs or a bezel, and a ring, as a mesh");
    command
        ->add_option(
            "STONE", options->stone,
            "stone file (.toml), mesh (.obj .off .ply .stl .glb .step) or cut (.asc .gem .gcs)")
        ->required();
    command->add_option("-o,--output", options->out, "mesh of the metal: .obj .off .ply .stl")
        ->required()
        ->type_name("MESH");
    add_metal_options(*command, *options);
    std::vector<std::string> names;
    for (const Metal& metal : metals()) names.emplace_back(metal.name);
    command->add_option("--metal", options->metal, "of the scene: " + listed(names, names.size()))
        ->type_name("NAME")
        ->capture_default_str();
    command
        ->add_option("--scene", options->scene,
                     "also a scene that shows stone and setting, for culet render")
        ->type_name("FILE.toml");
    command->add_option("--material", options->material, "of the scene's stone, where it is a mesh")
        ->type_name("NAME");
    command->add_option("--json", options->json, "what was made, in numbers (- is stdout)")
        ->type_name("FILE");
    add_common(*command, options->common, true);
    command->footer(
        "The metal is several closed shells that overlap where they are soldered; none touches "
        "the stone.\n"
        "Examples:\n"
        "  culet setting brilliant.obj --material diamond --metal platinum -o ring.obj --scene "
        "ring.toml\n"
        "  culet setting stone.toml --style bezel --no-shank -o bezel.stl");
    command->callback([options, &exit_code] { exit_code = run_setting(*options); });
}

}  // namespace culet
