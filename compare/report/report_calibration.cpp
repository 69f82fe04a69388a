// Report sections on the meaning of the scores: sensitivity curves with the photograph's place on
// them, chance, and hypotheses.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "compare/report/report_parts.h"
#include "compare/templates.h"
#include "page/html.h"
#include "page/parts.h"

namespace culet {

namespace {

std::string title_of(Alternative alternative) {
    switch (alternative) {
        case Alternative::light:
            return "Another light";
        case Alternative::pose:
            return "Another pose";
        case Alternative::both:
            return "Another light and pose";
        case Alternative::catalogue:
            return "Catalogue cut";
        case Alternative::material:
            return "Another material";
        case Alternative::wrong:
            return "One thing wrong";
        case Alternative::facet_error:
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

// One score against facet error: the curve from the draws, the nulls' draws as strokes at the
// right, and the photograph's value as a horizontal line with its place on the curve.
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
        std::vector<View> levels, draws;
        std::string line;
        for (const auto& level : curve_.levels) {
            const double at = x(level.facet_error_deg);
            levels.push_back({{"x", px(at)},
                              {"low", px(y(level.mean - level.sd))},
                              {"high", px(y(level.mean + level.sd))},
                              {"mean", px(y(level.mean))}});
            line += fmt::format("{}{:.1f},{:.1f}", line.empty() ? "M" : "L", at, y(level.fitted));
        }
        for (const double v : nulls_) draws.push_back(px(y(v)));
        const bool placed = curve_.value && curve_.equivalent_deg;
        return filled(templates::sensitivity_curve,
                      {{"width", fmt::format("{}", k_width)},
                       {"height", fmt::format("{}", k_height)},
                       {"about", about()},
                       {"axes", fmt::format("M{0},{1}V{2}H{3}M{4},{1}V{2}H{5}", k_left, k_top,
                                            k_bottom, k_right, k_nulls - 4, k_width - 2)},
                       {"degrees", degree_ticks()},
                       {"titles", titles()},
                       {"values", value_ticks()},
                       {"levels", levels},
                       {"fit", line},
                       {"nulls", draws},
                       {"nulls_from", fmt::format("{}", k_nulls)},
                       {"nulls_to", fmt::format("{}", k_width - 4)},
                       {"here", curve_.value ? px(y(*curve_.value)) : ""},
                       {"here_from", fmt::format("{}", k_left)},
                       {"place", placed ? px(x(*curve_.equivalent_deg)) : ""}});
    }

private:
    static constexpr double k_width = 360, k_height = 230, k_left = 46, k_right = 300,
                            k_nulls = 318, k_top = 10, k_bottom = 190;
    static std::string px(double value) { return fmt::format("{:.1f}", value); }
    static View label(const std::string& x, const std::string& y, const std::string& text) {
        return {{"x", x}, {"y", y}, {"text", text}};
    }
    // The ceiling (error 0) is at the left end.
    static double log_deg(double deg) { return std::log10(std::max(deg, 0.01)); }
    double x(double deg) const {
        return k_left + 8 + (log_deg(deg) + 2) / (std::log10(2.0) + 2) * (k_right - k_left - 16);
    }
    double y(double value) const {
        const double share = (value - low_) / (high_ - low_);
        return curve_.higher_is_better ? k_bottom - share * (k_bottom - k_top)
                                       : k_top + share * (k_bottom - k_top);
    }

    std::vector<View> degree_ticks() const {
        std::vector<View> ticks;
        for (const double deg : {0.0, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0}) {
            ticks.push_back(label(px(x(deg)), fmt::format("{}", k_bottom + 16),
                                  deg > 0 ? significant(deg, 1) : "0"));
        }
        return ticks;
    }

    std::vector<View> titles() const {
        return {label(fmt::format("{}", (k_left + k_right) / 2), fmt::format("{}", k_bottom + 34),
                      "facet error, degrees"),
                label(fmt::format("{}", (k_nulls + k_width) / 2 - 2),
                      fmt::format("{}", k_bottom + 16), "chance")};
    }

    std::vector<View> value_ticks() const {
        const double step = std::pow(10, std::floor(std::log10((high_ - low_) / 2)));
        const double every = (high_ - low_) / step > 5 ? 2 * step : step;
        const int places = std::max(0, -static_cast<int>(std::floor(std::log10(every) + 1e-9)));
        const int first = static_cast<int>(std::ceil(low_ / every)),
                  last = static_cast<int>(std::floor(high_ / every));
        std::vector<View> ticks;
        for (int i = first; i <= last; ++i) {
            const double v = i * every;
            ticks.push_back(
                label(fmt::format("{}", k_left - 5), px(y(v) + 4), decimals(v, places)));
        }
        return ticks;
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
        const bool null = draw.alternative == Alternative::light ||
                          draw.alternative == Alternative::pose ||
                          draw.alternative == Alternative::both;
        if (null && draw.scores[k]) values.push_back(*draw.scores[k]);
    }
    return values;
}

View curve_figures(const CalibratedVerdict& verdict) {
    std::vector<SensitivityCurve> curves = verdict.curves;
    std::stable_sort(curves.begin(), curves.end(),
                     [](const auto& a, const auto& b) { return a.weight > b.weight; });
    curves.resize(std::min<std::size_t>(curves.size(), 6));
    if (curves.empty()) return false;
    std::vector<View> figures;
    for (const SensitivityCurve& curve : curves) {
        const auto& alone = curve.equivalent_deg;
        figures.push_back(
            {{"curve_svg", CurvePicture(curve, null_values(verdict.calibration, curve.key)).svg()},
             {"name", score_name(curve.key)},
             {"percent", decimals(100 * curve.weight, 0)},
             {"equivalent", alone ? significant(alone, 2) : ""}});
    }
    return {{"figures", figures}};
}

View nulls_table(const CalibratedVerdict& verdict) {
    std::vector<View> rows;
    for (const NullStatistics& null : verdict.nulls) {
        rows.push_back({{"alternative", title_of(null.alternative)},
                        {"mean", decimals(null.mean, 2)},
                        {"sd", decimals(null.sd, 2)},
                        {"z", decimals(null.z, 1)},
                        {"as_good", std::to_string(null.as_good)},
                        {"of", std::to_string(null.draws)},
                        {"least", significant(null.least_deg, 2)}});
    }
    return table_view(rows);
}

View hypotheses_table(const CalibratedVerdict& verdict) {
    std::vector<View> rows;
    for (const HypothesisScore& h : verdict.hypotheses) {
        rows.push_back({{"name", h.name},
                        {"alternative", title_of(h.alternative)},
                        {"zncc", decimals(h.zncc, 3)},
                        {"equivalent", degrees_text(h.equivalent)}});
    }
    return table_view(rows);
}

}  // namespace

std::string calibration_section(const Report& report) {
    if (!report.calibrated) return {};
    const CalibratedVerdict& verdict = *report.calibrated;
    const Calibration& calibration = verdict.calibration;
    const auto& notes = calibration.notes;
    return section("meaning", "What it means",
                   filled(templates::report_calibration,
                          {{"word", photo_word(report)},
                           {"headline", as_sentence(verdict.headline)},
                           {"geometry_only", verdict.geometry_only},
                           {"curves", curve_figures(verdict)},
                           {"draws", std::to_string(calibration.draws.size())},
                           {"seed", std::to_string(calibration.seed)},
                           {"psf_px", decimals(calibration.psf_px, 1)},
                           {"electrons", significant(calibration.electrons, 2)},
                           {"kept", calibration.from_cache},
                           {"notes", std::vector<View>(notes.begin(), notes.end())},
                           {"nulls", nulls_table(verdict)},
                           {"hypotheses", hypotheses_table(verdict)}}));
}

}  // namespace culet
