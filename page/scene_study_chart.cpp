// The study of a scene as a chart and as text.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "page/chart.h"
#include "page/html.h"
#include "page/json_fields.h"
#include "page/quantity.h"
#include "page/scene_study_fields.h"
#include "page/scene_study_page.h"

namespace culet {

namespace {

using Json = nlohmann::json;

// Every setting by its engine; the front as one line, the automatic settings as another.
Chart picture_time_chart(const Json& study) {
    Chart chart;
    chart.title = "What accuracy costs in time";
    chart.about =
        "Error against processor time of each way of drawing the scene, both logarithmic, with "
        "the front of those that no other beats in both.";
    chart.x_label = "processor time of one picture, ms";
    chart.y_label = "mean error, of the mean radiance";
    const auto point = [](const Json& row, const std::string& label) {
        return ChartPoint{1000 * value_at(row, "cpu_seconds"),
                          value_at(row, "claimed_error"),
                          label,
                          fmt::format("{}: {} ms, error {}", words_in(row), ms(row), error_of(row)),
                          std::nan(""),
                          std::nan(""),
                          true_at(row, "at_noise")};
    };
    ChartSeries front{"front", {}, true, false, false};
    for (const Json* row : front_of(study)) front.points.push_back(point(*row, ""));
    chart.series.push_back(std::move(front));
    for (const char* engine : {"beams", "preview", "reference"}) {
        ChartSeries series{engine, {}, false, true, false};
        for (const Json& row : array_at(study, "settings")) {
            if (text_at(row, "engine") == engine && !true_at(row, "automatic"))
                series.points.push_back(point(row, ""));
        }
        if (!series.points.empty()) chart.series.push_back(std::move(series));
    }
    ChartSeries automatic{"automatic", {}, true, true, false};
    for (const Json& row : array_at(study, "settings")) {
        if (true_at(row, "automatic")) automatic.points.push_back(point(row, tolerance_of(row)));
    }
    if (!automatic.points.empty()) chart.series.push_back(std::move(automatic));
    // As wide as the range of the settings.
    double least = INFINITY, most = 0;
    for (const Json& row : array_at(study, "settings")) {
        const double at = 1000 * value_at(row, "cpu_seconds");
        if (!(at > 0)) continue;
        least = std::min(least, at);
        most = std::max(most, at);
    }
    const double noise = noise_of(study);
    if (most > 0 && noise > 0) {
        chart.series.push_back(
            {"noise", {{least, noise, {}, {}}, {most, noise, {}, {}}}, true, false, true});
    }
    return chart;
}

}  // namespace

std::string scene_study_chart(const std::string& study_json) {
    return draw_chart_svg(picture_time_chart(parsed_study<Json>(study_json)));
}

std::string scene_study_table(const std::string& study_json) {
    const Json study = parsed_study<Json>(study_json);
    std::string text;
    for (const Json* row : front_of(study)) {
        if (text.empty()) {
            text = fmt::format("{:>9} {:>9} {:>9} {:>9} {:>7} {:>7}  {}\n", "CPU/ms", "wall/ms",
                               "error", "RMSE", "dE00", "FLIP", "best setting");
        }
        text += fmt::format("{:>9} {:>9} {:>9} {:>9} {:>7} {:>7}  {}\n", plain_signs(ms(*row)),
                            plain_signs(ms(*row, "wall_seconds")), plain_signs(error_of(*row)),
                            plain_signs(significant(number_at(*row, "rmse"), 2)),
                            plain_signs(decimals(number_at(*row, "deltaE00_mean"), 2)),
                            plain_signs(decimals(number_at(*row, "flip_mean"), 4)), words_in(*row));
    }
    if (!array_at(study, "recommendations").empty()) text += "\n";
    for (const Json& advice : array_at(study, "recommendations"))
        text += text_at(advice, "words") + "\n";
    return text;
}

}  // namespace culet
