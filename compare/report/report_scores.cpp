// The report's scores beside their chance level.

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "compare/report/report_parts.h"
#include "compare/templates.h"
#include "page/html.h"
#include "page/json_fields.h"
#include "page/parts.h"

namespace culet {

namespace {

using Json = nlohmann::json;

struct ScoreWords {
    const char *key, *name, *about;
    int places;
};

constexpr ScoreWords k_words[] = {
    {"zncc", "Pattern of light",
     "ZNCC at 2 %: the same places bright and dark, seen through a blur of 2 % of the stone; 1 is "
     "perfect",
     3},
    {"zncc_1pct", "Pattern of light, finer", "ZNCC at 1 %: the same through half the blur", 3},
    {"zncc_4pct", "Pattern of light, coarser", "ZNCC at 4 %: the same through twice the blur", 3},
    {"reflex_f1", "Bright spots found",
     "F1: bright spots of one picture found in the other, 0 to 1", 3},
    {"reflex_area_f1", "Bright spots found, by area", "the same, large spots count more", 3},
    {"reflex_hue", "Bright spots of one hue",
     "of the coloured spots that were found, those with the photo's hue, 0 to 1", 2},
    {"cw_ssim", "Facets' images in place",
     "CW-SSIM: are the facets' images where they should be; hardly minds the light; 1 is perfect",
     3},
    {"ssim", "Structure",
     "SSIM: likeness of each neighbourhood; for comparison with the literature only", 3},
    {"gmsd", "Edges",
     "GMSD: how differently sharp the edges are, 0 is alike; for comparison with the literature "
     "only",
     3},
    {"nmi", "Brightness told by brightness",
     "mutual information: does one picture's brightness tell the other's, whatever the tone curve",
     3},
    {"psnr", "Error of the colours, dB",
     "PSNR: error of the encoded colours against full scale, 10 dB more is a third of it", 1},
    {"deltaE00_mean", "Colour difference", "ΔE00 (CIEDE2000), mean: 1 is just visible", 2},
    {"deltaE00_p95", "Colour difference, nearly all", "ΔE00 that 95 % of the stone stay under", 2},
    {"body_deltaE00", "Body colour difference",
     "ΔE00 between the mean colours: material and white balance", 2},
    {"colour_emd", "Colours, wherever they are",
     "EMD (earth mover's distance): how far colours must be moved to be the photo's", 2},
    {"facet_tilts_deg", "Tilted facets, °",
     "how much of the difference is what tilted facets change", 3},
    {"flip_mean", "Difference to the eye",
     "FLIP, mean: what shows when the two are flicked between, 0 is nothing", 3},
};

const ScoreWords* words_for(const std::string& key) {
    for (const ScoreWords& words : k_words) {
        if (words.key == key) return &words;
    }
    return nullptr;
}

// The null's draws as strokes and the value as a dot, better to the right.
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
    const ScoreWords* words = words_for(key);
    const int places = words != nullptr ? words->places : 3;
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
    std::string about = words != nullptr ? words->about : "";
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
    const ScoreWords* words = words_for(key);
    return words != nullptr ? words->name : key;
}

std::string scores_section(const Report& report, const nlohmann::json& scores) {
    if (!report.comparison || !scores.contains("scores") || !scores["scores"].is_object())
        return {};
    // In the order of the words, then whatever else there is.
    std::vector<View> rows;
    for (const ScoreWords& words : k_words) {
        if (scores["scores"].contains(words.key)) {
            rows.push_back(score_row(scores, words.key, scores["scores"][words.key]));
        }
    }
    for (const auto& [key, value] : scores["scores"].items()) {
        if (words_for(key) == nullptr) rows.push_back(score_row(scores, key, value));
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
        filled(templates::report_scores, {{"tall", is_tall(rows)},
                                          {"rows", rows},
                                          {"null_draws", std::to_string(c.null_draws)},
                                          {"seed", std::to_string(c.seed)},
                                          {"null_note", c.null_note},
                                          {"shares", std::to_string(c.null_draws + 1)},
                                          {"word", word},
                                          {"light", light},
                                          {"reflexes", reflexes},
                                          {"pixels", std::to_string(c.compared_pixels)},
                                          {"saturated", decimals(100 * c.saturated, 1)},
                                          {"red", significant(c.gain[0], 4)},
                                          {"green", significant(c.gain[1], 4)},
                                          {"blue", significant(c.gain[2], 4)}});
    return folded_section("scores", fmt::format("{} scores beside their chance level", rows.size()),
                          body);
}

}  // namespace culet
