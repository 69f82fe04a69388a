// The report's scores beside their chance level.

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "compare/report/report_parts.h"
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
    const auto count = std::count(rows.begin(), rows.end(), '\n');
    const Comparison& c = *report.comparison;
    std::string body = table("Scores beside their chance level",
                             "<th scope=\"col\">Score</th><th scope=\"col\" class=\"n\">Value</th>"
                             "<th scope=\"col\" class=\"n\">Chance level</th>"
                             "<th scope=\"col\" class=\"n\">Over chance (z)</th>"
                             "<th scope=\"col\">Chance | and this picture ●</th>",
                             rows);
    body += fmt::format(
        "<p class=\"note\">↑ more is better, ↓ less is better. Chance level: mean ± standard "
        "deviation of {} draws (seed {}): {}. Over chance: "
        "how many of these deviations the score is better (of atanh for correlations); over 3 "
        "hardly "
        "happens by chance. The smallest share that {} draws can show is 1/{}.</p>\n",
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
    return folded_section("scores", fmt::format("{} scores beside their chance level", count),
                          body);
}

}  // namespace culet
