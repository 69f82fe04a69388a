#include "page/scene_study_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "page/chart.h"
#include "page/html.h"
#include "page/json_fields.h"
#include "page/parts.h"
#include "page/study_sections.h"
#include "page/templates.h"

namespace culet {

namespace {

using Json = nlohmann::json;

Json object_at(const Json& object, const char* key) {
    if (!object.is_object() || !object.contains(key) || !object[key].is_object())
        return Json::object();
    return object[key];
}

// Nothing for an id that is not there.
const Json* row_of(const Json& study, const std::optional<double>& id) {
    if (!id) return nullptr;
    for (const Json& row : array_at(study, "settings")) {
        if (number_at(row, "id") == id) return &row;
    }
    return nullptr;
}

std::vector<const Json*> front_of(const Json& study) {
    std::vector<const Json*> rows;
    for (const Json& id : array_at(study, "front")) {
        if (!id.is_number()) continue;
        if (const Json* row = row_of(study, id.get<double>())) rows.push_back(row);
    }
    return rows;
}

std::string words_in(const Json& row) {
    const std::string words = text_at(row, "words");
    return words.empty() ? text_at(row, "setting") : words;
}

std::string ms(const Json& row, const char* key = "cpu_seconds") {
    const auto seconds = number_at(row, key);
    return seconds ? significant(1000 * *seconds) : "–";
}

std::string error_of(const Json& row) {
    return (true_at(row, "at_noise") ? "≤ " : "") + significant(number_at(row, "claimed_error"), 2);
}

// As people write tolerances: 0.1, 0.003.
std::string tolerance_of(const Json& row) {
    return fmt::format("{:g}", value_at(row, "tolerance"));
}

double noise_of(const Json& study) {
    return value_at(object_at(object_at(study, "reference"), "noise"), "error");
}

// Every setting by its engine; the front as a line, the automatic settings as another.
Chart time_chart(const Json& study) {
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
    // As wide as the settings are.
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

// "640 × 480".
std::string pixels(const Json& sides) {
    return sides.size() == 2 && sides[0].is_number() && sides[1].is_number()
               ? fmt::format("{} × {}", sides[0].get<double>(), sides[1].get<double>())
               : std::string("–");
}

std::vector<View> texts_at(const Json& object, const char* key) {
    std::vector<View> texts;
    for (const Json& one : array_at(object, key)) {
        if (one.is_string()) texts.push_back(one.get<std::string>());
    }
    return texts;
}

View advice_of(const Json& study) {
    std::vector<View> rows, words;
    for (const Json& advice : array_at(study, "recommendations")) {
        const Json* cheapest = row_of(study, number_at(advice, "cheapest"));
        const Json* own = row_of(study, number_at(advice, "automatic"));
        const auto ratio = number_at(advice, "automatic_over_cheapest");
        rows.push_back({{"tolerance", tolerance_of(advice)},
                        {"cheapest", cheapest ? words_in(*cheapest) : "none"},
                        {"cheapest_ms", cheapest ? ms(*cheapest) : "–"},
                        {"cheapest_error", cheapest ? error_of(*cheapest) : "–"},
                        {"own_ms", own ? ms(*own) : "–"},
                        {"own_error", own ? error_of(*own) : "–"},
                        {"over", own && !true_at(advice, "automatic_meets")},
                        {"ratio", ratio ? decimals(ratio, 2) + "×" : "–"}});
        const std::string line = text_at(advice, "words");
        if (!line.empty()) words.push_back(line);
    }
    if (rows.empty()) return false;
    return {{"tall", is_tall(rows)}, {"rows", rows}, {"words", words}};
}

std::string effects_words(const Json& row) {
    std::string on, off;
    for (const Json& effect : array_at(row, "effects")) {
        std::string& list = true_at(effect, "on") ? on : off;
        list += (list.empty() ? "" : ", ") + text_at(effect, "name");
    }
    return fmt::format("on: {}; off: {}", on.empty() ? "none" : on, off.empty() ? "none" : off);
}

View front_figures(const Json& study, const SceneStudyView& view) {
    const auto pictures_of = [&](double id) {
        return std::find_if(view.pictures.begin(), view.pictures.end(),
                            [&](const SceneStudyPicture& p) { return p.id == id; });
    };
    std::vector<View> figures;
    if (const auto truth = pictures_of(-1); truth != view.pictures.end()) {
        const auto seconds = number_at(object_at(study, "reference"), "cpu_seconds");
        figures.push_back({{"picture", truth->picture},
                           {"difference", ""},
                           {"name", "The reference"},
                           {"about", fmt::format("{} s, noise {}", significant(seconds),
                                                 significant(noise_of(study), 2))},
                           {"effects", ""},
                           {"bar_html", ""}});
    }
    for (const Json* row : front_of(study)) {
        const auto shown = pictures_of(value_at(*row, "id"));
        if (shown == view.pictures.end()) continue;
        const std::string scale = significant(shown->difference_scale, 2);
        figures.push_back(
            {{"picture", shown->picture},
             {"difference", shown->difference},
             {"name", fmt::format("{} ms, error {}", ms(*row), error_of(*row))},
             {"about", words_in(*row)},
             {"effects", effects_words(*row)},
             {"bar_html", colour_bar(ColourMap::difference, "difference, of the mean radiance",
                                     "−" + scale, "0", "+" + scale)}});
    }
    if (figures.empty()) return false;
    return {{"figures", figures}};
}

View setting_row(const Json& row) {
    return {{"setting", text_at(row, "sweep") == "search" ? "" : text_at(row, "setting")},
            {"on_front", true_at(row, "front")},
            {"sweep", text_at(row, "sweep")},
            {"words", words_in(row)},
            {"effects", effects_words(row)},
            {"ms", ms(row)},
            {"least_ms", ms(row, "cpu_least")},
            {"most_ms", ms(row, "cpu_most")},
            {"wall_ms", ms(row, "wall_seconds")},
            {"runs", whole(number_at(row, "runs"))},
            {"error", error_of(row)},
            {"rmse", significant(number_at(row, "rmse"), 2)},
            {"psnr", decimals(number_at(row, "psnr"), 1)},
            {"colour", decimals(number_at(row, "deltaE00_mean"), 2)},
            {"colour_worst", decimals(number_at(row, "deltaE00_p95"), 1)},
            {"flip", decimals(number_at(row, "flip_mean"), 4)}};
}

View settings_of(const Json& study) {
    std::vector<View> rows;
    for (const Json& row : array_at(study, "settings")) rows.push_back(setting_row(row));
    if (rows.empty()) return false;
    const Json noise = object_at(object_at(study, "reference"), "noise");
    const std::vector<View> left = texts_at(study, "left_out");
    return {{"rows", rows},
            {"noise_rmse", significant(number_at(noise, "rmse"), 2)},
            {"noise_psnr", decimals(number_at(noise, "psnr"), 1)},
            {"noise_colour", decimals(number_at(noise, "deltaE00_mean"), 2)},
            {"noise_flip", decimals(number_at(noise, "flip_mean"), 4)},
            {"some_left", !left.empty()},
            {"left_count", std::to_string(array_at(study, "left_out").size())},
            {"left", left},
            {"notes", texts_at(study, "notes")}};
}

const char* on_or_off(const Json& effect) {
    return true_at(effect, "on") ? "on" : "off";
}

// What the automatic settings decided, tolerance by tolerance.
std::vector<View> plans_of(const Json& study) {
    std::vector<View> plans;
    for (const Json& row : array_at(study, "settings")) {
        const Json plan = object_at(row, "plan");
        std::vector<View> items;
        for (const Json& item : array_at(plan, "items")) {
            items.push_back({{"name", text_at(item, "name")},
                             {"on", on_or_off(item)},
                             {"fidelity", text_at(item, "fidelity")},
                             {"why", text_at(item, "why")},
                             {"bound", significant(number_at(item, "error_bound"), 2)}});
        }
        if (items.empty()) continue;
        plans.push_back({{"tolerance", tolerance_of(row)},
                         {"words", words_in(row)},
                         {"error", error_of(row)},
                         {"bound", significant(number_at(row, "error_bound"), 2)},
                         {"ms", ms(row)},
                         {"engine", text_at(plan, "engine")},
                         {"why", text_at(plan, "engine_why")},
                         {"tall", is_tall(items)},
                         {"items", items}});
    }
    return plans;
}

View reference_of(const Json& study) {
    const Json reference = object_at(study, "reference");
    std::vector<View> effects;
    for (const Json& effect : array_at(reference, "effects")) {
        effects.push_back({{"name", text_at(effect, "name")},
                           {"on", on_or_off(effect)},
                           {"why", text_at(effect, "why")}});
    }
    if (effects.empty()) return false;
    return {{"tall", is_tall(effects)},
            {"effects", effects},
            {"seconds", significant(number_at(reference, "cpu_seconds"))},
            {"ended", text_at(reference, "ended")},
            {"bound", significant(number_at(reference, "error_bound"), 2)}};
}

}  // namespace

std::string scene_study_table(const std::string& study_json) {
    const Json study = parsed_study<Json>(study_json);
    std::string text;
    const auto plain = [](std::string cell) {
        for (const auto& [from, to] : {std::pair("−", "-"), std::pair("–", "-"),
                                       std::pair("≤ ", "<="), std::pair("×", "x")}) {
            for (std::size_t at = cell.find(from); at != std::string::npos; at = cell.find(from))
                cell.replace(at, std::string(from).size(), to);
        }
        return cell;
    };
    for (const Json* row : front_of(study)) {
        if (text.empty()) {
            text = fmt::format("{:>9} {:>9} {:>9} {:>9} {:>7} {:>7}  {}\n", "CPU/ms", "wall/ms",
                               "error", "RMSE", "dE00", "FLIP", "setting on the front");
        }
        text += fmt::format("{:>9} {:>9} {:>9} {:>9} {:>7} {:>7}  {}\n", plain(ms(*row)),
                            plain(ms(*row, "wall_seconds")), plain(error_of(*row)),
                            plain(significant(number_at(*row, "rmse"), 2)),
                            plain(decimals(number_at(*row, "deltaE00_mean"), 2)),
                            plain(decimals(number_at(*row, "flip_mean"), 4)), words_in(*row));
    }
    if (!array_at(study, "recommendations").empty()) text += "\n";
    for (const Json& advice : array_at(study, "recommendations"))
        text += text_at(advice, "words") + "\n";
    return text;
}

std::string scene_study_chart(const std::string& study_json) {
    return draw_chart_svg(time_chart(parsed_study<Json>(study_json)));
}

std::string scene_study_page(const SceneStudyView& view) {
    const Json study = parsed_study<Json>(view.study_json);
    std::string title = view.title.empty() ? text_at(study, "name") : view.title;
    if (title.empty()) title = "Study of a scene";
    const Json reference = object_at(study, "reference");
    const Json &size = array_at(study, "size"), &scene = array_at(study, "scene_size");
    const bool rough = value_at(reference, "rough_samples") > 0;
    const std::vector<View> plans = plans_of(study);
    const std::string body =
        filled(templates::scene_study,
               {{"title", title},
                {"count", std::to_string(array_at(study, "settings").size())},
                {"pixels", pixels(size)},
                {"wavelengths", whole(number_at(reference, "wavelengths"))},
                {"samples", whole(number_at(reference, "samples"))},
                {"rough_samples", rough ? whole(number_at(reference, "rough_samples")) : ""},
                {"scene_pixels", size != scene ? pixels(scene) : ""},
                {"usable", true_at(study, "usable")},
                {"noise", significant(noise_of(study), 2)},
                {"advice", advice_of(study)},
                {"chart_html", chart_figure(draw_chart_svg(time_chart(study)))},
                {"front", front_figures(study, view)},
                {"planned", !plans.empty()},
                {"plans", plans},
                {"settings", settings_of(study)},
                {"reference", reference_of(study)},
                {"provenance_html", study_provenance(study, view.version, view.command)}});
    return html_page(title, body, study.dump(-1, ' ', false, Json::error_handler_t::replace));
}

}  // namespace culet
