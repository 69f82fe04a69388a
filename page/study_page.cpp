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
#include "page/study_sections.h"

namespace culet {

namespace {

using Json = nlohmann::json;

struct SweepWords {
    const char *sweep, *name, *about;
    bool line;  // its settings are in an order
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

Chart time_chart(const Json& study) {
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
            // Some of its fits found no stone: the error is that of the others.
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

std::string time_table(const Json& study, const std::string& unit) {
    std::string rows;
    for (const Json& row : array_at(study, "settings")) {
        const std::string sweep = text_at(row, "sweep");
        const SweepWords* words = words_of(sweep);
        rows += fmt::format(
            "<tr><th scope=\"row\">{}</th><td>{}{}</td><td class=\"n\">{}</td>"
            "<td class=\"n\">{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td>"
            "<td class=\"n\">{}</td><td class=\"n\">{}</td>"
            "<td class=\"n\">{} <small>{} … {}</small></td></tr>\n",
            escaped(words != nullptr ? words->name : sweep), escaped(text_at(row, "setting")),
            true_at(row, "as_asked") ? " <small>as asked</small>" : "", of_fits(row, "sound"),
            of_fits(row, "settled"), of_fits(row, "best"),
            significant(number_at(row, "angle_error")),
            significant(number_at(row, "angle_left"), 2),
            significant(number_at(row, "offset_error")), ms(value_at(row, "seconds")),
            ms(value_at(row, "seconds_low")), ms(value_at(row, "seconds_high")));
    }
    if (rows.empty()) return {};
    return table("Error and time of each way of fitting",
                 fmt::format("<th scope=\"col\">What</th><th scope=\"col\">Setting</th>"
                             "<th scope=\"col\" class=\"n\">Sound</th>"
                             "<th scope=\"col\" class=\"n\">Settled</th>"
                             "<th scope=\"col\" class=\"n\">Best</th>"
                             "<th scope=\"col\" class=\"n\">Angles, °</th>"
                             "<th scope=\"col\" class=\"n\">From the end, °</th>"
                             "<th scope=\"col\" class=\"n\">Offsets, {}</th>"
                             "<th scope=\"col\" class=\"n\">Processor time, ms</th>",
                             escaped(unit)),
                 rows);
}

std::string limit_table(const Json& study, const std::string& unit) {
    std::string rows;
    for (const Json& row : array_at(study, "limits")) {
        const double failed = number_at(row, "failed").value_or(0);
        rows += fmt::format(
            "<tr><th scope=\"row\">{} <small>{} %</small></th><td class=\"n\">{}</td>"
            "<td class=\"n\">{}</td><td class=\"n\">{}</td><td class=\"n strong\">{} <small>± "
            "{}</small></td><td class=\"n\">{}</td><td class=\"n\">{}</td><td "
            "class=\"n\">{}{}</td></tr>\n",
            whole(number_at(row, "readings")), whole(100 * value_at(row, "share")),
            decimals(number_at(row, "dof"), 0), significant(number_at(row, "angle_error")),
            significant(number_at(row, "angle_limit")), decimals(number_at(row, "ratio"), 3),
            decimals(number_at(row, "ratio_sigma"), 3), significant(number_at(row, "offset_error")),
            significant(number_at(row, "offset_limit")), whole(number_at(row, "draws")),
            failed > 0 ? fmt::format(", {:.0f} failed", failed) : "");
    }
    if (rows.empty()) return {};
    return table("Error and limit as readings are taken away",
                 fmt::format("<th scope=\"col\">Readings</th><th scope=\"col\" class=\"n\">"
                             "Redundancy</th><th scope=\"col\" class=\"n\">Angles, °</th>"
                             "<th scope=\"col\" class=\"n\">Limit, °</th>"
                             "<th scope=\"col\" class=\"n\">Ratio</th>"
                             "<th scope=\"col\" class=\"n\">Offsets, {0}</th>"
                             "<th scope=\"col\" class=\"n\">Limit, {0}</th>"
                             "<th scope=\"col\" class=\"n\">Draws</th>",
                             escaped(unit)),
                 rows);
}

std::string headline(const Json& study, const std::string& title) {
    std::string status = text_at(study, "status");
    std::replace(status.begin(), status.end(), '_', ' ');
    const bool good = status == "converged";
    return fmt::format(
        "<header class=\"headline\"><h1>{}</h1>\n<p>{} facets, {} readings. The stone as fitted is "
        "taken for the truth, its readings are drawn anew with errors of their own σ, and fitted "
        "again.</p>\n<p><span class=\"badge {}\">{}</span> {}</p></header>\n",
        escaped(title), whole(number_at(study, "facets")), whole(number_at(study, "readings")),
        good ? "good" : "bad", escaped(status.empty() ? "status unknown" : status),
        escaped(text_at(study, "message")));
}

std::string notes_of(const Json& study) {
    std::string list;
    for (const Json& left : array_at(study, "left_out")) {
        if (left.is_string()) list += (list.empty() ? "" : ", ") + left.get<std::string>();
    }
    return list.empty() ? ""
                        : fmt::format("<p class=\"note\">Not reached within the budget: {}.</p>\n",
                                      escaped(list));
}

}  // namespace

std::string study_table(const std::string& study_json) {
    const Json study = parsed_study<Json>(study_json);
    const std::string unit = text_at(study, "unit");
    const auto plain = [](std::string text) {
        for (const auto& [from, to] : {std::pair("−", "-"), std::pair("–", "-")}) {
            for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from)) {
                text.replace(at, std::string(from).size(), to);
            }
        }
        return text;
    };
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
                            plain(of_fits(row, "sound")), plain(of_fits(row, "settled")),
                            plain(of_fits(row, "best")),
                            plain(significant(number_at(row, "angle_error"))),
                            plain(significant(number_at(row, "offset_error"))),
                            plain(ms(value_at(row, "seconds"))));
    }
    if (!array_at(study, "limits").empty()) {
        text += fmt::format("{}{:>8} {:>7} {:>11} {:>10} {:>9} {:>6} {:>6}\n",
                            text.empty() ? "" : "* as the stone file asks\n\n", "readings", "share",
                            "redundancy", "angles/deg", "limit/deg", "ratio", "+-");
    }
    for (const Json& row : array_at(study, "limits")) {
        text += fmt::format(
            "{:>8} {:>6}% {:>11} {:>10} {:>9} {:>6} {:>6}\n",
            plain(whole(number_at(row, "readings"))), plain(whole(100 * value_at(row, "share"))),
            plain(whole(number_at(row, "dof"))), plain(significant(number_at(row, "angle_error"))),
            plain(significant(number_at(row, "angle_limit"))),
            plain(decimals(number_at(row, "ratio"), 3)),
            plain(decimals(number_at(row, "ratio_sigma"), 3)));
    }
    return text;
}

std::string study_time_chart(const std::string& study_json) {
    return draw_chart_svg(time_chart(parsed_study<Json>(study_json)));
}

std::string study_limit_chart(const std::string& study_json) {
    return draw_chart_svg(limit_chart(parsed_study<Json>(study_json)));
}

std::string study_page(const StudyView& view) {
    const Json study = parsed_study<Json>(view.study_json);
    const std::string unit = text_at(study, "unit");
    std::string title = view.title.empty() ? text_at(study, "name") : view.title;
    if (title.empty()) title = "Study of a fit";
    std::string body = headline(study, title);
    std::string time = chart_figure(draw_chart_svg(time_chart(study))) + time_table(study, unit);
    if (!array_at(study, "settings").empty()) {
        time +=
            "<p class=\"note\">Angles and offsets: root mean square over facets and draws, against "
            "the truth. From the end: likewise against the fit as asked of the same readings, what "
            "the arithmetic leaves undone. Sound: a closed stone with every facet. Settled: the "
            "search ended by "
            "itself. Best: as good a fit as any start gave. Time: median and quartiles of one fit, "
            "uncertainties included. Hollow points: some fits found no stone.</p>\n" +
            notes_of(study);
    }
    body += section("time", "What accuracy costs in time", time);
    std::string limit = chart_figure(draw_chart_svg(limit_chart(study))) + limit_table(study, unit);
    const std::string message = text_at(study, "limit_message");
    if (!limit.empty() || !message.empty()) {
        limit += fmt::format(
            "<p class=\"note\">Readings go in the order of their redundancy: first those that the "
            "others tell already. The limit (Cramér-Rao) is the smallest error that any unbiased "
            "way of fitting can have with these readings; numbers in the chart are measured error "
            "over limit.{}{}</p>\n",
            true_at(study, "limit_made_exact")
                ? " Meets and symmetries are exact here, whatever the stone file says: soft ones "
                  "are readings of a kind that cannot be drawn anew."
                : "",
            message.empty() ? "" : " The table ends here: " + escaped(message) + ".");
    }
    body += section("limit", "How near to the theoretical limit", limit);
    body += study_provenance(study, view.version, view.command);
    return html_page(title, body, study.dump(-1, ' ', false, Json::error_handler_t::replace));
}

}  // namespace culet
