// The report's scores beside their chance level.

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "compare/report/report_parts.h"
#include "compare/scores/score_list.h"
#include "compare/templates.h"
#include "page/html.h"
#include "page/json_fields.h"
#include "page/parts.h"

namespace culet {

namespace {

using Json = nlohmann::json;

// The null's draws as strokes and the value as a dot; right is better.
View strip(const std::vector<double>& null, const std::optional<double>& value,
           bool higher_is_better) {
    if (null.empty() || !value) return false;
    const auto [least, most] = std::minmax_element(null.begin(), null.end());
    const double low = std::min(*value, *least), high = std::max(*value, *most);
    if (!(high > low)) return false;
    const auto at = [&](double v) {
        const double share = (v - low) / (high - low);
        return fmt::format("{:.1f}", 6 + 148 * (higher_is_better ? share : 1 - share));
    };
    std::vector<View> draws;
    for (const double v : null) draws.push_back(at(v));
    return {{"draws", draws}, {"here", at(*value)}};
}

View score_row(const Json& scores, const std::string& key, const Json& value) {
    const ScoreKind* kind = score_kind(key);
    const int places = kind != nullptr ? kind->decimals : 3;
    const Json null = scores.contains("null") && scores["null"].contains(key) ? scores["null"][key]
                                                                              : Json::object();
    std::vector<double> draws;
    if (null.contains("values") && null["values"].is_array()) {
        for (const Json& v : null["values"]) {
            if (v.is_number()) draws.push_back(v.get<double>());
        }
    }
    const bool higher = !null.contains("higher_is_better") || null["higher_is_better"] == true;
    const std::optional<double> number =
        value.is_number() ? std::optional(value.get<double>()) : std::nullopt;
    const std::string note =
        scores.contains("score_notes") ? text_at(scores["score_notes"], key.c_str()) : "";
    std::string about = kind != nullptr ? kind->about : "";
    if (!note.empty()) about += (about.empty() ? "" : " – ") + note;
    return {{"name", score_name(key)},
            {"higher", higher},
            {"about", about},
            {"value", decimals(number, places)},
            {"mean", decimals(number_at(null, "mean"), places)},
            {"sd", decimals(number_at(null, "sd"), places)},
            {"z", decimals(number_at(null, "z"), 1)},
            {"strip", strip(draws, number, higher)}};
}

}  // namespace

std::string score_name(const std::string& key) {
    const ScoreKind* kind = score_kind(key);
    return kind != nullptr ? kind->name : key;
}

std::string scores_section(const Report& report, const nlohmann::json& scores) {
    if (!report.comparison || !scores.contains("scores") || !scores["scores"].is_object())
        return {};
    // In the table's order, then any others.
    std::vector<View> rows;
    for (const ScoreKind& kind : score_kinds()) {
        if (scores["scores"].contains(kind.key)) {
            rows.push_back(score_row(scores, kind.key, scores["scores"][kind.key]));
        }
    }
    for (const auto& [key, value] : scores["scores"].items()) {
        if (score_kind(key) == nullptr) rows.push_back(score_row(scores, key, value));
    }
    if (rows.empty()) return {};
    const Comparison& c = *report.comparison;
    const std::string word = photo_word(report);
    View light = false, reflexes = false;
    if (c.photo_light > 0) {
        light = {{"photo", decimals(c.photo_light, 3)}, {"render", decimals(c.render_light, 3)}};
    }
    if (c.reflexes.in_photo > 0) {
        const auto& apart = c.reflexes.displacement;
        reflexes = {{"matched", std::to_string(c.reflexes.matched)},
                    {"in_photo", std::to_string(c.reflexes.in_photo)},
                    {"in_render", std::to_string(c.reflexes.in_render)},
                    {"displacement", apart ? decimals(100 * *apart, 2) : "–"}};
    }
    const std::string body =
        filled(templates::report_scores,
               {{"tall", is_tall(rows)},
                {"rows", rows},
                {"null_draws", std::to_string(c.null_draws)},
                {"seed", std::to_string(c.seed)},
                {"null_note", c.null_note},
                {"shares", std::to_string(c.null_draws + 1)},
                {"word", word},
                {"light", light},
                {"reflexes", reflexes},
                {"pixels", std::to_string(c.compared_pixels)},
                {"render_blur", c.render_blur_px > 0 ? decimals(c.render_blur_px, 1) : ""},
                {"saturated", decimals(100 * c.saturated, 1)},
                {"red", significant(c.gain[0], 4)},
                {"green", significant(c.gain[1], 4)},
                {"blue", significant(c.gain[2], 4)}});
    return folded_section("scores", fmt::format("{} scores beside their chance level", rows.size()),
                          body);
}

}  // namespace culet
