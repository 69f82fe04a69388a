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
#include "page/templates.h"

namespace culet {

namespace {

using Json = nlohmann::json;

// A bar from the middle: -4 .. 4 standard uncertainties.
View residual_bar(const std::optional<double>& normalized) {
    if (!normalized) return false;
    const double size = std::min(std::abs(*normalized) / k_worst_shown, 1.0);
    const double length = 50 * size, from = *normalized < 0 ? 50 - length : 50;
    return {{"from", fmt::format("{:.1f}", from)},
            {"length", fmt::format("{:.1f}", std::max(length, 0.6))},
            {"colour", css_colour(ColourMap::residual, size)}};
}

// Relations (meets, symmetry) have no value, only a residual.
std::string read_as(const std::optional<double>& value, const std::optional<double>& sigma,
                    const std::string& unit) {
    if (value) return quantity(value, sigma, unit);
    if (!sigma) return "–";
    return *sigma < finest_of(unit) ? "held exactly" : "± " + to_place_of(sigma, sigma, unit);
}

View reading_row(const Json& reading, bool suspected, const std::string& length_unit) {
    const auto normalized = number_at(reading, "normalized");
    const auto value = number_at(reading, "value"), redundancy = number_at(reading, "redundancy");
    const std::string unit = reading_unit(text_at(reading, "kind"), length_unit);
    const auto sigma = true_at(reading, "exact") ? 0.0 : number_at(reading, "sigma");
    return {{"suspect", suspected || true_at(reading, "suspect")},
            {"id", text_at(reading, "id")},
            {"of", reading_words(reading)},
            {"read", read_as(value, sigma, unit)},
            {"fitted", to_place_of(number_at(reading, "fitted"), sigma, unit)},
            {"off", to_place_of(number_at(reading, "residual"), sigma, unit)},
            {"times", decimals(normalized, 1)},
            {"bar", residual_bar(normalized)},
            {"checked", redundancy ? decimals(100 * *redundancy, 0) + " %" : "–"},
            {"slip", smallest_slip(number_at(reading, "detectable"), value, unit)}};
}

View facet_row(const Json& facet, const Worst& worst, const std::string& unit) {
    const auto shown = [&](const char* key, const char* sigma, const std::string& in) {
        return quantity(number_at(facet, key), number_at(facet, sigma), in);
    };
    // A level facet has no azimuth.
    const bool level = !number_at(facet, "sigma_azimuth"), unread = worst.reading.empty();
    const double size = std::abs(worst.normalized) / k_worst_shown;
    return {{"colour", unread ? "" : css_colour(ColourMap::residual, size)},
            {"name", text_at(facet, "name")},
            {"inclination", shown("inclination", "sigma_inclination", "deg")},
            {"azimuth", level ? "–" : shown("azimuth", "sigma_azimuth", "deg")},
            {"offset", shown("offset", "sigma_offset", unit)},
            {"readings", std::to_string(worst.count)},
            {"worst", unread ? "–" : decimals(worst.normalized, 1)},
            {"reading", worst.reading}};
}

}  // namespace

std::string facets_table(const Json& fit, const std::string& unit) {
    const Json& facets = array_at(fit, "facets");
    if (facets.empty()) return {};
    std::vector<std::string> names;
    for (const Json& facet : facets) names.push_back(text_at(facet, "name"));
    const std::vector<Worst> worst = worst_readings(fit, names);
    std::vector<View> rows;
    for (std::size_t f = 0; f < facets.size(); ++f) {
        rows.push_back(facet_row(facets[f], worst[f], unit));
    }
    return filled(
        templates::fit_facets,
        {{"count", std::to_string(rows.size())}, {"tall", is_tall(rows)}, {"rows", rows}});
}

std::string readings_table(const Json& fit, const std::string& length_unit) {
    const std::set<std::string> suspects = suspects_of(fit);
    std::vector<View> rows;
    for (const Json& reading : array_at(fit, "readings")) {
        rows.push_back(
            reading_row(reading, suspects.contains(text_at(reading, "id")), length_unit));
    }
    if (rows.empty()) return {};
    return filled(
        templates::fit_readings,
        {{"count", std::to_string(rows.size())}, {"tall", is_tall(rows)}, {"rows", rows}});
}

}  // namespace culet
