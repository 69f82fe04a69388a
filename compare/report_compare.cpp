// Sections of the report that come from a comparison: verdict, pictures, maps, scores, outlines.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "compare/pixels.h"
#include "compare/report_parts.h"
#include "page/html.h"
#include "page/json_fields.h"
#include "page/parts.h"

namespace culet {

namespace {

using Json = nlohmann::json;

std::string tile(const std::string& name, const std::string& value, const std::string& about,
                 const char* style = "") {
    return fmt::format("<div class=\"tile {}\"><dt>{}</dt><dd><b>{}</b><span>{}</span></dd></div>",
                       style, escaped(name), value, escaped(about));
}

const Score* score_of(const Comparison& comparison, const char* key) {
    for (const Score& score : comparison.scores) {
        if (score.key == key) return &score;
    }
    return nullptr;
}

std::string comparison_tiles(const Comparison& c) {
    std::string tiles;
    if (c.meaning && c.meaning->equivalent.deg) {
        const EquivalentError& error = c.meaning->equivalent;
        tiles += tile("Equivalent facet error",
                      (error.at_least  ? "≥ "
                       : error.at_most ? "≤ "
                                       : "") +
                          significant(error.deg, 2) + "°",
                      fmt::format("{}° to {}°", significant(error.low_deg, 2),
                                  significant(error.high_deg, 2)));
    }
    if (const Score* zncc = score_of(c, "zncc"); zncc != nullptr) {
        tiles += tile("Pattern of light", decimals(zncc->value, 3),
                      fmt::format("1 is perfect; chance {} ± {}", decimals(zncc->null_mean, 2),
                                  decimals(zncc->null_sd, 2)));
    }
    if (const Score* delta = score_of(c, "deltaE00_mean"); delta != nullptr) {
        tiles += tile("Colour difference", decimals(delta->value, 1),
                      fmt::format("mean ΔE00; chance {} ± {}", decimals(delta->null_mean, 1),
                                  decimals(delta->null_sd, 1)));
    }
    if (c.reflexes.in_photo > 0) {
        tiles +=
            tile("Reflexes found", fmt::format("{} of {}", c.reflexes.matched, c.reflexes.in_photo),
                 c.reflexes.displacement ? fmt::format("{} % of the diameter apart",
                                                       decimals(100 * *c.reflexes.displacement, 1))
                                         : "");
    }
    if (c.registration.iou > 0) {
        tiles += tile("Outlines overlap", decimals(c.registration.iou, 4),
                      fmt::format("{} px apart", decimals(c.registration.residual_px, 2)));
    }
    if (!c.scores.empty()) {
        tiles += tile("Gain R G B",
                      significant(c.gain[0], 2) + " · " + significant(c.gain[1], 2) + " · " +
                          significant(c.gain[2], 2),
                      "factors on the render");
    }
    return tiles;
}

std::string fit_tiles(const Json& fit) {
    if (fit.empty()) return {};
    std::string status = text_at(fit, "status");
    std::replace(status.begin(), status.end(), '_', ' ');
    const auto count = [&](const char* key) {
        return fit.contains(key) && fit[key].is_array() ? fit[key].size() : 0;
    };
    const bool trusted = status == "converged";
    return tile("Fit", escaped(status.empty() ? "–" : status),
                fmt::format("χ² {} of {} degrees of freedom; {}, {} readings",
                            significant(number_at(fit, "chi2")), whole(number_at(fit, "dof")),
                            count("suspects") == 0 ? "no suspects"
                                                   : fmt::format("{} suspect", count("suspects")),
                            count("readings")),
                trusted ? "" : "bad");
}

// What the page's reader must know before believing the verdict.
const char* const k_what_it_means =
    "The chance level is the same render, turned and mirrored in the picture's plane: what outline "
    "and overall brightness reach without any agreement of the pattern. The verdict compares the "
    "pattern of light with that level only. It does not tell this stone from another of the same "
    "cut, and its limits are proposals that have not been validated.";

const char* const k_what_is_calibrated =
    "The equivalent facet error is that of simulated photographs of this stone, in this pose and "
    "light, which score like this photograph. It knows of facets, camera noise and registration; "
    "dust, inclusions, another tone curve or a light that is not quite the scene's count as facet "
    "error too.";

cv::Mat matrix_from(const PixelMap& map) {
    return cv::Mat(map.height, map.width, CV_32F, const_cast<float*>(map.values.data()));
}

std::string map_figure(const PixelMap& map, ColourMap colours, double low, double high,
                       const std::string& title, const std::string& about, const std::string& bar) {
    if (map.values.empty()) return {};
    return fmt::format(
        "<figure class=\"map\"><img src=\"{}\" alt=\"{}\"><figcaption><b>{}</b> {}</figcaption>{}"
        "</figure>\n",
        map_uri(map, colours, low, high), escaped(title + ": " + about), escaped(title),
        escaped(about), bar);
}

/// Outline of a mask as an SVG path, to half a pixel.
std::string outline_path(const PixelMap& map) {
    if (map.values.empty()) return {};
    const cv::Mat inside = matrix_from(map) > 0.5;
    std::vector<std::vector<cv::Point>> outlines;
    cv::findContours(inside, outlines, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
    std::string path;
    for (const auto& outline : outlines) {
        std::vector<cv::Point> points;
        cv::approxPolyDP(outline, points, 0.5, true);
        for (std::size_t i = 0; i < points.size(); ++i) {
            path += fmt::format("{}{:.1f},{:.1f}", i == 0 ? "M" : "L", points[i].x + 0.5,
                                points[i].y + 0.5);
        }
        path += "Z";
    }
    return path;
}

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

VerdictShown verdict_shown(Verdict verdict) {
    switch (verdict) {
        case Verdict::match:
            return {"Match", "good", "✓"};
        case Verdict::partial:
            return {"Partial match", "fair", "≈"};
        case Verdict::no_evidence:
            return {"No evidence of a match", "poor", "?"};
        case Verdict::refused:
            return {"Comparison refused", "bad", "✕"};
    }
    return {"", "", ""};
}

std::string score_name(const std::string& key) {
    const ScoreWords* words = words_for(key);
    return words != nullptr ? words->name : key;
}

std::string map_uri(const PixelMap& map, ColourMap colours, double low, double high) {
    cv::Mat picture(map.height, map.width, CV_8UC4, cv::Scalar(0, 0, 0, 0));
    const cv::Mat values = matrix_from(map);
    for (int y = 0; y < map.height; ++y) {
        for (int x = 0; x < map.width; ++x) {
            const double value = static_cast<double>(values.at<float>(y, x));
            if (std::isnan(value)) continue;
            const auto c = colour_at(colours, (value - low) / (high - low));
            picture.at<cv::Vec4b>(y, x) = {c[2], c[1], c[0], 255};
        }
    }
    return png_uri(png_bytes(picture));
}

std::string picture_uri(const Photo& picture, double white) {
    cv::Mat shown_now;
    encoded(colour_of(picture) * (1 / std::max(white, 1e-30))).convertTo(shown_now, CV_8U, 255);
    return png_uri(png_bytes(shown_now));
}

namespace {

std::string sentence(std::string text) {
    if (!text.empty())
        text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
    return text.empty() || text.back() == '.' ? text : text + ".";
}

}  // namespace

std::string headline_section(const Report& report, const Json& scores, const Json& fit) {
    (void)scores;
    std::string body =
        fmt::format("<header class=\"headline\"><h1>{}</h1>\n", escaped(report.title));
    if (report.comparison) {
        const Comparison& c = *report.comparison;
        const VerdictShown shown_verdict = verdict_shown(c.verdict);
        if (c.simulated) {
            body +=
                "<p class=\"simulated\"><b>Simulated photograph.</b> The photograph on this "
                "page was computed, not taken with a camera.</p>\n";
        }
        if (c.geometry_only) {
            body +=
                "<p class=\"simulated\"><b>Geometry only.</b> This photograph cannot serve for "
                "photometry: scores of brightness and colour are left out, and the verdict rests "
                "on "
                "shapes and places.</p>\n";
        }
        body += fmt::format(
            "<div class=\"verdict {}\"><span class=\"symbol\" aria-hidden=\"true\">{}</span>"
            "<div><p class=\"word\">{}</p><p>{}</p></div></div>\n",
            shown_verdict.style, shown_verdict.symbol, shown_verdict.word,
            escaped(sentence(c.reason)));
    }
    std::string tiles;
    if (report.comparison) tiles += comparison_tiles(*report.comparison);
    tiles += fit_tiles(fit);
    if (!tiles.empty()) body += "<dl class=\"tiles\">" + tiles + "</dl>\n";
    if (report.comparison && report.comparison->usable()) {
        body += fmt::format("<p class=\"meaning\">{}</p>\n",
                            report.comparison->meaning ? k_what_is_calibrated : k_what_it_means);
    }
    return body + "</header>\n";
}

std::string pictures_section(const Report& report) {
    if (!report.comparison) return {};
    const ComparedPictures& pictures = report.comparison->pictures;
    if (pictures.photo.rgb.empty() || pictures.render.rgb.empty()) return {};
    const std::string word = photo_word(report);
    const bool usable = report.comparison->usable();
    std::string body =
        slider("pictures-slider",
               {word, picture_uri(pictures.photo, pictures.white), "The stone in the " + word},
               {"render", picture_uri(pictures.render, pictures.white),
                "The render, laid onto the " + word});
    body += usable ? fmt::format(
                         "<p class=\"note\">The render is moved onto the {} by its outline "
                         "and brought to its exposure and white balance by one factor a "
                         "colour channel. <span class=\"screen\">Drag, or use the arrow "
                         "keys.</span></p>\n",
                         word)
                   : "<p class=\"note\">The render is laid over as well as its outline allows; "
                     "its exposure is its own.</p>\n";
    std::string heading = word + " and render";
    heading[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(heading[0])));
    return section("pictures", heading, body);
}

std::string maps_section(const Report& report) {
    if (!report.comparison) return {};
    const ComparedPictures& p = report.comparison->pictures;
    std::string figures;
    figures +=
        map_figure(p.luminance_difference, ColourMap::difference, -0.5, 0.5, "Brightness",
                   "Render minus " + photo_word(report) + ", encoded luminance.",
                   colour_bar(ColourMap::difference, "blue: render too dark, red: too bright",
                              "−0.5", "0", "+0.5"));
    figures += map_figure(
        p.colour_difference, ColourMap::error, 0, 30, "Colour", "CIEDE2000 of each pixel.",
        colour_bar(ColourMap::error, "1 is just visible, 10 is plain", "0", "15", "≥ 30"));
    figures += map_figure(p.visible_difference, ColourMap::error, 0, 1, "To the eye",
                          "FLIP: what shows when the two are flicked between.",
                          colour_bar(ColourMap::error, "bright: plain to see", "0", "0.5", "1"));
    figures += map_figure(p.similarity, ColourMap::likeness, 0, 1, "Structure",
                          "SSIM of each pixel's neighbourhood.",
                          colour_bar(ColourMap::likeness, "dark: alike", "≤ 0", "0.5", "1"));
    if (figures.empty()) return {};
    return section("maps", "Where they differ", "<div class=\"maps\">" + figures + "</div>\n");
}

std::string scores_section(const Report& report, const Json& scores) {
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

std::string registration_section(const Report& report) {
    if (!report.comparison) return {};
    const Comparison& c = *report.comparison;
    const Photo& photo = c.pictures.photo;
    if (photo.rgb.empty()) return {};
    const std::string word = photo_word(report);
    std::string body = "<div class=\"beside\">\n<figure class=\"overlay\">";
    body += fmt::format(
        "<svg viewBox=\"0 0 {0} {1}\" role=\"img\" aria-label=\"Outlines of the stone in both "
        "pictures over the {2}\"><image href=\"{3}\" width=\"{0}\" height=\"{1}\" "
        "opacity=\"0.55\"/>"
        "<path class=\"outline-photo\" d=\"{4}\"/><path class=\"outline-render\" d=\"{5}\"/></svg>",
        photo.width, photo.height, word, picture_uri(photo, c.pictures.white),
        outline_path(c.pictures.photo_outline), outline_path(c.pictures.render_outline));
    body += fmt::format(
        "<figcaption><span class=\"key-photo\">outline in the {}</span> "
        "<span class=\"key-render\">outline in the render</span></figcaption>"
        "</figure>\n",
        word);
    const Registration& r = c.registration;
    std::string rows;
    const auto row = [&](const std::string& name, const std::string& value) {
        rows +=
            fmt::format("<tr><th scope=\"row\">{}</th><td class=\"n\">{}</td></tr>\n", name, value);
    };
    row("Overlap (area of both over area of either)", decimals(r.iou, 4));
    row("Outlines apart, root mean square", decimals(r.residual_px, 2) + " px");
    row("95 % of the outline closer than", decimals(r.worst_px, 2) + " px");
    row("Shift", decimals(r.shift_px[0], 2) + ", " + decimals(r.shift_px[1], 2) + " px");
    row("Turn, clockwise",
        r.turn_known ? decimals(r.turn_deg, 3) + "°" : "not seen in the outline");
    row("Scale, render over " + word, decimals(r.scale, 5));
    row("Stone in the " + word, decimals(r.photo_diameter_px, 0) + " px across");
    row("Stone in the render", decimals(r.render_diameter_px, 0) + " px across");
    row("Outlines taken from", escaped(r.photo_outline + ", " + r.render_outline));
    body += "<div>" + table("Registration by the outlines",
                            "<th scope=\"col\">Quantity</th>"
                            "<th scope=\"col\" class=\"n\">Value</th>",
                            rows);
    for (const std::string& warning : r.warnings) {
        body += fmt::format("<p class=\"warning\">{}</p>\n", escaped(warning));
    }
    body += "</div>\n</div>\n";
    if (!report.pose_overlay_png.empty()) {
        body += fmt::format(
            "<figure class=\"pose\"><img src=\"{}\" alt=\"The stone's edges over the {}\">"
            "<figcaption>{}</figcaption></figure>\n",
            png_uri(report.pose_overlay_png), word,
            report.pose_used ? "The stone's edges where the pose puts them."
                             : "The best pose that was found. It was not trusted, and the scene's "
                               "own camera was taken.");
    }
    return section("registration", "Registration", body);
}

}  // namespace culet
