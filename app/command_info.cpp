// culet info FILE: what a file holds, and what is wrong with it.

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/options.h"
#include "app/solid_input.h"
#include "app/terminal.h"
#include "stone/checks.h"
#include "stone/errors.h"
#include "stone/output_file.h"
#include "stone/proportions.h"
#include "stone/stone.h"
#include "stone/units.h"

namespace culet {

namespace {

using Json = nlohmann::ordered_json;

struct InfoOptions {
    CommonOptions common;
    std::filesystem::path file, json;
    CutReading cut;
    bool may_be_concave = false;
};

/// The same for every kind of file: lines for people, an object for programs, and faults.
struct Description {
    std::vector<std::string> lines, notes;
    Json object;
    std::vector<Fault> faults;
};

void describe_facets(const Solid& solid, Description& about, bool table) {
    Json list = Json::array();
    if (table) {
        about.lines.push_back(fmt::format("{:<12} {:>8} {:>12} {:>10} {:>14} {:>12}", "facet",
                                          "corners", "inclination", "azimuth", "offset", "area"));
    }
    for (const Facet& facet : solid.facets) {
        const Vec3& n = facet.plane.normal;
        const double tilt = degrees(inclination(n, {0, 0, 1})), turn = degrees(azimuth(n));
        const double size = area(solid, facet);
        list.push_back({{"name", facet.name},
                        {"normal", {n.x, n.y, n.z}},
                        {"offset", facet.plane.offset},
                        {"inclination", tilt},
                        {"azimuth", turn},
                        {"area", size},
                        {"corners", facet.corners.size()}});
        if (table) {
            about.lines.push_back(
                fmt::format("{:<12} {:>8} {:>12.4f} {:>10.4f} {:>14.8g} {:>12.6g}", facet.name,
                            facet.corners.size(), tilt, turn, facet.plane.offset, size));
        }
    }
    about.object["facet_list"] = std::move(list);
}

void describe_proportions(const Solid& solid, Description& about) {
    const Proportions p = proportions(solid);
    if (!(p.width > 0)) return;
    Json& object = about.object;
    object["w"] = p.width;
    object["l"] = p.length;
    object["l_w"] = p.length / p.width;
    object["t_w"] = p.table_length ? Json(*p.table_length / p.width) : Json();
    object["u_w"] = p.table_width ? Json(*p.table_width / p.width) : Json();
    object["p_w"] = p.pavilion / p.width;
    object["c_w"] = p.crown / p.width;
    object["h_w"] = p.height / p.width;
    std::string line = fmt::format("W {:.6g}, L/W {:.4f}", p.width, p.length / p.width);
    if (p.table_length && p.table_width) {
        line += fmt::format(", T/W {:.4f}, U/W {:.4f}", *p.table_length / p.width,
                            *p.table_width / p.width);
    }
    line += fmt::format(", P/W {:.4f}, C/W {:.4f}, H/W {:.4f}", p.pavilion / p.width,
                        p.crown / p.width, p.height / p.width);
    about.lines.push_back(line);
}

void describe_sheet(const CutSheet& sheet, Description& about) {
    Json& object = about.object;
    object["gear"] = sheet.gear;
    object["gear_offset"] = sheet.gear_offset;
    object["symmetry"] = sheet.symmetry;
    object["mirror"] = sheet.mirror;
    object["refractive_index"] = sheet.refractive_index ? Json(*sheet.refractive_index) : Json();
    object["headings"] = sheet.headings;
    object["footnotes"] = sheet.footnotes;
    for (const std::string& line : sheet.headings) about.lines.push_back(line);
    about.lines.push_back(fmt::format(
        "gear {:g}, index {:g} at azimuth zero, {}-fold{}{}", sheet.gear, sheet.gear_offset,
        sheet.symmetry, sheet.mirror ? ", mirrored" : "",
        sheet.refractive_index ? fmt::format(", refractive index {:g}", *sheet.refractive_index)
                               : ""));
}

Description describe_solid_file(const InfoOptions& options) {
    SolidInput input = load_solid(options.file, options.cut);
    const Solid& solid = input.solid;
    Description about;
    about.notes = input.notes;
    Json& object = about.object;
    object["format"] = input.format;
    const int facets = static_cast<int>(solid.facets.size());
    const int vertices = static_cast<int>(solid.vertices.size());
    const bool closed = is_closed(solid), convex = is_convex(solid);
    object["facets"] = facets;
    object["vertices"] = vertices;
    object["edges"] = edge_count(solid);
    object["euler"] = vertices - edge_count(solid) + facets;
    const Vec3 size(width_along(solid, {1, 0, 0}), width_along(solid, {0, 1, 0}),
                    width_along(solid, {0, 0, 1}));
    object["size"] = {size.x, size.y, size.z};
    object["diameter"] = diameter(solid);
    double whole_area = 0;
    for (const Facet& facet : solid.facets) whole_area += area(solid, facet);
    object["volume"] = volume(solid);
    object["area"] = whole_area;
    object["closed"] = closed;
    object["convex"] = convex;
    object["planarity_max"] = planarity(solid);

    about.lines.push_back(fmt::format("{}: {}, {} facets, {} vertices, {} edges (Euler number {})",
                                      options.file.string(), input.format, facets, vertices,
                                      edge_count(solid), vertices - edge_count(solid) + facets));
    about.lines.push_back(fmt::format("size {:.8g} x {:.8g} x {:.8g}, volume {:.8g}, area {:.8g}",
                                      size.x, size.y, size.z, volume(solid), whole_area));
    about.lines.push_back(fmt::format("{}, {}, corners up to {:.2g} off their planes",
                                      closed ? "closed" : "not closed",
                                      convex ? "convex" : "not convex", planarity(solid)));
    describe_proportions(solid, about);
    if (input.sheet) describe_sheet(*input.sheet, about);
    describe_facets(solid, about, options.common.verbose);

    about.faults = find_faults(
        solid, {.planarity = k_largest_miss, .must_be_convex = !options.may_be_concave});
    for (const std::string& place : input.unused_planes) {
        about.faults.push_back({FaultKind::missing_facet, place + " bounds nothing"});
    }
    for (const std::string& place : input.repeated_planes) {
        about.faults.push_back({FaultKind::repeated_plane, place + " repeats an earlier plane"});
    }
    return about;
}

Description describe(const InfoOptions& options) {
    if (is_solid_file(options.file)) return describe_solid_file(options);
    throw InputError(options.file,
                     "is of an unknown kind: info reads .obj, .off, .ply, .stl, .asc "
                     "and .gem");
}

int info(const InfoOptions& options) {
    Description about = describe(options);
    Json object{{"schema", 1}, {"file", options.file.string()}};
    object.update(about.object);
    object["notes"] = about.notes;
    object["faults"] = Json::array();
    for (const Fault& fault : about.faults) {
        object["faults"].push_back({{"kind", name_of(fault.kind)}, {"what", fault.what}});
    }
    const bool json_on_stdout = options.json == "-";
    if (!json_on_stdout) {
        for (const std::string& line : about.lines) fmt::print("{}\n", line);
        for (const std::string& note : about.notes) fmt::print("note: {}\n", note);
        for (const Fault& fault : about.faults) {
            fmt::print("fault: {}: {}\n", name_of(fault.kind), fault.what);
        }
        std::fflush(stdout);
    }
    if (!options.json.empty()) {
        write_text(options.json, object.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
    }
    return about.faults.empty() ? exit_good : exit_untrusted;
}

}  // namespace

void add_command_info(CLI::App& program, int& exit_code) {
    auto options = std::make_shared<InfoOptions>();
    CLI::App* command =
        program.add_subcommand("info", "what a file holds, and what is wrong with it");
    command->add_option("FILE", options->file, "mesh (.obj .off .ply .stl) or cut (.asc .gem)")
        ->required();
    command->add_option("--json", options->json, "write one object there (-: stdout)")
        ->type_name("FILE");
    command
        ->add_option("--meet-tolerance", options->cut.meet_tolerance,
                     "meets of a cut that miss by less than this fraction of its width become one "
                     "corner (0: none)")
        ->check(CLI::Range(0.0, 0.1))
        ->type_name("FRACTION")
        ->capture_default_str();
    command->add_flag("--may-be-concave", options->may_be_concave, "a dented stone is no fault");
    add_common(*command, options->common);
    command->footer(
        "-v lists every facet. Exit code 1 when there are faults.\n"
        "Examples:\n"
        "  culet info design.asc\n"
        "  culet info hand.obj -v --json hand.json");
    command->callback([options, &exit_code] { exit_code = info(*options); });
}

}  // namespace culet
