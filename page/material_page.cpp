#include "page/material_page.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "page/html.h"
#include "page/json_fields.h"
#include "page/parts.h"

namespace culet {

namespace {

using Json = nlohmann::ordered_json;  // rays in their order

std::string colour_cell(const Json& material) {
    const auto found = material.find("colour");
    if (found == material.end() || !found->is_object()) {
        const std::string usual = text_at(material, "usual_colour");
        return usual.empty()
                   ? "colourless"
                   : "<strong>no spectrum</strong>: drawn colourless; usually " + escaped(usual);
    }
    std::string lab;
    for (const Json& value : array_at(*found, "lab")) {
        if (value.is_number()) lab += (lab.empty() ? "" : ", ") + decimals(value.get<double>(), 0);
    }
    return fmt::format(
        "<span class=\"swatch large\" style=\"background:{}\"></span>{}<br><small>L* a* b* "
        "{}</small>",
        escaped(text_at(*found, "srgb")), escaped(text_at(*found, "name")), lab);
}

std::string index_cell(const Json& material) {
    std::string cell;
    const auto indices = material.find("index_589nm");
    if (indices == material.end() || !indices->is_object()) return cell;
    for (const auto& [ray, n] : indices->items()) {
        if (!n.is_number()) continue;
        cell += (cell.empty() ? "" : "<br>") + (ray == "n" ? std::string() : escaped(ray) + " ") +
                decimals(n.get<double>(), 3);
    }
    return cell;
}

std::string source_cell(const Json& material) {
    std::string cell = "index: " + escaped(text_at(material, "source"));
    const std::string colour = text_at(material, "absorption_source");
    if (!colour.empty()) {
        cell += "<br>colour (" + escaped(text_at(material, "absorption_confidence")) +
                "): " + escaped(colour);
    }
    const std::string depth = text_at(material, "absorption_depth");
    if (!depth.empty()) cell += "<br>depth: " + escaped(depth);
    return "<details><summary>sources</summary><small>" + cell + "</small></details>";
}

}  // namespace

std::string material_page(const std::string& text, const std::string& version) {
    const Json json = parsed_object<Json>(text, "the list of materials");
    std::string rows;
    for (const Json& material : array_at(json, "materials")) {
        rows += fmt::format(
            "<tr><th scope=\"row\">{}<small>{}</small></th><td>{}</td><td class=\"n\">{}</td>"
            "<td class=\"n\">{}</td><td class=\"n\">{}</td><td>{}</td></tr>\n",
            escaped(text_at(material, "id")), escaped(text_at(material, "name")),
            colour_cell(material), index_cell(material),
            decimals(number_at(material, "birefringence"), 3),
            decimals(number_at(material, "density"), 2), source_cell(material));
    }
    const std::string head =
        "<th>name</th><th>colour</th><th class=\"n\">index (589 nm)</th><th "
        "class=\"n\">birefringence</th><th class=\"n\">density g/cm\u00b3</th><th></th>";
    const std::string words = fmt::format(
        "<p>Colours are those of daylight (D65) after {} mm of the material, the mean way of the "
        "light through a brilliant of {} mm: without reflexes, without fluorescence, and as the "
        "screen can show them. A larger stone of the same material is deeper.</p>\n",
        decimals(number_at(json, "light_path_mm"), 1), significant(number_at(json, "width_mm")));
    return html_page(
        "Materials",
        fmt::format("<header><h1>Materials</h1><p>culet {}</p></header>\n", escaped(version)) +
            section("materials", "The catalogue",
                    words + table("Materials and coloured varieties", head, rows)),
        text);
}

}  // namespace culet
