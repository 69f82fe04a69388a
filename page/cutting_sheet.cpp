#include "page/cutting_sheet.h"

#include <fmt/format.h>

#include <cmath>

#include "page/drawing.h"
#include "page/html.h"
#include "page/parts.h"
#include "page/quantity.h"
#include "page/template.h"
#include "page/templates.h"
#include "stone/proportions.h"

namespace culet {

namespace {

using SheetRow = std::pair<std::string, std::string>;

// As fine as a machine is read: a hundredth of a degree.
constexpr double k_alike_deg = 0.005;
constexpr int k_places = 2;

std::string angle_text(const CuttingSheet& sheet, std::size_t step) {
    const CuttingStep& cut = sheet.steps[step];
    const double sigma = step < sheet.sigmas_deg.size() ? sheet.sigmas_deg[step] : 0;
    std::string text = sigma > 0 ? quantity(cut.angle_deg, sigma, "", k_places)
                                 : decimals(cut.angle_deg, k_places);
    if (cut.most_angle_deg - cut.least_angle_deg >= k_alike_deg)
        text += fmt::format(" ({:.2f} to {:.2f})", cut.least_angle_deg, cut.most_angle_deg);
    return text;
}

std::vector<SheetRow> proportion_rows(const CuttingSheet& sheet) {
    const Proportions of = proportions(sheet.solid);
    const auto length = [&](double value) {
        return fmt::format("{:.4g}{}{}", value, sheet.unit.empty() ? "" : " ", sheet.unit);
    };
    const auto share = [&](double value) { return fmt::format("{:.4f}", value / of.width); };
    std::vector<SheetRow> rows{{"width W", length(of.width)},
                               {"length L", length(of.length)},
                               {"height H", length(of.height)}};
    rows.emplace_back("L/W", share(of.length));
    if (of.table_width) rows.emplace_back("table T/W", share(*of.table_width));
    if (of.table_length && of.length - of.width > 1e-3 * of.width)
        rows.emplace_back("table's length U/W", share(*of.table_length));
    rows.emplace_back("crown C/W", share(of.crown));
    rows.emplace_back("pavilion P/W", share(of.pavilion));
    rows.emplace_back("girdle, thinnest, over W", share(least_girdle(sheet.solid)));
    rows.emplace_back("height H/W", share(of.height));
    const double cube = of.width * of.width * of.width;
    rows.emplace_back("volume over W³", fmt::format("{:.4f}", volume(sheet.solid) / cube));
    return rows;
}

std::string about_text(const CuttingSheet& sheet) {
    std::string text = fmt::format("Index wheel of {:g} teeth; {} facets", std::abs(sheet.gear),
                                   sheet.solid.facets.size());
    if (sheet.refractive_index)
        text += fmt::format("; refractive index {:g}", *sheet.refractive_index);
    text += ". Angles in degrees from the girdle's plane";
    if (!sheet.sigmas_deg.empty()) text += ", with one standard uncertainty";
    return text + ".";
}

}  // namespace

std::string cutting_sheet_page(const CuttingSheet& sheet) {
    std::vector<View> views, steps, rows;
    for (const ViewSide side : {ViewSide::crown, ViewSide::pavilion, ViewSide::girdle}) {
        std::string svg = draw_facets_svg(sheet.solid, side);
        if (!svg.empty())
            views.push_back({{"wide", side == ViewSide::girdle},
                             {"drawing_svg", std::move(svg)},
                             {"caption", caption_of(side)}});
    }
    for (std::size_t i = 0; i < sheet.steps.size(); ++i) {
        const CuttingStep& step = sheet.steps[i];
        steps.push_back({{"number", fmt::format("{}", i + 1)},
                         {"tier", step.tier},
                         {"part", name_of(step.part)},
                         {"angle", angle_text(sheet, i)},
                         {"indices", index_settings(step, sheet.gear)},
                         {"depth", depth_words(step.depth)}});
    }
    for (const auto& [name, value] : proportion_rows(sheet))
        rows.push_back({{"name", name}, {"value", value}});
    std::vector<View> headings;
    for (const std::string& line : sheet.headings) {
        if (!line.empty()) headings.emplace_back(line);
    }
    return html_page(sheet.name + ", cutting sheet",
                     filled(templates::cutting_sheet, {{"name", sheet.name},
                                                       {"version", sheet.version},
                                                       {"headings", headings},
                                                       {"about", about_text(sheet)},
                                                       {"views", views},
                                                       {"steps", steps},
                                                       {"proportions", rows}}));
}

std::string cutting_sheet_text(const CuttingSheet& sheet) {
    std::string text = sheet.name + "\n";
    for (const std::string& line : sheet.headings) {
        if (!line.empty()) text += line + "\n";
    }
    text += about_text(sheet) + "\n\n";
    std::size_t tier = 4, angle = 5, depth = 6;
    for (std::size_t i = 0; i < sheet.steps.size(); ++i) {
        tier = std::max(tier, sheet.steps[i].tier.size());
        angle = std::max(angle, plain_signs(angle_text(sheet, i)).size());
        depth = std::max(depth, depth_words(sheet.steps[i].depth).size());
    }
    text += fmt::format(" no  {:<{}}  part      {:>{}}  {:<{}}  index settings\n", "tier", tier,
                        "angle", angle, "cut to", depth);
    for (std::size_t i = 0; i < sheet.steps.size(); ++i) {
        const CuttingStep& step = sheet.steps[i];
        text += fmt::format("{:>3}  {:<{}}  {:<8}  {:>{}}  {:<{}}  {}\n", i + 1, step.tier, tier,
                            name_of(step.part), plain_signs(angle_text(sheet, i)), angle,
                            depth_words(step.depth), depth, index_settings(step, sheet.gear));
    }
    text += "\n";
    for (const auto& [name, value] : proportion_rows(sheet))
        text += fmt::format("{:<26}{:>12}\n", name == "volume over W³" ? "volume over W^3" : name,
                            value);
    return text;
}

}  // namespace culet
