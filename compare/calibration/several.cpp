#include "compare/calibration/several.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "compare/json_number.h"
#include "compare/report/report_parts.h"
#include "page/html.h"
#include "page/parts.h"

namespace culet {

namespace {

using Json = nlohmann::ordered_json;

const EquivalentError* equivalent_of(const PhotographRow& row) {
    const auto& meaning = row.comparison.meaning;
    return meaning && meaning->equivalent.deg ? &meaning->equivalent : nullptr;
}

EquivalentError combined(const std::vector<const EquivalentError*>& errors) {
    EquivalentError result;
    double sum = 0, weights = 0;
    for (const EquivalentError* e : errors) {
        if (e == nullptr) continue;
        // The interval is 1.96 standard deviations of the logarithm either way.
        const double sd = std::log(e->high_deg / *e->deg) / 1.96;
        const double w = 1 / std::max(1e-4, sd * sd);
        sum += w * std::log(*e->deg);
        weights += w;
        result.at_least = result.at_least || e->at_least;
        result.at_most = result.at_most || e->at_most;
    }
    if (!(weights > 0)) return {};
    const double mean = sum / weights;
    double scatter = 0, count = 0;
    for (const EquivalentError* e : errors) {
        if (e == nullptr) continue;
        scatter += std::pow(std::log(*e->deg) - mean, 2);
        ++count;
    }
    const double by_scatter = count > 1 ? scatter / (count - 1) / count : 0;
    const double spread = 1.96 * std::sqrt(std::max(1 / weights, by_scatter));
    result.deg = std::exp(mean);
    result.low_deg = std::exp(mean - spread);
    result.high_deg = std::exp(mean + spread);
    return result;
}

std::string degrees_of(const EquivalentError& error) {
    return error.deg ? significant(error.deg, 2) + "°" : std::string("–");
}

Json equivalent_json(const EquivalentError& error) {
    return {{"deg", number(error.deg)},
            {"low_deg", error.deg ? number(error.low_deg) : Json(nullptr)},
            {"high_deg", error.deg ? number(error.high_deg) : Json(nullptr)}};
}

std::string score_cell(const Comparison& comparison, const char* key, int places) {
    for (const Score& score : comparison.scores) {
        if (score.key == key) return decimals(score.value, places);
    }
    return "–";
}

}  // namespace

SeveralPhotographs together(const std::vector<PhotographRow>& rows) {
    SeveralPhotographs result;
    std::vector<const EquivalentError*> errors;
    std::map<Verdict, int> votes;
    for (const PhotographRow& row : rows) {
        errors.push_back(equivalent_of(row));
        if (row.comparison.usable()) ++votes[row.comparison.verdict];
    }
    result.together = combined(errors);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        std::vector<const EquivalentError*> others = errors;
        others[i] = nullptr;
        result.without.push_back(combined(others));
        if (result.together.deg && result.without.back().deg) {
            const double change =
                std::abs(std::log(*result.without.back().deg / *result.together.deg));
            result.largest_change = std::max(result.largest_change, std::exp(change));
        }
    }
    if (votes.empty()) {
        result.verdict = Verdict::refused;
        result.reason = "none of the photographs could be compared";
        return result;
    }
    int most = 0, counted = 0;
    for (const auto& [verdict, count] : votes) {
        counted += count;
        // From the best verdict to the worst: the worse one wins a tie.
        if (count < most) continue;
        most = count;
        result.verdict = verdict;
    }
    result.reason = fmt::format("{} of {} photographs: {}", most, counted, name_of(result.verdict));
    std::replace(result.reason.begin(), result.reason.end(), '_', ' ');
    if (result.together.deg) {
        result.reason += fmt::format(
            "; together they fit as well as the same stone with {} degrees of facet error",
            significant(result.together.deg, 2));
        if (rows.size() > 2) {
            result.reason += fmt::format(
                ", and leaving any one out changes that by a factor of {} "
                "at most",
                significant(result.largest_change, 3));
        }
    }
    return result;
}

std::string several_json(const SeveralPhotographs& several,
                         const std::vector<PhotographRow>& rows) {
    Json json;
    json["schema"] = 1;
    json["command"] = "compare";
    json["verdict"] = name_of(several.verdict);
    json["reason"] = several.reason;
    json["equivalent_facet_error_deg"] = number(several.together.deg);
    json["equivalent_facet_error"] = equivalent_json(several.together);
    json["leave_one_out"] = Json::array();
    for (std::size_t i = 0; i < rows.size(); ++i) {
        json["leave_one_out"].push_back(
            {{"without", rows[i].name},
             {"equivalent_facet_error", equivalent_json(several.without[i])}});
    }
    json["largest_change_factor"] = number(several.largest_change);
    json["photographs"] = Json::array();
    for (const PhotographRow& row : rows) {
        json["photographs"].push_back(Json::parse(row.scores_json, nullptr, false));
    }
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string several_page(const SeveralPhotographs& several, const std::vector<PhotographRow>& rows,
                         const std::string& title, const std::string& version,
                         const std::string& command) {
    const VerdictShown shown = verdict_shown(several.verdict);
    std::string body = fmt::format(
        "<header class=\"headline\"><h1>{}</h1>\n<div class=\"verdict {}\"><span class=\"symbol\" "
        "aria-hidden=\"true\">{}</span><div><p class=\"word\">{}</p><p>{}</p></div></div>\n"
        "</header>\n",
        escaped(title), shown.style, shown.symbol, shown.word, escaped(several.reason + "."));
    std::string cells;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const Comparison& c = rows[i].comparison;
        const EquivalentError* error = equivalent_of(rows[i]);
        const Photo& photo = c.pictures.photo;
        const std::string picture = photo.rgb.empty()
                                        ? ""
                                        : fmt::format("<img class=\"thumb\" src=\"{}\" alt=\"\">",
                                                      picture_uri(photo, c.pictures.white));
        cells += fmt::format(
            "<tr><td>{}</td><th scope=\"row\"><a href=\"{}\">{}</a><small>{}</small></th>"
            "<td>{}</td><td class=\"n strong\">{}</td><td class=\"n\">{}</td><td "
            "class=\"n\">{}</td>"
            "<td class=\"n\">{} of {}</td><td class=\"n\">{}</td></tr>\n",
            picture, escaped(rows[i].page), escaped(rows[i].name),
            c.usable() ? "" : escaped(c.reason), verdict_shown(c.verdict).word,
            error != nullptr ? degrees_of(*error) : "–", score_cell(c, "zncc", 3),
            score_cell(c, "deltaE00_mean", 1), c.reflexes.matched, c.reflexes.in_photo,
            degrees_of(several.without[i]));
    }
    body += section(
        "photographs", "The photographs",
        table(
            "Each photograph, and the common answer without it",
            "<th scope=\"col\"></th><th scope=\"col\">Photograph</th><th scope=\"col\">Verdict</th>"
            "<th scope=\"col\" class=\"n\">Facet error</th><th scope=\"col\" class=\"n\">ZNCC</th>"
            "<th scope=\"col\" class=\"n\">ΔE00</th><th scope=\"col\" class=\"n\">Reflexes</th>"
            "<th scope=\"col\" class=\"n\">Others alone</th>",
            cells) +
            "<p class=\"note\">Facet error: that of simulated photographs which score like this "
            "one. Others alone: the common facet error of all the other photographs; where it "
            "differs much from the rest, look at that photograph first.</p>\n");
    body += section(
        "provenance", "How this page was made",
        fmt::format("<p>culet {}</p>\n<pre>{}</pre>\n", escaped(version), escaped(command)));
    return html_page(title, body, several_json(several, rows));
}

}  // namespace culet
