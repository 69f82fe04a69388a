// Sections of the report that say what the scores mean: sensitivity curves with the photograph's
// place on them, chance, and other hypotheses.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "compare/report/report_parts.h"
#include "page/html.h"
#include "page/parts.h"

namespace culet {

namespace {

std::string title_of(World world) {
    switch (world) {
        case World::light:
            return "Another light";
        case World::pose:
            return "Another pose";
        case World::both:
            return "Another light and pose";
        case World::catalogue:
            return "Catalogue cut";
        case World::material:
            return "Another material";
        case World::wrong:
            return "One thing wrong";
        case World::facet_error:
            break;
    }
    return "Facet error";
}

std::string degrees_text(const EquivalentError& error) {
    if (!error.deg) return "–";
    const std::string text = significant(error.deg, 2) + "°";
    if (error.at_least) return "≥ " + text;
    return error.at_most ? "≤ " + text : text;
}

// One score against facet error: the curve from the draws, the draws of the nulls as strokes at the
// right, and the photograph's value as a line across with its place on the curve.
class CurvePicture {
public:
    CurvePicture(const SensitivityCurve& curve, std::vector<double> nulls)
        : curve_(curve), nulls_(std::move(nulls)) {
        std::vector<double> values = nulls_;
        for (const auto& level : curve.levels) {
            values.push_back(level.mean - level.sd);
            values.push_back(level.mean + level.sd);
        }
        if (curve.value) values.push_back(*curve.value);
        const auto [low, high] = std::minmax_element(values.begin(), values.end());
        const double air = 0.06 * std::max(1e-6, *high - *low);
        low_ = *low - air;
        high_ = *high + air;
    }

    std::string svg() const {
        std::string out = fmt::format(
            "<svg class=\"curve\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">", k_width,
            k_height, escaped(about()));
        axes(out);
        bars(out);
        for (const double v : nulls_) {
            out += fmt::format(
                "<line class=\"draw\" x1=\"{}\" x2=\"{}\" y1=\"{:.1f}\" y2=\"{:.1f}\"/>", k_nulls,
                k_width - 4, y(v), y(v));
        }
        if (curve_.value) {
            out += fmt::format(
                "<line class=\"here\" x1=\"{}\" x2=\"{}\" y1=\"{:.1f}\" y2=\"{:.1f}\"/>", k_left,
                k_width - 4, y(*curve_.value), y(*curve_.value));
            if (curve_.equivalent_deg) {
                out += fmt::format("<circle class=\"place\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"6\"/>",
                                   x(*curve_.equivalent_deg), y(*curve_.value));
            }
        }
        return out + "</svg>";
    }

private:
    static constexpr double k_width = 360, k_height = 230, k_left = 46, k_right = 300,
                            k_nulls = 318, k_top = 10, k_bottom = 190;
    // The ceiling stands at the left end.
    static double log_deg(double deg) { return std::log10(std::max(deg, 0.01)); }
    double x(double deg) const {
        return k_left + 8 + (log_deg(deg) + 2) / (std::log10(2.0) + 2) * (k_right - k_left - 16);
    }
    double y(double value) const {
        const double share = (value - low_) / (high_ - low_);
        return curve_.higher_is_better ? k_bottom - share * (k_bottom - k_top)
                                       : k_top + share * (k_bottom - k_top);
    }

    void axes(std::string& out) const {
        out += fmt::format("<path class=\"axis\" d=\"M{0},{1}V{2}H{3}M{4},{1}V{2}H{5}\"/>", k_left,
                           k_top, k_bottom, k_right, k_nulls - 4, k_width - 2);
        for (const double deg : {0.0, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0}) {
            out += fmt::format("<text x=\"{:.1f}\" y=\"{}\" text-anchor=\"middle\">{}</text>",
                               x(deg), k_bottom + 16, deg > 0 ? significant(deg, 1) : "0");
        }
        out += fmt::format(
            "<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">facet error, degrees</text>"
            "<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">chance</text>",
            (k_left + k_right) / 2, k_bottom + 34, (k_nulls + k_width) / 2 - 2, k_bottom + 16);
        const double step = std::pow(10, std::floor(std::log10((high_ - low_) / 2)));
        const double every = (high_ - low_) / step > 5 ? 2 * step : step;
        const int places = std::max(0, -static_cast<int>(std::floor(std::log10(every) + 1e-9)));
        const int first = static_cast<int>(std::ceil(low_ / every)),
                  last = static_cast<int>(std::floor(high_ / every));
        for (int i = first; i <= last; ++i) {
            const double v = i * every;
            out += fmt::format("<text x=\"{}\" y=\"{:.1f}\" text-anchor=\"end\">{}</text>",
                               k_left - 5, y(v) + 4, decimals(v, places));
        }
    }

    void bars(std::string& out) const {
        std::string line;
        for (const auto& level : curve_.levels) {
            const double at = x(level.facet_error_deg);
            out += fmt::format(
                "<line class=\"spread\" x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1:.1f}\" "
                "y2=\"{2:.1f}\"/><circle class=\"mean\" cx=\"{0:.1f}\" cy=\"{3:.1f}\" r=\"3\"/>",
                at, y(level.mean - level.sd), y(level.mean + level.sd), y(level.mean));
            line += fmt::format("{}{:.1f},{:.1f}", line.empty() ? "M" : "L", at, y(level.fitted));
        }
        out += fmt::format("<path class=\"fit\" d=\"{}\"/>", line);
    }

    std::string about() const {
        std::string text = score_name(curve_.key) + " against facet error";
        if (curve_.value)
            text += fmt::format("; the photograph has {}", significant(curve_.value, 3));
        if (curve_.equivalent_deg) {
            text += fmt::format(", as {} degrees would", significant(curve_.equivalent_deg, 2));
        }
        return text;
    }

    const SensitivityCurve& curve_;
    std::vector<double> nulls_;
    double low_ = 0, high_ = 1;
};

std::vector<double> null_values(const Calibration& calibration, const std::string& key) {
    std::vector<double> values;
    const auto at = std::find(calibration.keys.begin(), calibration.keys.end(), key);
    if (at == calibration.keys.end()) return values;
    const auto k = static_cast<std::size_t>(at - calibration.keys.begin());
    for (const CalibrationDraw& draw : calibration.draws) {
        const bool null =
            draw.world == World::light || draw.world == World::pose || draw.world == World::both;
        if (null && draw.scores[k]) values.push_back(*draw.scores[k]);
    }
    return values;
}

std::string curves_figures(const Meaning& meaning, const Calibration& calibration) {
    // Those that weigh most.
    std::vector<SensitivityCurve> curves = meaning.curves;
    std::stable_sort(curves.begin(), curves.end(),
                     [](const auto& a, const auto& b) { return a.weight > b.weight; });
    std::string figures;
    for (std::size_t i = 0; i < std::min<std::size_t>(curves.size(), 6); ++i) {
        const SensitivityCurve& curve = curves[i];
        figures += fmt::format(
            "<figure>{}<figcaption><b>{}</b>: {} of the answer{}</figcaption></figure>\n",
            CurvePicture(curve, null_values(calibration, curve.key)).svg(),
            escaped(score_name(curve.key)), decimals(100 * curve.weight, 0) + " %",
            curve.equivalent_deg
                ? fmt::format(", by itself {}°", significant(curve.equivalent_deg, 2))
                : "");
    }
    return figures.empty() ? figures : "<div class=\"curves\">" + figures + "</div>\n";
}

std::string nulls_table(const Meaning& meaning) {
    std::string rows;
    for (const NullWorth& null : meaning.nulls) {
        rows += fmt::format(
            "<tr><th scope=\"row\">{}</th><td class=\"n\">{} ± {}</td><td class=\"n "
            "strong\">{}</td>"
            "<td class=\"n\">{} of {}</td><td class=\"n\">{}°</td></tr>\n",
            title_of(null.world), decimals(null.mean, 2), decimals(null.sd, 2), decimals(null.z, 1),
            null.as_good, null.draws, significant(null.least_deg, 2));
    }
    if (rows.empty()) return {};
    return table("Chance, the worst first",
                 "<th scope=\"col\">Were it</th><th scope=\"col\" class=\"n\">Pattern of light</th>"
                 "<th scope=\"col\" class=\"n\">z of the photograph</th>"
                 "<th scope=\"col\" class=\"n\">Draws as good</th>"
                 "<th scope=\"col\" class=\"n\">Best draw looks like</th>",
                 rows);
}

std::string hypotheses_table(const Meaning& meaning) {
    std::string rows;
    for (const HypothesisWorth& h : meaning.hypotheses) {
        rows += fmt::format(
            "<tr><th scope=\"row\">{}<small>{}</small></th><td class=\"n\">{}</td>"
            "<td class=\"n strong\">{}</td></tr>\n",
            escaped(h.name), title_of(h.world), decimals(h.zncc, 3), degrees_text(h.equivalent));
    }
    if (rows.empty()) return {};
    return table("What else it could be",
                 "<th scope=\"col\">Were this true of the stone</th>"
                 "<th scope=\"col\" class=\"n\">Pattern of light</th>"
                 "<th scope=\"col\" class=\"n\">It would look like</th>",
                 rows);
}

}  // namespace

std::string meaning_section(const Report& report) {
    if (!report.comparison || !report.comparison->meaning || !report.comparison->calibration) {
        return {};
    }
    const Meaning& meaning = *report.comparison->meaning;
    const Calibration& calibration = *report.comparison->calibration;
    std::string body = fmt::format("<p class=\"headline-sentence\">The {} {}.</p>\n",
                                   photo_word(report), escaped(meaning.headline));
    if (meaning.geometry_only) {
        body +=
            "<p class=\"warning\">This photograph cannot serve for photometry: only scores of "
            "geometry take part.</p>\n";
    }
    body += curves_figures(meaning, calibration);
    body += fmt::format(
        "<p class=\"note\">Each curve is what this stone, in this pose and light, would score "
        "against the model if every facet were tilted at random by that much: {} simulated "
        "photographs, seed {}, blurred by {} pixels, as noisy as one of {} electrons at white, in "
        "whole steps like a camera's, registered anew. "
        "Dots with bars: mean and spread; line across and ring: the {}; strokes: other lights and "
        "poses. 0 is the ceiling, the model itself photographed. {}</p>\n",
        calibration.draws.size(), calibration.seed, decimals(calibration.psf_px, 1),
        significant(calibration.electrons, 2), photo_word(report),
        calibration.from_cache ? "The draws were kept from an earlier comparison with this scene."
                               : fmt::format("They took {} s.", decimals(calibration.seconds, 0)));
    for (const std::string& note : calibration.notes) {
        body += fmt::format("<p class=\"warning\">{}</p>\n", escaped(note));
    }
    body += nulls_table(meaning) + hypotheses_table(meaning);
    return section("meaning", "What it means", body);
}

}  // namespace culet
