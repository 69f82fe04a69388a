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

std::string headline(const Json& study, const std::string& title) {
    const Json reference = object_at(study, "reference");
    const Json& size = array_at(study, "size");
    const Json& scene = array_at(study, "scene_size");
    const auto pixels = [](const Json& sides) {
        return sides.size() == 2 && sides[0].is_number() && sides[1].is_number()
                   ? fmt::format("{} × {}", sides[0].get<double>(), sides[1].get<double>())
                   : std::string("–");
    };
    const bool usable = true_at(study, "usable");
    std::string text = fmt::format(
        "<header class=\"headline\"><h1>{}</h1>\n<p>{} ways of drawing this scene, at {} pixels, "
        "each held against the reference renderer with everything on: {} wavelengths, {} rays a "
        "pixel{}.</p>\n",
        escaped(title), array_at(study, "settings").size(), pixels(size),
        whole(number_at(reference, "wavelengths")), whole(number_at(reference, "samples")),
        value_at(reference, "rough_samples") > 0
            ? fmt::format(" and {} rough ones", whole(number_at(reference, "rough_samples")))
            : std::string());
    if (size != scene) {
        text += fmt::format(
            "<p class=\"note\">The scene's own picture has {} pixels. The study draws it smaller, "
            "so that the reference is affordable: edges then fill more of the pixels, errors are "
            "larger, and times are not simply proportional (<code>--size</code>).</p>\n",
            pixels(scene));
    }
    text += fmt::format(
        "<p><span class=\"badge {}\">{}</span> {}</p></header>\n", usable ? "good" : "bad",
        usable ? "judged" : "not to be trusted",
        usable ? fmt::format("The reference itself may be off by {} of the mean (its noise): no "
                             "error below that is claimed.",
                             significant(noise_of(study), 2))
               : fmt::format("The reference itself may be off by {} of the mean, or the automatic "
                             "settings were not drawn: give it more time (<code>--budget</code>).",
                             significant(noise_of(study), 2)));
    return text;
}

std::string advice_section(const Json& study) {
    std::string rows, words;
    for (const Json& advice : array_at(study, "recommendations")) {
        const Json* cheapest = row_of(study, number_at(advice, "cheapest"));
        const Json* own = row_of(study, number_at(advice, "automatic"));
        const auto ratio = number_at(advice, "automatic_over_cheapest");
        rows += fmt::format(
            "<tr><th scope=\"row\" class=\"n\">{}</th><td>{}</td><td class=\"n\">{}</td>"
            "<td class=\"n\">{}</td><td class=\"n\">{}</td><td class=\"n\">{}{}</td>"
            "<td class=\"n strong\">{}</td></tr>\n",
            tolerance_of(advice), cheapest ? escaped(words_in(*cheapest)) : "none",
            cheapest ? ms(*cheapest) : "–", cheapest ? error_of(*cheapest) : "–",
            own ? ms(*own) : "–", own ? error_of(*own) : "–",
            own && !true_at(advice, "automatic_meets") ? " <span class=\"badge\">over</span>" : "",
            ratio ? decimals(ratio, 2) + "×" : "–");
        std::string line = text_at(advice, "words");
        if (!line.empty()) words += fmt::format("<li>{}</li>\n", escaped(line));
    }
    if (rows.empty()) return {};
    return section(
        "advice", "What to take",
        table("The cheapest setting found for each tolerance, and the automatic one",
              "<th scope=\"col\" class=\"n\">Tolerance</th><th scope=\"col\">Cheapest setting</th>"
              "<th scope=\"col\" class=\"n\">CPU, ms</th><th scope=\"col\" class=\"n\">Error</th>"
              "<th scope=\"col\" class=\"n\">Automatic, ms</th>"
              "<th scope=\"col\" class=\"n\">Error</th>"
              "<th scope=\"col\" class=\"n\">Time over cheapest</th>",
              rows) +
            "<ul>\n" + words + "</ul>\n");
}

std::string effects_words(const Json& row) {
    std::string on, off;
    for (const Json& effect : array_at(row, "effects")) {
        std::string& list = true_at(effect, "on") ? on : off;
        list += (list.empty() ? "" : ", ") + text_at(effect, "name");
    }
    return fmt::format("on: {}; off: {}", on.empty() ? "none" : on, off.empty() ? "none" : off);
}

std::string front_section(const Json& study, const SceneStudyView& view) {
    const auto pictures_of = [&](double id) {
        return std::find_if(view.pictures.begin(), view.pictures.end(),
                            [&](const SceneStudyPicture& p) { return p.id == id; });
    };
    // Two pictures beside each other, or one.
    const auto figure = [](const std::string& uri, const std::string& difference,
                           const std::string& title, const std::string& about,
                           const std::string& bar) {
        return fmt::format(
            "<figure class=\"pair\"><img src=\"{}\" alt=\"{}\">{}<figcaption><b>{}</b> {}{}"
            "</figcaption></figure>\n",
            escaped(uri), escaped(title),
            difference.empty() ? ""
                               : fmt::format("<img src=\"{}\" alt=\"Difference to the reference\">",
                                             escaped(difference)),
            escaped(title), about, bar);
    };
    std::string figures;
    if (const auto truth = pictures_of(-1); truth != view.pictures.end()) {
        const Json reference = object_at(study, "reference");
        figures +=
            figure(truth->picture, "", "The reference",
                   fmt::format("{} s, noise {}", significant(number_at(reference, "cpu_seconds")),
                               significant(noise_of(study), 2)),
                   "");
    }
    for (const Json* row : front_of(study)) {
        const auto shown = pictures_of(value_at(*row, "id"));
        if (shown == view.pictures.end()) continue;
        const std::string scale = significant(shown->difference_scale, 2);
        figures += figure(shown->picture, shown->difference,
                          fmt::format("{} ms, error {}", ms(*row), error_of(*row)),
                          fmt::format("{}<br><small>{}</small>", escaped(words_in(*row)),
                                      escaped(effects_words(*row))),
                          colour_bar(ColourMap::difference, "difference, of the mean radiance",
                                     "−" + scale, "0", "+" + scale));
    }
    if (figures.empty()) return {};
    return section("front", "The pictures along the front",
                   "<p class=\"note\">From quick to exact. No other setting that was drawn is both "
                   "quicker and nearer to the reference. White is five times the mean; "
                   "differences are in luminance, each with its own scale.</p>\n<div "
                   "class=\"pairs\">" +
                       figures + "</div>\n");
}

std::string settings_section(const Json& study) {
    std::string rows;
    for (const Json& row : array_at(study, "settings")) {
        rows += fmt::format(
            "<tr><th scope=\"row\">{}{} <small>{}</small></th><td>{}</td>"
            "<td class=\"n\">{} <small>{} … {}</small></td><td class=\"n\">{}</td>"
            "<td class=\"n\">{}</td><td class=\"n strong\">{}</td><td class=\"n\">{}</td>"
            "<td class=\"n\">{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td></tr>\n",
            escaped(text_at(row, "sweep") == "search" ? "" : text_at(row, "setting")),
            true_at(row, "front") ? " <span class=\"badge good\">front</span>" : "",
            escaped(text_at(row, "sweep")),
            escaped(words_in(row)) + "<br><small>" + escaped(effects_words(row)) + "</small>",
            ms(row), ms(row, "cpu_least"), ms(row, "cpu_most"), ms(row, "wall_seconds"),
            whole(number_at(row, "runs")), error_of(row), significant(number_at(row, "rmse"), 2),
            decimals(number_at(row, "psnr"), 1),
            decimals(number_at(row, "deltaE00_mean"), 2) + " <small>" +
                decimals(number_at(row, "deltaE00_p95"), 1) + "</small>",
            decimals(number_at(row, "flip_mean"), 4));
    }
    if (rows.empty()) return {};
    std::string body = table(
        "Every setting that was drawn",
        "<th scope=\"col\">Setting</th><th scope=\"col\">In words</th>"
        "<th scope=\"col\" class=\"n\">CPU, ms</th><th scope=\"col\" class=\"n\">Wall, ms</th>"
        "<th scope=\"col\" class=\"n\">Runs</th><th scope=\"col\" class=\"n\">Error</th>"
        "<th scope=\"col\" class=\"n\">RMSE</th><th scope=\"col\" class=\"n\">PSNR, dB</th>"
        "<th scope=\"col\" class=\"n\">ΔE00</th><th scope=\"col\" class=\"n\">FLIP</th>",
        rows);
    // Long: it scrolls within itself.
    const std::string scroll = "class=\"scroll\"";
    if (const auto at = body.find(scroll); at != std::string::npos)
        body.replace(at, scroll.size(), "class=\"scroll tall\"");
    const Json noise = object_at(object_at(study, "reference"), "noise");
    body += fmt::format(
        "<p class=\"note\">Error: mean absolute difference of R, G and B over the stone, relative "
        "to their mean, which is what a tolerance speaks of; ≤ where it is less than twice "
        "the reference's own. RMSE likewise. PSNR, ΔE00 (mean and 95 %) and FLIP are of the "
        "picture as shown. The reference's own noise in these: {}, {}, {} dB, {}, {}. Time: median "
        "(least and most) of the drawing; of automatic settings, with planning. The beams' check "
        "against the reference, which <code>culet render</code> adds, is in it only where it made "
        "the automatic settings take the reference.</p>\n",
        significant(number_at(noise, "error"), 2), significant(number_at(noise, "rmse"), 2),
        decimals(number_at(noise, "psnr"), 1), decimals(number_at(noise, "deltaE00_mean"), 2),
        decimals(number_at(noise, "flip_mean"), 4));
    std::string left;
    for (const Json& one : array_at(study, "left_out")) {
        if (one.is_string()) left += fmt::format("<li>{}</li>\n", escaped(one.get<std::string>()));
    }
    if (!left.empty()) {
        body += fmt::format(
            "<details><summary>{} settings were not drawn</summary><ul>\n{}</ul></details>\n",
            array_at(study, "left_out").size(), left);
    }
    for (const Json& note : array_at(study, "notes")) {
        if (note.is_string())
            body += fmt::format("<p class=\"note\">{}</p>\n", escaped(note.get<std::string>()));
    }
    return section("settings", "All settings", body);
}

// What the automatic settings decided, tolerance by tolerance.
std::string plans_section(const Json& study) {
    std::string body;
    for (const Json& row : array_at(study, "settings")) {
        const Json plan = object_at(row, "plan");
        std::string rows;
        for (const Json& item : array_at(plan, "items")) {
            rows += fmt::format(
                "<tr><th scope=\"row\">{}</th><td>{}</td><td>{}{}{}</td><td class=\"n\">{}</td>"
                "</tr>\n",
                escaped(text_at(item, "name")), true_at(item, "on") ? "on" : "off",
                escaped(text_at(item, "fidelity")), text_at(item, "fidelity").empty() ? "" : "; ",
                escaped(text_at(item, "why")), significant(number_at(item, "error_bound"), 2));
        }
        if (rows.empty()) continue;
        body += fmt::format(
            "<details><summary>Tolerance {}: {}; error {}, bound {}; {} ms</summary>{}</details>\n",
            tolerance_of(row), escaped(words_in(row)), error_of(row),
            significant(number_at(row, "error_bound"), 2), ms(row),
            table(
                "Engine: " + escaped(text_at(plan, "engine") + ", " + text_at(plan, "engine_why")),
                "<th scope=\"col\">What</th><th scope=\"col\"></th><th scope=\"col\">How, and "
                "why</th><th scope=\"col\" class=\"n\">Error bound</th>",
                rows));
    }
    return section("plans", "What the automatic settings decided", body);
}

std::string reference_section(const Json& study) {
    const Json reference = object_at(study, "reference");
    std::string rows;
    for (const Json& effect : array_at(reference, "effects")) {
        rows += fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td><td>{}</td></tr>\n",
                            escaped(text_at(effect, "name")), true_at(effect, "on") ? "on" : "off",
                            escaped(text_at(effect, "why")));
    }
    if (rows.empty()) return {};
    return section(
        "reference", "The reference",
        table("What it computed, and why",
              "<th scope=\"col\">Effect</th><th scope=\"col\"></th><th scope=\"col\">Why</th>",
              rows) +
            fmt::format(
                "<p class=\"note\">Drawn twice with other rays and other random paths; half the "
                "mean difference of the two is its noise. Where there are rough rays (few "
                "wavelengths, short paths), the mean of these is taken, and added what the exact "
                "ones differ by along the same rays: exact in the mean, and with the noise of "
                "many. {} s of processor time: {}. What it cut "
                "may bring it {} of the mean at most.</p>\n",
                significant(number_at(reference, "cpu_seconds")),
                escaped(text_at(reference, "ended")),
                significant(number_at(reference, "error_bound"), 2)));
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
    std::string body = headline(study, title);
    body += advice_section(study);
    body += section(
        "time", "What accuracy costs in time",
        chart_figure(draw_chart_svg(time_chart(study))) +
            "<p class=\"note\">Each point is one way of drawing; hollow ones are as near to the "
            "reference as can be told (noise). Numbers beside the automatic settings are their "
            "tolerances.</p>\n");
    body += front_section(study, view);
    body += plans_section(study);
    body += settings_section(study);
    body += reference_section(study);
    body += study_provenance(study, view.version, view.command);
    return html_page(title, body, study.dump(-1, ' ', false, Json::error_handler_t::replace));
}

}  // namespace culet
