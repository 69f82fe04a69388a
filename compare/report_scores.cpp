// The report's scores beside their chance level.

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "compare/report_parts.h"
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
    {"zncc", "ZNCC, 2 %", "same places bright and dark, seen through a blur of 2 % of the stone",
     3},
    {"zncc_1pct", "ZNCC, 1 %", "the same, finer", 3},
    {"zncc_4pct", "ZNCC, 4 %", "the same, coarser", 3},
    {"reflex_f1", "Reflexes, F1", "bright spots of one picture found in the other", 3},
    {"reflex_area_f1", "Reflexes, F1 by area", "the same, large spots count more", 3},
    {"reflex_hue", "Reflexes of one hue", "coloured reflexes found that have the photo's hue", 2},
    {"cw_ssim", "CW-SSIM", "are the facets' images where they should be; blind to the light", 3},
    {"ssim", "SSIM", "structure, for comparison with the literature only", 3},
    {"gmsd", "GMSD", "edges alike, for comparison with the literature only", 3},
    {"nmi", "Mutual information", "does one brightness tell the other, whatever the tone curve", 3},
    {"psnr", "PSNR, dB", "error of the encoded colours against full scale", 1},
    {"deltaE00_mean", "ΔE00, mean", "visible colour difference", 2},
    {"deltaE00_p95", "ΔE00, 95 %", "95 % of the stone differ less", 2},
    {"body_deltaE00", "Body colour, ΔE00", "between the mean colours: material and white balance",
     2},
    {"colour_emd", "Colours, EMD", "how far colours must be moved, wherever they are", 2},
    {"facet_tilts_deg", "Facets' tilts, degrees",
     "how much of the difference is what tilted facets change", 3},
    {"flip_mean", "FLIP, mean", "visible difference when the two are flicked between", 3},
};

const ScoreWords* words_for(const std::string& key) {
    for (const ScoreWords& words : k_words) {
        if (words.key == key) return &words;
    }
    return nullptr;
}

// The null's draws as strokes and the value as a dot, better to the right.
std::string strip(const std::vector<double>& null, const std::optional<double>& value,
                  bool higher_is_better) {
    if (null.empty() || !value) return {};
    double low = *value, high = *value;
    for (const double v : null) {
        low = std::min(low, v);
        high = std::max(high, v);
    }
    if (!(high > low)) return {};
    const auto at = [&](double v) {
        const double share = (v - low) / (high - low);
        return 6 + 148 * (higher_is_better ? share : 1 - share);
    };
    std::string svg =
        "<svg class=\"strip\" viewBox=\"0 0 160 20\" role=\"img\" aria-label=\"the draws of the "
        "chance level as strokes, this value as a dot, better to the right\">"
        "<line class=\"axis\" x1=\"6\" y1=\"16\" x2=\"154\" y2=\"16\"/>";
    for (const double v : null) {
        svg += fmt::format(
            "<line class=\"draw\" x1=\"{0:.1f}\" y1=\"5\" x2=\"{0:.1f}\" y2=\"15\"/>", at(v));
    }
    return svg + fmt::format("<circle cx=\"{:.1f}\" cy=\"10\" r=\"5\"/></svg>", at(*value));
}

std::string score_row(const Json& scores, const std::string& key, const Json& value) {
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
    return fmt::format(
        "<tr><th scope=\"row\">{} <span class=\"better\">{}</span><small>{}</small></th>"
        "<td class=\"n strong\">{}</td><td class=\"n\">{} ± {}</td><td class=\"n\">{}</td>"
        "<td>{}</td></tr>\n",
        escaped(words != nullptr ? words->name : key), higher ? "↑" : "↓", escaped(about),
        decimals(number, places), decimals(number_at(null, "mean"), places),
        decimals(number_at(null, "sd"), places), decimals(number_at(null, "z"), 1),
        strip(draws, number, higher));
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
    std::string rows;
    for (const ScoreWords& words : k_words) {
        if (scores["scores"].contains(words.key)) {
            rows += score_row(scores, words.key, scores["scores"][words.key]);
        }
    }
    for (const auto& [key, value] : scores["scores"].items()) {
        if (words_for(key) == nullptr) rows += score_row(scores, key, value);
    }
    if (rows.empty()) return {};
    const Comparison& c = *report.comparison;
    std::string body = table("Scores beside their chance level",
                             "<th scope=\"col\">Score</th><th scope=\"col\" class=\"n\">Value</th>"
                             "<th scope=\"col\" class=\"n\">Chance level</th>"
                             "<th scope=\"col\" class=\"n\">z</th>"
                             "<th scope=\"col\">Chance | and this picture ●</th>",
                             rows);
    body += fmt::format(
        "<p class=\"note\">↑ more is better, ↓ less is better. Chance level: mean ± standard "
        "deviation of {} draws (seed {}): {}. z counts standard deviations from it, of atanh for "
        "correlations; the smallest share that {} draws can show is 1/{}.</p>\n",
        c.null_draws, c.seed, escaped(c.null_note), c.null_draws, c.null_draws + 1);
    if (c.photo_light > 0) {
        body += fmt::format(
            "<p>Light return, as a share of the white level: {} in the {}, {} in the render.</p>\n",
            decimals(c.photo_light, 3), photo_word(report), decimals(c.render_light, 3));
    }
    if (c.reflexes.in_photo > 0) {
        body += fmt::format(
            "<p>{} of the {}'s {} bright reflexes are found in the render, which "
            "has {}; they lie {} % of the diameter apart (median).</p>\n",
            c.reflexes.matched, photo_word(report), c.reflexes.in_photo, c.reflexes.in_render,
            c.reflexes.displacement ? decimals(100 * *c.reflexes.displacement, 2) : "–");
    }
    body += fmt::format(
        "<p class=\"note\">{} pixels compared; {} % of them clipped by the camera and left out of "
        "the "
        "gain. Gain on the render: red {}, green {}, blue {}.</p>\n",
        c.compared_pixels, decimals(100 * c.saturated, 1), significant(c.gain[0], 4),
        significant(c.gain[1], 4), significant(c.gain[2], 4));
    return section("scores", "Scores", body);
}

}  // namespace culet
