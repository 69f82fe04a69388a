#include "page/fit_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "page/fit_fields.h"
#include "page/fit_paint.h"
#include "page/html.h"
#include "page/parts.h"
#include "page/quantity.h"
#include "page/reading_words.h"

namespace culet {

namespace {

using Json = nlohmann::json;

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

// Relations (meets, symmetry) have no value, only how nearly they hold.
std::string read_as(const std::optional<double>& value, const std::optional<double>& sigma,
                    const std::string& unit) {
    if (value) return quantity(value, sigma, unit);
    if (!sigma) return "–";
    return *sigma < finest_of(unit) ? "held exactly" : "± " + to_place_of(sigma, sigma, unit);
}

std::string reading_row(const Json& reading, bool suspected, const std::string& length_unit) {
    const bool suspect = suspected || true_at(reading, "suspect");
    const auto normalized = number_at(reading, "normalized");
    const auto value = number_at(reading, "value"), redundancy = number_at(reading, "redundancy");
    const std::string unit = reading_unit(text_at(reading, "kind"), length_unit);
    const auto sigma = true_at(reading, "exact") ? 0.0 : number_at(reading, "sigma");
    const auto cell = [](const std::string& text) { return "<td class=\"n\">" + text + "</td>"; };
    return fmt::format("<tr{}><th scope=\"row\">{}{}</th><td>{}</td>{}{}{}{}<td>{}</td>{}{}</tr>\n",
                       suspect ? " class=\"suspect\"" : "", escaped(text_at(reading, "id")),
                       suspect ? " <span class=\"badge\">suspect</span>" : "",
                       escaped(reading_words(reading)), cell(read_as(value, sigma, unit)),
                       cell(to_place_of(number_at(reading, "fitted"), sigma, unit)),
                       cell(to_place_of(number_at(reading, "residual"), sigma, unit)),
                       cell(decimals(normalized, 1)), normalized ? residual_bar(*normalized) : "",
                       cell(redundancy ? decimals(100 * *redundancy, 0) + " %" : "–"),
                       cell(smallest_slip(number_at(reading, "detectable"), value, unit)));
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
        const auto pair = [&](const char* key, const char* sigma, const char* in) {
            return fmt::format("<td class=\"n\">{}</td>",
                               quantity(number_at(facet, key), number_at(facet, sigma), in));
        };
        // A level facet has no azimuth.
        const bool level = !number_at(facet, "sigma_azimuth");
        const double size = std::abs(worst[f].normalized);
        const std::string swatch =
            worst[f].reading.empty()
                ? "<span class=\"swatch\"></span>"
                : fmt::format("<span class=\"swatch\" style=\"background:{}\"></span>",
                              css_colour(ColourMap::residual, size / k_worst_shown));
        rows += fmt::format(
            "<tr><th scope=\"row\">{}{}</th>{}{}{}<td class=\"n\">{}</td><td class=\"n\">{}</td>"
            "</tr>\n",
            swatch, escaped(names[f]), pair("inclination", "sigma_inclination", "deg"),
            level ? "<td class=\"n\">–</td>" : pair("azimuth", "sigma_azimuth", "deg"),
            pair("offset", "sigma_offset", unit.c_str()), worst[f].count,
            worst[f].reading.empty() ? "–"
                                     : decimals(worst[f].normalized, 1) + " <small>" +
                                           escaped(worst[f].reading) + "</small>");
        ++f;
    }
    return folded(
        fmt::format("{} facets as fitted", names.size()),
        table("Facets as fitted",
              "<th scope=\"col\">Facet</th><th scope=\"col\" class=\"n\">Inclination</th>"
              "<th scope=\"col\" class=\"n\">Azimuth</th><th scope=\"col\" class=\"n\">Offset</th>"
              "<th scope=\"col\" class=\"n\">Readings</th>"
              "<th scope=\"col\" class=\"n\">Worst, times its ±</th>",
              rows) +
            "<p class=\"note\">Offset: from the stone's middle to the facet. Held exactly is what "
            "other facets are measured from, or what was ordered to hold.</p>\n");
}

std::string readings_table(const Json& fit, const std::string& length_unit) {
    const std::set<std::string> suspects = suspects_of(fit);
    std::string rows;
    for (const Json& reading : array_at(fit, "readings")) {
        const std::string id = text_at(reading, "id");
        rows += reading_row(reading, suspects.contains(id), length_unit);
    }
    if (rows.empty()) return {};
    return folded(
        fmt::format("{} readings and how far the stone is off them",
                    array_at(fit, "readings").size()),
        table("Readings and the stone beside them",
              "<th scope=\"col\">Reading</th><th scope=\"col\">Of</th>"
              "<th scope=\"col\" class=\"n\">Read</th><th scope=\"col\" class=\"n\">Stone has</th>"
              "<th scope=\"col\" class=\"n\">Off</th><th scope=\"col\" class=\"n\">Times its ±</th>"
              "<th scope=\"col\">−4 … 4</th>"
              "<th scope=\"col\" class=\"n\">Checked by others</th>"
              "<th scope=\"col\" class=\"n\">Smallest slip that shows</th>",
              rows) +
            "<p class=\"note\">Times its ±: how far off, against what it may be off by chance; "
            "over 4 hardly happens by chance. Checked by others: 0 % means that nothing checks "
            "this reading, 100 % "
            "that the others alone say as much. Smallest slip that shows: a slip of the pen or of "
            "the gauge smaller than that would not be noticed.</p>\n");
}

}  // namespace culet
