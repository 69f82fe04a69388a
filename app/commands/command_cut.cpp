// culet cut NAME [--param VALUE...] -o MESH: each cut is a subcommand, made from its table.

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/input/readings_form.h"
#include "app/program/options.h"
#include "app/program/terminal.h"
#include "stone/cuts/cuts.h"
#include "stone/design/design.h"
#include "stone/mesh/mesh_io.h"
#include "stone/stone.h"
#include "stone/text/errors.h"
#include "stone/text/name_suggestions.h"
#include "stone/text/output_file.h"
#include "stone/text/toml_advice.h"
#include "stone/text/toml_file.h"

namespace culet {

namespace {

struct CutOptions {
    CommonOptions common;
    std::string out, json;
    FormOptions form;
    std::map<std::string, double> values;
};

constexpr const char* k_segments = "girdle-segments";
// 96 round a brilliant, so that its outline looks round.
constexpr double k_round_girdle = 6;

// The library's cuts have one girdle facet under each upper half. This command's have more, if the
// girdle is thick enough for their scallops.
std::map<std::string, double> with_round_girdle(const CutKind& kind,
                                                std::map<std::string, double> values) {
    const bool may = std::any_of(kind.parameters.begin(), kind.parameters.end(),
                                 [](const CutParameter& p) { return p.name == k_segments; });
    if (!may || values.contains(k_segments)) return values;
    std::map<std::string, double> round = values;
    round[k_segments] = k_round_girdle;
    try {
        make_cut(kind.name, round);
    } catch (const InputError&) {
        return values;
    }
    return round;
}

std::string default_words(const CutParameter& p) {
    return p.name == k_segments ? fmt::format("{}, or 1 of a thin girdle", k_round_girdle)
                                : fmt::format("{}", p.value);
}

double height_of(const Solid& solid, bool crown) {
    // Crown: from the highest girdle corner to the table. Pavilion: from the culet to the lowest
    // girdle corner.
    double top = -1e300, bottom = 1e300, girdle_top = -1e300, girdle_bottom = 1e300;
    for (const Vec3& v : solid.vertices) {
        top = std::max(top, v.z);
        bottom = std::min(bottom, v.z);
    }
    for (const Facet& facet : solid.facets) {
        if (facet.name[0] != 'G') continue;
        for (int corner : facet.corners) {
            girdle_top = std::max(girdle_top, solid.vertices[corner].z);
            girdle_bottom = std::min(girdle_bottom, solid.vertices[corner].z);
        }
    }
    return crown ? top - girdle_top : girdle_bottom - bottom;
}

std::string proportions_json(const std::string& name, const Solid& solid,
                             const CutOptions& options) {
    const double along_x = width_along(solid, {1, 0, 0}), along_y = width_along(solid, {0, 1, 0});
    const double width = std::min(along_x, along_y), length = std::max(along_x, along_y);
    Solid table;
    for (int corner : solid.facets[find_facet(solid, "T")].corners)
        table.vertices.push_back(solid.vertices[corner]);
    const double table_width =
        width_along(table, along_x <= along_y ? Vec3{1, 0, 0} : Vec3{0, 1, 0});
    std::map<std::string, double> parameters = options.values;
    for (const CutParameter& p : cut_kind(name).parameters) parameters.emplace(p.name, p.value);
    const double depth = width_along(solid, {0, 0, 1});
    const double crown = height_of(solid, true), pavilion = height_of(solid, false);
    nlohmann::ordered_json json = {{"schema", 1},
                                   {"cut", name},
                                   {"parameters", parameters},
                                   {"length_mm", length},
                                   {"width_mm", width},
                                   {"depth_mm", depth},
                                   {"length_over_width", length / width},
                                   {"table_percent", 100 * table_width / width},
                                   {"crown_height_percent", 100 * crown / width},
                                   {"girdle_percent", 100 * (depth - crown - pavilion) / width},
                                   {"pavilion_depth_percent", 100 * pavilion / width},
                                   {"total_depth_percent", 100 * depth / width},
                                   {"facets", solid.facets.size()},
                                   {"vertices", solid.vertices.size()},
                                   {"edges", edge_count(solid)},
                                   {"volume_mm3", volume(solid)}};
    if (!options.form.material.empty()) {
        const Material material = catalogue_material(options.form.material);
        json["material"] = material.id;
        if (material.density_g_cm3)
            json["weight_ct"] = carat(volume(solid), *material.density_g_cm3);
    }
    return json.dump(2) + "\n";
}

void list_cuts() {
    for (const CutKind& kind : cut_kinds()) {
        fmt::print("{}: {}\n", kind.name, kind.summary);
        for (const CutParameter& p : kind.parameters) {
            fmt::print("  --{:<18} {:>7} {:<4} {} ({} to {})\n", p.name,
                       p.name == k_segments ? k_round_girdle : p.value, p.unit, p.what, p.least,
                       p.most);
        }
    }
}

// `words` are those that match no option of the cut.
[[noreturn]] void refuse(const CutKind& kind, const std::vector<std::string>& words) {
    std::vector<std::string> names;
    for (const CutParameter& p : kind.parameters) names.push_back("--" + p.name);
    const std::string word = words.front().substr(0, words.front().find('='));
    const auto near = nearest_name(word, names);
    throw InputError(fmt::format(
        "the cut {} has no \"{}\"{}; culet cut {} --help lists its parameters", kind.name, word,
        near ? fmt::format(", did you mean {}?", *near) : std::string(), kind.name));
}

int run_cut(const std::string& name, const CutOptions& options) {
    if (!options.out.empty()) require_solid_name(options.out);
    require_writable(options.out);
    require_writable(options.json);
    require_form(options.form);
    if (!options.form.readings.empty() && options.out.empty()) {
        throw InputError("--readings is a form for a mesh: give -o MESH too");
    }
    Solid solid = make_cut(name, options.values);
    if (cut_kind(name).convex) solid.design = std::make_shared<const Design>(drawn_design(solid));
    std::string proportions;
    if (!options.json.empty()) {
        // Length and width are those before the stone is turned.
        auto unturned = options.values;
        unturned["azimuth"] = 0;
        proportions = proportions_json(name, make_cut(name, unturned), options);
    }
    if (options.out.empty() && options.json.empty())
        throw InputError("name the mesh to write: -o MESH");
    if (mesh_format(options.out)) {
        write_design(solid, name, options.out);
    } else if (!options.out.empty()) {
        say_notes(options.out, write_solid(solid, options.out), options.common.quiet);
    }
    if (!options.json.empty()) write_text(options.json, proportions);
    say(fmt::format("{}: {} facets, {} vertices, total depth {:.4g} mm, volume {:.4g} mm³", name,
                    solid.facets.size(), solid.vertices.size(), width_along(solid, {0, 0, 1}),
                    volume(solid)),
        options.common.quiet || options.json == "-");
    if (options.form.readings.empty()) {
        if (!options.out.empty() && options.out != "-")
            say(fmt::format(
                    "next: culet render {0} --material diamond -o stone.png (a picture), or "
                    "culet info {0} --readings form.csv --form form.html --stone stone.toml "
                    "(a form for your readings)",
                    options.out),
                options.common.quiet);
        return exit_good;
    }
    Stone stone;
    stone.name = name;
    // STL has no names, so make the form for the mesh as it will be read.
    stone.solid = read_solid(options.out).solid;
    stone.convex = cut_kind(name).convex;
    for (const std::string& line : write_form(options.form, stone, false, options.out)) {
        say(line, options.common.quiet);
    }
    return exit_good;
}

void add_parameter(CLI::App& cut, const CutParameter& p,
                   const std::shared_ptr<CutOptions>& options) {
    // 6.5, 6.5mm, 57%: with or without the unit.
    cut.add_option_function<std::string>(
           "--" + p.name,
           [options, key = p.name, unit = p.unit](const std::string& text) {
               options->values[key] = number_in_unit(text, unit, "--" + key);
           },
           fmt::format("{}, {} to {} {}, default {}", p.what, p.least, p.most, p.unit,
                       default_words(p)))
        ->transform(CLI::Validator(
            [unit = p.unit](std::string& value) {
                value = without_unit(value, unit);
                return std::string();
            },
            ""))
        ->type_name(p.unit.empty() ? "X" : p.unit);
}

void add_cut(CLI::App& command, const CutKind& kind, int& exit_code) {
    auto options = std::make_shared<CutOptions>();
    CLI::App* cut = command.add_subcommand(kind.name, kind.summary);
    if (kind.name == "step") cut->alias("emerald");
    cut->add_option("-o,--output", options->out, "mesh or cut: .obj .off .ply .stl .asc .gem .gcs")
        ->type_name("MESH");
    cut->add_option("--json", options->json, "the resulting proportions (- is stdout)")
        ->type_name("FILE");
    cut->add_option("--material", options->form.material,
                    "for the weight in the proportions and the form, and the stone file")
        ->type_name("NAME");
    add_form_options(*cut, options->form);
    for (const CutParameter& p : kind.parameters) add_parameter(*cut, p, options);
    add_common(*cut, options->common);
    const CutParameter& first = kind.parameters.front();
    cut->footer(
        fmt::format("Examples:\n  culet cut {0} -o {0}.obj\n  culet cut {0} --{1} {2} --girdle "
                    "3 -o {0}.asc --json proportions.json",
                    kind.name, first.name, first.value));
    cut->allow_extras();  // so that a misspelt parameter is reported with the nearest
    cut->callback([kind, cut, options, &exit_code] {
        if (const auto words = cut->remaining(); !words.empty()) refuse(kind, words);
        options->values = with_round_girdle(kind, options->values);
        exit_code = run_cut(kind.name, *options);
    });
}

}  // namespace

void add_command_cut(CLI::App& program, int& exit_code) {
    CLI::App* command =
        program.add_subcommand("cut", "a standard cut by its proportions, as a starting mesh");
    auto list = std::make_shared<bool>(false);
    auto unknown = std::make_shared<std::vector<std::string>>();
    command->add_flag("--list", *list, "the cuts, their parameters, defaults and ranges");
    command->require_subcommand(0, 1);
    command->allow_extras();  // of an unknown cut: its name is reported first
    // An unknown cut is reported with the nearest name.
    command->add_option("name", *unknown, "round-brilliant, step (emerald), princess, oval, ...")
        ->type_name("NAME");
    command->footer(
        "Examples:\n"
        "  culet cut round-brilliant --table 57 --crown-angle 34.5 -o brilliant.obj\n"
        "  culet cut emerald --ratio 1.5 -o emerald.asc --json proportions.json --material "
        "emerald\n"
        "  culet cut oval --width 6.5mm -o oval.obj --readings form.csv --stone stone.toml");
    for (const CutKind& kind : cut_kinds()) add_cut(*command, kind, exit_code);
    command->callback([command, list, unknown] {
        if (!command->get_subcommands().empty()) return;
        if (*list) return list_cuts();
        if (unknown->empty()) throw InputError("name a cut; culet cut --list shows them");
        cut_kind(unknown->front());  // throws with the nearest name
        throw InputError(
            fmt::format("write the cut before its options: culet cut {} ...", unknown->front()));
    });
}

}  // namespace culet
