#include "page/scene_study_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "page/html.h"
#include "page/json_fields.h"
#include "page/parts.h"
#include "page/scene_study_fields.h"
#include "page/study_sections.h"
#include "page/templates.h"

namespace culet {

namespace {

using Json = nlohmann::json;

// "640 × 480".
std::string pixels(const Json& sides) {
    return sides.size() == 2 && sides[0].is_number() && sides[1].is_number()
               ? fmt::format("{} × {}", sides[0].get<double>(), sides[1].get<double>())
               : std::string("–");
}

std::vector<View> shown_texts_at(const Json& object, const char* key) {
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
    const std::vector<View> left = shown_texts_at(study, "left_out");
    return {{"rows", rows},
            {"noise_rmse", significant(number_at(noise, "rmse"), 2)},
            {"noise_psnr", decimals(number_at(noise, "psnr"), 1)},
            {"noise_colour", decimals(number_at(noise, "deltaE00_mean"), 2)},
            {"noise_flip", decimals(number_at(noise, "flip_mean"), 4)},
            {"some_left", !left.empty()},
            {"left_count", std::to_string(array_at(study, "left_out").size())},
            {"left", left},
            {"notes", shown_texts_at(study, "notes")}};
}

const char* on_or_off(const Json& effect) {
    return true_at(effect, "on") ? "on" : "off";
}

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
                {"chart_html", chart_figure(scene_study_chart(view.study_json))},
                {"front", front_figures(study, view)},
                {"planned", !plans.empty()},
                {"plans", plans},
                {"settings", settings_of(study)},
                {"reference", reference_of(study)},
                {"provenance_html", study_provenance(study, view.version, view.command)}});
    return html_page(title, body, study.dump(-1, ' ', false, Json::error_handler_t::replace));
}

}  // namespace culet
