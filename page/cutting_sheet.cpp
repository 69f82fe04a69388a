#include "page/cutting_sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string_view>

#include "page/drawing.h"
#include "page/html.h"
#include "page/parts.h"
#include "page/quantity.h"
#include "page/template.h"
#include "page/templates.h"
#include "stone/design/proportions.h"

namespace culet {

namespace {

using NamedText = std::pair<std::string, std::string>;

constexpr int k_places = 2;
constexpr std::size_t k_columns = 80;

// As GemCad heads its sheets.
std::string side_of(const SheetRow& row) {
    return row.part == "crown" || row.part == "table" ? "Crown" : "Pavilion";
}

std::string upper_case(std::string text) {
    for (char& c : text) c = char(std::toupper(static_cast<unsigned char>(c)));
    return text;
}

// Breaks behind blanks and hyphens; a longer word where it must.
std::vector<std::string> lines_of(std::string_view text, std::size_t width) {
    std::vector<std::string> lines;
    while (text.size() > width) {
        std::size_t end = text.find_last_of(" -", width);
        // A blank may stand behind the last column, a hyphen may not.
        if (end == width && text[end] == '-') end = text.find_last_of(" -", width - 1);
        if (end == std::string_view::npos || end == 0) {
            end = width;
            while (end > 1 && (static_cast<unsigned char>(text[end]) & 0xc0) == 0x80) --end;
        } else if (text[end] == '-') {
            ++end;
        }
        lines.emplace_back(text.substr(0, end));
        text.remove_prefix(std::min(text.find_first_not_of(' ', end), text.size()));
    }
    lines.emplace_back(text);
    return lines;
}

std::string angle_text(const CuttingSheet& sheet, std::size_t step) {
    const double sigma = step < sheet.sigmas_deg.size() ? sheet.sigmas_deg[step] : 0;
    const double angle = sheet.steps[step].angle_deg;
    return sigma > 0 ? quantity(angle, sigma, "", k_places) : decimals(angle, k_places);
}

std::vector<NamedText> proportion_rows(const CuttingSheet& sheet) {
    const Proportions of = proportions(sheet.solid);
    const auto length = [&](double value) {
        return fmt::format("{:.4g}{}{}", value, sheet.unit.empty() ? "" : " ", sheet.unit);
    };
    const auto share = [&](double value) { return fmt::format("{:.4f}", value / of.width); };
    std::vector<NamedText> rows{{"width W", length(of.width)},
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

// Explanations of the words that this sheet uses.
std::vector<std::string> word_notes(const CuttingSheet& sheet) {
    std::vector<std::string> notes{
        "\"meet A, B\": until the facet reaches the corner that A and B make."};
    const auto any = [&](auto holds) {
        return std::any_of(sheet.steps.begin(), sheet.steps.end(), holds);
    };
    const auto to = [&](CutDepth::To what) {
        return any([&](const CuttingStep& step) { return step.depth.to == what; });
    };
    if (to(CutDepth::To::leave))
        notes.emplace_back("\"leave 0.20 of A\": until a facet of A is 0.20 at its widest.");
    if (to(CutDepth::To::point) || to(CutDepth::To::distance))
        notes.emplace_back(
            "\"from the girdle\": along the axis from its edge; \"from the middle\": square to the "
            "facet from the middle of the girdle's plane, for the height of the mast.");
    const bool cheats = any([](const CuttingStep& step) {
        return std::any_of(step.settings.begin(), step.settings.end(),
                           [](const IndexSetting& own) { return own.cheater != 0; });
    });
    if (cheats)
        notes.push_back(fmt::format(
            "Cheater: in teeth of {:.3g} degrees, added to the index for the facets before it.",
            360 / sheet.teeth));
    for (const std::string& line : sheet.design.footnotes) {
        if (!line.empty()) notes.push_back(line);
    }
    return notes;
}

Solid named_by_tiers(const CuttingSheet& sheet) {
    Solid solid = sheet.solid;
    for (const CuttingStep& step : sheet.steps) {
        for (const int f : step.facets) solid.facets[std::size_t(f)].name = step.tier;
    }
    return solid;
}

IndexWheel wheel_of(const CuttingSheet& sheet) {
    const double factor = sheet.teeth / std::abs(sheet.design.gear);
    return {factor * sheet.design.gear, factor * sheet.design.gear_offset};
}

}  // namespace

std::vector<SheetRow> sheet_rows(const CuttingSheet& sheet) {
    std::vector<SheetRow> rows;
    const double width = proportions(sheet.solid).width;
    for (std::size_t i = 0; i < sheet.steps.size(); ++i) {
        const CuttingStep& step = sheet.steps[i];
        std::string depth = depth_words(step, sheet.unit, width);
        if (!depth.empty()) depth[0] = char(std::toupper(static_cast<unsigned char>(depth[0])));
        rows.push_back({step.tier, name_of(step.part), angle_text(sheet, i),
                        printed_indices(step, sheet.teeth), std::move(depth)});
    }
    return rows;
}

std::string about_sheet(const CuttingSheet& sheet) {
    const Design& design = sheet.design;
    std::string text = fmt::format("{} facets", facet_count_words(sheet.solid));
    if (design.symmetry > 1) {
        text += fmt::format("; {}-fold{} symmetry", design.symmetry,
                            design.mirror ? ", mirror-image" : "");
    } else if (design.mirror) {
        text += "; mirror-image symmetry";
    }
    text += fmt::format("; index wheel of {:g} teeth", sheet.teeth);
    if (design.refractive_index)
        text += fmt::format("; refractive index {:g}", *design.refractive_index);
    text += ". Angles in degrees from the girdle's plane";
    if (!sheet.sigmas_deg.empty()) text += ", with one standard uncertainty";
    if (sheet.unit.empty()) text += "; lengths in widths W (in mm with --width)";
    return text + ".";
}

std::string cutting_sheet_page(const CuttingSheet& sheet) {
    std::vector<View> views, steps, rows;
    const Solid named = named_by_tiers(sheet);
    for (const ViewSide side : {ViewSide::crown, ViewSide::pavilion, ViewSide::girdle}) {
        std::string svg = draw_facets_svg(named, side, {}, wheel_of(sheet));
        if (!svg.empty())
            views.push_back({{"drawing_svg", std::move(svg)}, {"caption", caption_of(side)}});
    }
    std::string last;
    for (const SheetRow& row : sheet_rows(sheet)) {
        const std::string side = side_of(row);
        steps.push_back({{"number", fmt::format("{}", steps.size() + 1)},
                         {"heading", side == last ? "" : side},
                         {"tier", row.tier},
                         {"angle", row.angle},
                         {"indices", row.indices},
                         {"depth", row.depth}});
        last = side;
    }
    for (const auto& [name, value] : proportion_rows(sheet))
        rows.push_back({{"name", name}, {"value", value}});
    std::vector<View> headings, notes;
    for (const std::string& note : word_notes(sheet)) notes.emplace_back(note);
    for (const std::string& line : sheet.design.headings) {
        if (!line.empty()) headings.emplace_back(line);
    }
    return html_page(sheet.name + ", cutting sheet",
                     filled(templates::cutting_sheet, {{"name", sheet.name},
                                                       {"version", sheet.version},
                                                       {"headings", headings},
                                                       {"about", about_sheet(sheet)},
                                                       {"views", views},
                                                       {"steps", steps},
                                                       {"notes", notes},
                                                       {"proportions", rows}}));
}

std::string cutting_sheet_text(const CuttingSheet& sheet) {
    std::string text;
    const auto add = [&](const std::string& words) {
        for (const std::string& line : lines_of(words, k_columns)) text += line + "\n";
    };
    add(sheet.name);
    for (const std::string& line : sheet.design.headings) {
        if (!line.empty()) add(line);
    }
    add(about_sheet(sheet));
    std::vector<SheetRow> steps = sheet_rows(sheet);
    std::size_t tier = 4, angle = 5, index = 5;
    for (SheetRow& row : steps) {
        row.angle = plain_signs(row.angle);
        tier = std::max(tier, std::min<std::size_t>(row.tier.size(), 12));
        angle = std::max(angle, row.angle.size());
        index = std::max(index, row.indices.size());
    }
    const std::size_t before = 3 + 2 + tier + 2 + angle + 2;
    index = std::min(index, (k_columns - before) / 2);
    std::string side;
    for (std::size_t i = 0; i < steps.size(); ++i) {
        const SheetRow& row = steps[i];
        if (side != side_of(row)) text += "\n" + upper_case(side_of(row)) + "\n";
        side = side_of(row);
        const auto names = lines_of(row.tier, tier), teeth = lines_of(row.indices, index),
                   depth = lines_of(row.depth, k_columns - before - index - 2);
        for (std::size_t l = 0; l < std::max({names.size(), teeth.size(), depth.size()}); ++l) {
            const auto at = [&](const auto& list) { return l < list.size() ? list[l] : ""; };
            std::string line = fmt::format(
                "{:>3}  {:<{}}  {:>{}}  {:<{}}  {}", l == 0 ? fmt::format("{}", i + 1) : "",
                at(names), tier, l == 0 ? row.angle : "", angle, at(teeth), index, at(depth));
            line.erase(line.find_last_not_of(' ') + 1);
            text += line + "\n";
        }
    }
    text += "\n";
    for (const std::string& note : word_notes(sheet)) add(note);
    text += "\n";
    for (const auto& [name, value] : proportion_rows(sheet))
        text += fmt::format("{:<26}{:>12}\n", name == "volume over W³" ? "volume over W^3" : name,
                            value);
    return text;
}

}  // namespace culet
