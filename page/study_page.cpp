#include "page/study_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "page/chart.h"
#include "page/html.h"
#include "page/json_fields.h"
#include "page/parts.h"
#include "page/quantity.h"
#include "page/study_sections.h"
#include "page/templates.h"

namespace culet {

namespace {

using Json = nlohmann::json;

struct SweepWords {
    const char *sweep, *name, *about;
    bool line;  // its settings are ordered
};

constexpr SweepWords k_sweeps[] = {
    {"iterations", "most steps", "the limit on steps of the last stage", true},
    {"tolerance", "tolerance", "when the last stage ends", true},
    {"meets", "meets", "how meets of more than three facets are treated", false},
    {"symmetry", "symmetry", "how the declared symmetry is treated", false},
    {"start", "start", "how far the mesh is from the stone when the fit begins", false},
    {"starts", "starts", "how many starts may be tried, from a mesh shaken by 20 %", true},
};

const SweepWords* words_of(const std::string& sweep) {
    for (const SweepWords& words : k_sweeps) {
        if (sweep == words.sweep) return &words;
    }
    return nullptr;
}

std::string ms(double seconds) {
    return std::isfinite(seconds) ? significant(1000 * seconds, 3) : "–";
}

std::string of_fits(const Json& row, const char* key) {
    const auto count = number_at(row, key);
    return count ? fmt::format("{}/{}", whole(count), whole(number_at(row, "fits"))) : "–";
}

// Sweeps in the order of their first rows.
std::vector<std::string> sweeps_of(const Json& study) {
    std::vector<std::string> sweeps;
    for (const Json& row : array_at(study, "settings")) {
        const std::string sweep = text_at(row, "sweep");
        if (std::find(sweeps.begin(), sweeps.end(), sweep) == sweeps.end()) {
            sweeps.push_back(sweep);
        }
    }
    return sweeps;
}

Chart fit_time_chart(const Json& study) {
    Chart chart;
    chart.title = "What accuracy costs in time";
    chart.about =
        "Angle error against processor time of one fit, both logarithmic: one point a setting.";
    chart.x_label = "processor time of one fit, ms";
    chart.y_label = "angle error, degrees";
    for (const std::string& sweep : sweeps_of(study)) {
        const SweepWords* words = words_of(sweep);
        ChartSeries series;
        series.name = words != nullptr ? words->name : sweep;
        series.line = words != nullptr && words->line;
        for (const Json& row : array_at(study, "settings")) {
            if (text_at(row, "sweep") != sweep) continue;
            const std::string setting = text_at(row, "setting");
            ChartPoint point{1000 * value_at(row, "seconds"),
                             value_at(row, "angle_error"),
                             setting,
                             fmt::format("{} {}: {} ms, {} degrees", series.name, setting,
                                         ms(value_at(row, "seconds")),
                                         significant(number_at(row, "angle_error"))),
                             std::nan(""),
                             std::nan(""),
                             false};
            // Some of its fits found no stone; the error is that of the others.
            point.hollow = number_at(row, "sound") != number_at(row, "fits");
            series.points.push_back(std::move(point));
        }
        chart.series.push_back(std::move(series));
    }
    return chart;
}

Chart limit_chart(const Json& study) {
    Chart chart;
    chart.title = "The error beside the theoretical limit";
    chart.about =
        "Angle error of fits and Cramer-Rao limit against the number of readings, logarithmic.";
    chart.x_label = "readings kept";
    chart.y_label = "angle error, degrees";
    ChartSeries limit{"Cramér-Rao limit", {}, true, false, false};
    ChartSeries error{"measured", {}, false, true, false};
    for (const Json& row : array_at(study, "limits")) {
        const double readings = value_at(row, "readings"), angle = value_at(row, "angle_error"),
                     ratio = value_at(row, "ratio"), sigma = value_at(row, "ratio_sigma");
        limit.points.push_back({readings, value_at(row, "angle_limit"), {}, {}});
        ChartPoint point{readings,
                         angle,
                         fmt::format("{:.2f}", ratio),
                         fmt::format("{} readings: {} degrees, {} of the limit", whole(readings),
                                     significant(angle), significant(ratio)),
                         angle * (1 - sigma / ratio),
                         angle * (1 + sigma / ratio),
                         false};
        error.points.push_back(std::move(point));
    }
    chart.series = {std::move(limit), std::move(error)};
    return chart;
}

View time_row(const Json& row) {
    const std::string sweep = text_at(row, "sweep");
    const SweepWords* words = words_of(sweep);
    return {{"sweep", words != nullptr ? words->name : sweep},
            {"setting", text_at(row, "setting")},
            {"as_asked", true_at(row, "as_asked")},
            {"sound", of_fits(row, "sound")},
            {"settled", of_fits(row, "settled")},
            {"best", of_fits(row, "best")},
            {"angles", significant(number_at(row, "angle_error"))},
            {"angles_left", significant(number_at(row, "angle_left"), 2)},
            {"offsets", significant(number_at(row, "offset_error"))},
            {"ms", ms(value_at(row, "seconds"))},
            {"ms_low", ms(value_at(row, "seconds_low"))},
            {"ms_high", ms(value_at(row, "seconds_high"))}};
}

View time_of(const Json& study) {
    std::vector<View> rows;
    for (const Json& row : array_at(study, "settings")) rows.push_back(time_row(row));
    if (rows.empty()) return false;
    std::string left_out;
    for (const Json& left : array_at(study, "left_out")) {
        if (left.is_string()) left_out += (left_out.empty() ? "" : ", ") + left.get<std::string>();
    }
    return {{"chart_html", chart_figure(draw_chart_svg(fit_time_chart(study)))},
            {"tall", is_tall(rows)},
            {"rows", rows},
            {"left_out", left_out}};
}

View limit_row(const Json& row) {
    const double failed = number_at(row, "failed").value_or(0);
    return {{"readings", whole(number_at(row, "readings"))},
            {"percent", whole(100 * value_at(row, "share"))},
            {"redundancy", decimals(number_at(row, "dof"), 0)},
            {"angles", significant(number_at(row, "angle_error"))},
            {"angle_limit", significant(number_at(row, "angle_limit"))},
            {"ratio", decimals(number_at(row, "ratio"), 3)},
            {"ratio_sigma", decimals(number_at(row, "ratio_sigma"), 3)},
            {"offsets", significant(number_at(row, "offset_error"))},
            {"offset_limit", significant(number_at(row, "offset_limit"))},
            {"draws", whole(number_at(row, "draws"))},
            {"failed", failed > 0 ? fmt::format("{:.0f}", failed) : ""}};
}

View limit_of(const Json& study) {
    std::vector<View> rows;
    for (const Json& row : array_at(study, "limits")) rows.push_back(limit_row(row));
    const std::string message = text_at(study, "limit_message");
    if (rows.empty() && message.empty()) return false;
    return {{"chart_html", chart_figure(draw_chart_svg(limit_chart(study)))},
            {"some", !rows.empty()},
            {"tall", is_tall(rows)},
            {"rows", rows},
            {"made_exact", true_at(study, "limit_made_exact")},
            {"limit_message", message}};
}

}  // namespace

std::string study_table(const std::string& study_json) {
    const Json study = parsed_study<Json>(study_json);
    const std::string unit = text_at(study, "unit");
    std::string text;
    if (!array_at(study, "settings").empty()) {
        text += fmt::format("{:<11} {:<13} {:>6} {:>8} {:>6} {:>10} {:>9} {:>11} {:>9}\n", "what",
                            "setting", "sound", "settled", "best", "angles/deg", "to end",
                            fmt::format("offsets/{}", unit), "CPU/ms");
    }
    for (const Json& row : array_at(study, "settings")) {
        const SweepWords* words = words_of(text_at(row, "sweep"));
        text += fmt::format("{:<11} {:<13} {:>6} {:>8} {:>6} {:>10} {:>11} {:>9}\n",
                            words != nullptr ? words->name : text_at(row, "sweep"),
                            text_at(row, "setting") + (true_at(row, "as_asked") ? " *" : ""),
                            plain_signs(of_fits(row, "sound")),
                            plain_signs(of_fits(row, "settled")), plain_signs(of_fits(row, "best")),
                            plain_signs(significant(number_at(row, "angle_error"))),
                            plain_signs(significant(number_at(row, "offset_error"))),
                            plain_signs(ms(value_at(row, "seconds"))));
    }
    if (!array_at(study, "limits").empty()) {
        text += fmt::format("{}{:>8} {:>7} {:>11} {:>10} {:>9} {:>6} {:>6}\n",
                            text.empty() ? "" : "* as the stone file asks\n\n", "readings", "share",
                            "redundancy", "angles/deg", "limit/deg", "ratio", "+-");
    }
    for (const Json& row : array_at(study, "limits")) {
        text += fmt::format("{:>8} {:>6}% {:>11} {:>10} {:>9} {:>6} {:>6}\n",
                            plain_signs(whole(number_at(row, "readings"))),
                            plain_signs(whole(100 * value_at(row, "share"))),
                            plain_signs(whole(number_at(row, "dof"))),
                            plain_signs(significant(number_at(row, "angle_error"))),
                            plain_signs(significant(number_at(row, "angle_limit"))),
                            plain_signs(decimals(number_at(row, "ratio"), 3)),
                            plain_signs(decimals(number_at(row, "ratio_sigma"), 3)));
    }
    return text;
}

std::string study_time_chart(const std::string& study_json) {
    return draw_chart_svg(fit_time_chart(parsed_study<Json>(study_json)));
}

std::string study_limit_chart(const std::string& study_json) {
    return draw_chart_svg(limit_chart(parsed_study<Json>(study_json)));
}

std::string study_page(const StudyView& view) {
    const Json study = parsed_study<Json>(view.study_json);
    std::string title = view.title.empty() ? text_at(study, "name") : view.title;
    if (title.empty()) title = "Study of a fit";
    std::string status = text_at(study, "status");
    std::replace(status.begin(), status.end(), '_', ' ');
    const std::string body =
        filled(templates::study,
               {{"title", title},
                {"facets", whole(number_at(study, "facets"))},
                {"readings", whole(number_at(study, "readings"))},
                {"good", status == "converged"},
                {"status", status},
                {"message", text_at(study, "message")},
                {"unit", text_at(study, "unit")},
                {"time", time_of(study)},
                {"limit", limit_of(study)},
                {"provenance_html", study_provenance(study, view.version, view.command)}});
    return html_page(title, body, study.dump(-1, ' ', false, Json::error_handler_t::replace));
}

}  // namespace culet
