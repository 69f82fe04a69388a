#include <fmt/format.h>

#include "app/describe/describe.h"
#include "app/input/readings_form.h"
#include "stone/design/cutting_list.h"
#include "stone/design/proportions.h"
#include "stone/numbers/units.h"
#include "stone/solid/caliper.h"
#include "stone/solid_input.h"
#include "stone/stone.h"
#include "stone/upright.h"

namespace culet {

namespace {

using Json = nlohmann::ordered_json;

void describe_facets(const Solid& solid, bool table, Description& about) {
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
    const CaliperWidths widths = caliper_widths(solid);
    object["caliper"] = {{"min", widths.least},
                         {"max", widths.largest},
                         {"mean", widths.mean},
                         {"min_azimuth", degrees(widths.least_azimuth)},
                         {"max_azimuth", degrees(widths.largest_azimuth)},
                         {"corners", widths.outline.size()}};
    about.lines.push_back(fmt::format(
        "caliper {:.4g} (azimuth {:.4g}) to {:.4g} (azimuth {:.4g}), mean {:.4g}{}", widths.least,
        degrees(widths.least_azimuth), widths.largest, degrees(widths.largest_azimuth), widths.mean,
        widths.round() ? fmt::format("; the outline has {} corners", widths.outline.size())
                       : std::string()));
}

void describe_cutting(const Solid& solid, const CuttingOptions& options, Description& about) {
    const double gear = gear_of(solid, options), width = proportions(solid).width;
    Json list = Json::array();
    about.lines.push_back(
        fmt::format("{:<8} {:<9} {:>16}  index of {:g}", "tier", "part", "angle", gear));
    for (const CuttingStep& step : cutting_list(solid, options)) {
        Json settings = Json::array();
        for (const IndexSetting& setting : step.settings) {
            Json teeth = Json::array();
            for (const IndexSetting::Tooth& tooth : setting.teeth) teeth.push_back(tooth.tooth);
            settings.push_back({{"cheater", setting.cheater}, {"teeth", teeth}});
        }
        list.push_back({{"tier", step.tier},
                        {"part", name_of(step.part)},
                        {"angle", step.angle_deg},
                        {"angle_min", step.least_angle_deg},
                        {"angle_max", step.most_angle_deg},
                        {"indices", step.indices},
                        {"settings", settings},
                        {"instruction", step.instruction},
                        {"cut_to", depth_words(step, {}, width)}});
        const bool alike = step.most_angle_deg - step.least_angle_deg < 0.005;
        about.lines.push_back(fmt::format(
            "{:<8} {:<9} {:>16}  {}", step.tier, name_of(step.part),
            alike ? fmt::format("{:.2f}", step.angle_deg)
                  : fmt::format("{:.2f} to {:.2f}", step.least_angle_deg, step.most_angle_deg),
            index_words(step)));
    }
    about.object["gear"] = gear;
    about.object["cutting_list"] = std::move(list);
}

void describe_design(const Design& design, Description& about) {
    Json& object = about.object;
    object["gear"] = design.gear;
    object["gear_supposed"] = design.gear_supposed;
    object["gear_offset"] = design.gear_offset;
    object["symmetry"] = design.symmetry;
    object["mirror"] = design.mirror;
    object["refractive_index"] = design.refractive_index ? Json(*design.refractive_index) : Json();
    object["headings"] = design.headings;
    object["footnotes"] = design.footnotes;
    if (!design.studio.empty()) object["gem_cut_studio"] = design.studio;
    for (const std::string& line : design.headings) {
        if (!line.empty()) about.lines.push_back(line);
    }
    about.lines.push_back(fmt::format(
        "gear {:g}{}, index {:g} at azimuth zero, {}-fold{}{}", design.gear,
        design.gear_supposed ? " (supposed)" : "", design.gear_offset, design.symmetry,
        design.mirror ? ", mirrored" : "",
        design.refractive_index ? fmt::format(", refractive index {:g}", *design.refractive_index)
                                : ""));
}

}  // namespace

void describe_solid(const Solid& solid, bool must_be_convex, bool facet_table, Description& about) {
    Json& object = about.object;
    const int facets = static_cast<int>(solid.facets.size());
    const int vertices = static_cast<int>(solid.vertices.size());
    const int edges = edge_count(solid), euler = vertices - edges + facets;
    const bool closed = is_closed(solid), convex = is_convex(solid);
    const Vec3 size(width_along(solid, {1, 0, 0}), width_along(solid, {0, 1, 0}),
                    width_along(solid, {0, 0, 1}));
    double whole_area = 0;
    for (const Facet& facet : solid.facets) whole_area += area(solid, facet);
    object["facets"] = facets;
    object["vertices"] = vertices;
    object["edges"] = edges;
    object["euler"] = euler;
    object["size"] = {size.x, size.y, size.z};
    object["diameter"] = diameter(solid);
    object["volume"] = volume(solid);
    object["area"] = whole_area;
    object["closed"] = closed;
    object["convex"] = convex;
    object["planarity_max"] = planarity(solid);

    about.lines.push_back(fmt::format("{} facets, {} vertices, {} edges (Euler number {})", facets,
                                      vertices, edges, euler));
    about.lines.push_back(fmt::format("size {:.8g} x {:.8g} x {:.8g}, volume {:.8g}, area {:.8g}",
                                      size.x, size.y, size.z, volume(solid), whole_area));
    about.lines.push_back(fmt::format("{}, {}, corners up to {:.2g} off their planes",
                                      closed ? "closed" : "not closed",
                                      convex ? "convex" : "not convex", planarity(solid)));
    describe_proportions(solid, about);
    describe_facets(solid, facet_table, about);
    // The meets of real designs miss, and other programs' meshes are rounded: neither is a fault of
    // the file.
    const std::vector<Fault> faults =
        find_faults(solid, {.planarity = k_largest_miss, .must_be_convex = must_be_convex});
    about.faults.insert(about.faults.end(), faults.begin(), faults.end());
}

Description describe_solid_file(const DescribeOptions& options) {
    SolidInput input = load_solid(options.file, options.cut);
    if (options.width_mm > 0) scale_to_width(input.solid, options.width_mm);
    Description about;
    about.notes = input.notes;
    about.notes.insert(about.notes.end(), input.details.begin(), input.details.end());
    about.object["format"] = input.format;
    about.object["changed"] = input.changed;
    about.lines.push_back(fmt::format("{}: {}", options.file.string(), input.format));
    if (input.solid.design) describe_design(*input.solid.design, about);
    describe_solid(input.solid, !options.may_be_concave, options.facet_table, about);
    describe_measures(input.solid, options, about);
    if (options.cutting_list) {
        describe_cutting(input.solid, options.cutting, about);
        if (std::string ask = question_of_up(input.solid); !ask.empty() && !input.solid.design)
            about.notes.push_back(std::move(ask));
    }
    for (const std::string& place : input.unused_planes) {
        about.faults.push_back({FaultKind::missing_facet, place + " bounds nothing"});
    }
    for (const std::string& place : input.repeated_planes) {
        about.faults.push_back({FaultKind::repeated_plane, place + " repeats an earlier plane"});
    }
    return about;
}

}  // namespace culet
