#include "page/fit_paint.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "page/fit_fields.h"
#include "page/html.h"
#include "page/quantity.h"
#include "stone/design/index_names.h"

namespace culet {

namespace {

using Json = nlohmann::json;

constexpr const char* k_plain = "#d9dde0";

std::string pose_of(const Json& facet) {
    const auto azimuth = number_at(facet, "sigma_azimuth");
    return "inclination " +
           quantity(number_at(facet, "inclination"), number_at(facet, "sigma_inclination"), "deg") +
           (azimuth ? ", azimuth " + quantity(number_at(facet, "azimuth"), azimuth, "deg") : "");
}

std::string undetermined_directions(const Json& fit, const std::string& facet) {
    std::string freedoms;
    for (const Json& one : array_at(fit, "undetermined")) {
        if (text_at(one, "facet") != facet) continue;
        freedoms += (freedoms.empty() ? "" : ", ") + text_at(one, "freedom");
    }
    return freedoms;
}

/// The next 1, 2 or 5 times a power of ten.
double rounded_up(double value) {
    const double decade = std::pow(10, std::floor(std::log10(value)));
    for (const double step : {1.0, 2.0, 5.0}) {
        if (step * decade >= value * (1 - 1e-9)) return step * decade;
    }
    return 10 * decade;
}

// The scale covers nine facets of ten: a few poorly determined ones would make all others look
// alike.
double top_of(std::vector<double> sigmas) {
    std::erase_if(sigmas, [](double s) { return !(s > 0) || !std::isfinite(s); });
    if (sigmas.empty()) return 1;
    std::sort(sigmas.begin(), sigmas.end());
    return rounded_up(sigmas[static_cast<std::size_t>(0.9 * double(sigmas.size() - 1))]);
}

FitPaint residuals(const Json& fit, const std::vector<std::string>& names) {
    FitPaint paint;
    const std::vector<Worst> worst = worst_readings(fit, names);
    for (std::size_t f = 0; f < names.size(); ++f) {
        FacetPaint own;
        if (const Json* facet = facet_in(fit, names[f])) own.about = pose_of(*facet);
        own.about += own.about.empty() ? "" : "; ";
        own.marked = worst[f].suspect;
        if (worst[f].reading.empty()) {
            own.colour = k_plain;
            own.about += "no reading of its own";
        } else {
            own.colour =
                css_colour(ColourMap::residual, std::abs(worst[f].normalized) / k_worst_shown);
            const std::string which = worst[f].count == 1
                                          ? "its reading"
                                          : fmt::format("of its {} readings", worst[f].count);
            own.about += fmt::format("{} {} is {} times its ± off", which, worst[f].reading,
                                     decimals(std::abs(worst[f].normalized), 2));
        }
        paint.facets.push_back(std::move(own));
    }
    paint.legend = {
        ColourMap::residual,
        "how far each facet's worst reading is off, in multiples of its ±; grey: not read",
        "0",
        "2",
        "4 or more",
        ""};
    for (const Worst& one : worst) {
        if (one.suspect) paint.legend.mark = "dashed: has a suspect reading";
    }
    return paint;
}

FitPaint uncertainties(const Json& fit, const std::vector<std::string>& names) {
    FitPaint paint;
    std::vector<std::optional<double>> sigmas;
    std::vector<double> known;
    for (const std::string& name : names) {
        const Json* facet = facet_in(fit, name);
        sigmas.push_back(facet ? direction_sigma(*facet) : std::nullopt);
        // Undetermined facets do not count for the scale.
        if (sigmas.back() && undetermined_directions(fit, name).empty())
            known.push_back(*sigmas.back());
    }
    const double top = top_of(known);
    for (std::size_t f = 0; f < names.size(); ++f) {
        FacetPaint own;
        const Json* facet = facet_in(fit, names[f]);
        own.about = facet ? pose_of(*facet) : "not in the report";
        own.colour = sigmas[f] ? css_colour(ColourMap::uncertainty, *sigmas[f] / top) : k_plain;
        if (const std::string open = undetermined_directions(fit, names[f]); !open.empty()) {
            own.marked = true;
            own.about += "; left open by the readings: " + open;
            paint.legend.mark = "dashed: left open by the readings";
        }
        paint.facets.push_back(std::move(own));
    }
    paint.legend.map = ColourMap::uncertainty;
    paint.legend.what = "how far a facet's direction may be off (±), degrees";
    paint.legend.from = "0";
    paint.legend.middle = significant(0.5 * top, 2);
    paint.legend.to = significant(top, 2) + " or more";
    return paint;
}

// Readings may name facets by tier and index (A@76).
void name_facets_at_indices(const Solid& solid, Json& fit) {
    const auto readings = fit.find("readings");
    if (readings == fit.end() || !readings->is_array()) return;
    for (Json& reading : *readings) {
        for (const Json& one : Json(array_at(reading, "of"))) {
            if (!one.is_string()) continue;
            for (const int f : facets_at_index(solid, one.get<std::string>()))
                reading["of"].push_back(solid.facets[std::size_t(f)].name);
        }
    }
}

}  // namespace

FitPaint fit_paint(const Solid& solid, const std::string& fit_json, FitColour colour) {
    Json fit = parsed_object<Json>(fit_json, "the fit report for the drawing");
    name_facets_at_indices(solid, fit);
    std::vector<std::string> names;
    for (const Facet& facet : solid.facets) names.push_back(facet.name);
    return colour == FitColour::residual ? residuals(fit, names) : uncertainties(fit, names);
}

}  // namespace culet
