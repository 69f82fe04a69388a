#include "page/fit_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "page/fit_fields.h"
#include "page/fit_paint.h"
#include "page/html.h"
#include "page/parts.h"

namespace culet {

namespace {

using Json = nlohmann::json;

std::string joined(const std::vector<std::string>& names) {
    std::string result;
    for (const std::string& name : names) result += (result.empty() ? "" : " / ") + name;
    return result;
}

// A bar from the middle: -4 .. 4 standard uncertainties.
std::string residual_bar(double normalized) {
    const double size = std::min(std::abs(normalized) / k_worst_shown, 1.0);
    const double length = 50 * size, from = normalized < 0 ? 50 - length : 50;
    return fmt::format(
        "<svg class=\"residual\" viewBox=\"0 0 100 12\" aria-hidden=\"true\"><line class=\"axis\" "
        "x1=\"50\" y1=\"0\" x2=\"50\" y2=\"12\"/><rect x=\"{:.1f}\" y=\"2\" width=\"{:.1f}\" "
        "height=\"8\" style=\"fill:{}\"/></svg>",
        from, std::max(length, 0.6), css_colour(ColourMap::residual, size));
}

}  // namespace

std::string facets_table(const Json& fit, const std::string& unit) {
    std::vector<std::string> names;
    for (const Json& facet : array_at(fit, "facets")) names.push_back(text_at(facet, "name"));
    if (names.empty()) return {};
    const std::vector<Worst> worst = worst_readings(fit, names);
    std::string rows;
    std::size_t f = 0;
    for (const Json& facet : array_at(fit, "facets")) {
        const auto pair = [&](const char* key, const char* sigma, int places) {
            return fmt::format("<td class=\"n\">{} <small>± {}</small></td>",
                               decimals(number_at(facet, key), places),
                               significant(number_at(facet, sigma), 2));
        };
        const double size = std::abs(worst[f].normalized);
        const std::string swatch =
            worst[f].reading.empty()
                ? "<span class=\"swatch\"></span>"
                : fmt::format("<span class=\"swatch\" style=\"background:{}\"></span>",
                              css_colour(ColourMap::residual, size / k_worst_shown));
        rows += fmt::format(
            "<tr><th scope=\"row\">{}{}</th>{}{}{}<td class=\"n\">{}</td><td class=\"n\">{}</td>"
            "</tr>\n",
            swatch, escaped(names[f]), pair("inclination", "sigma_inclination", 3),
            pair("azimuth", "sigma_azimuth", 3), pair("offset", "sigma_offset", 4), worst[f].count,
            worst[f].reading.empty() ? "–"
                                     : decimals(worst[f].normalized, 2) + " <small>" +
                                           escaped(worst[f].reading) + "</small>");
        ++f;
    }
    return table("Facets as fitted",
                 fmt::format("<th scope=\"col\">Facet</th><th scope=\"col\" class=\"n\">"
                             "Inclination, °</th><th scope=\"col\" class=\"n\">Azimuth, °</th>"
                             "<th scope=\"col\" class=\"n\">Offset, {}</th><th scope=\"col\" "
                             "class=\"n\">Readings</th><th scope=\"col\" class=\"n\">Worst, σ</th>",
                             escaped(unit)),
                 rows);
}

std::string readings_table(const Json& fit) {
    const std::set<std::string> suspects = suspects_of(fit);
    std::string rows;
    for (const Json& reading : array_at(fit, "readings")) {
        const std::string id = text_at(reading, "id");
        const bool suspect = true_at(reading, "suspect") || suspects.contains(id);
        const auto normalized = number_at(reading, "normalized");
        const auto cell = [&](const char* key, int digits) {
            return fmt::format("<td class=\"n\">{}</td>",
                               significant(number_at(reading, key), digits));
        };
        rows += fmt::format(
            "<tr{}><th scope=\"row\">{}{}</th><td>{}</td><td>{}</td>{}{}{}{}<td class=\"n\">{}</td>"
            "<td>{}</td>{}{}</tr>\n",
            suspect ? " class=\"suspect\"" : "", escaped(id),
            suspect ? " <span class=\"badge\">suspect</span>" : "",
            escaped(text_at(reading, "kind")), escaped(joined(names_of(reading))), cell("value", 6),
            cell("sigma", 2), cell("fitted", 6), cell("residual", 2), decimals(normalized, 2),
            normalized ? residual_bar(*normalized) : "", cell("redundancy", 2),
            cell("detectable", 2));
    }
    if (rows.empty()) return {};
    return table(
               "Readings and what is left of them",
               "<th scope=\"col\">Reading</th><th scope=\"col\">Kind</th><th scope=\"col\">Of</th>"
               "<th scope=\"col\" class=\"n\">Value</th><th scope=\"col\" class=\"n\">σ</th>"
               "<th scope=\"col\" class=\"n\">Fitted</th>"
               "<th scope=\"col\" class=\"n\">Residual</th>"
               "<th scope=\"col\" class=\"n\">Normalized</th><th scope=\"col\">−4 … 4</th>"
               "<th scope=\"col\" class=\"n\">Redundancy</th>"
               "<th scope=\"col\" class=\"n\">Detectable</th>",
               rows) +
           "<p class=\"note\">Normalized: the residual over its own standard uncertainty. "
           "Redundancy: "
           "0 means that nothing checks this reading, 1 that it adds nothing. Detectable: the "
           "smallest error in it that would be noticed.</p>\n";
}

}  // namespace culet
