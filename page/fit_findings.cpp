#include "page/fit_findings.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "page/html.h"
#include "page/json_fields.h"
#include "page/parts.h"
#include "page/quantity.h"
#include "page/reading_words.h"

namespace culet {

namespace {

using Json = nlohmann::json;

std::string head_of(const std::vector<std::string>& names) {
    std::string head;
    for (std::size_t i = 0; i < names.size(); ++i) {
        head += fmt::format("<th scope=\"col\"{}>{}</th>", i == 0 ? "" : " class=\"n\"", names[i]);
    }
    return head;
}

std::string list_at(const Json& object, const char* key) {
    std::string text;
    for (const Json& name : array_at(object, key)) {
        if (name.is_string()) text += (text.empty() ? "" : " / ") + name.get<std::string>();
    }
    return text;
}

std::string cell(const std::string& text) {
    return "<td class=\"n\">" + escaped(text) + "</td>";
}

std::string angle_at(const Json& object, const char* key) {
    const std::string text = decimals(number_at(object, key), 2);
    return text == "–" ? text : text + "°";
}

std::string tiers_table(const Json& fit) {
    std::string rows;
    for (const Json& tier : array_at(fit, "tiers")) {
        rows += fmt::format("<tr><th scope=\"row\">{} <small>{} facets</small></th>{}{}{}{}</tr>\n",
                            escaped(text_at(tier, "name")), array_at(tier, "facets").size(),
                            cell(angle_at(tier, "inclination")), cell(angle_at(tier, "spread")),
                            cell(angle_at(tier, "inclination_own_axis")),
                            cell(angle_at(tier, "spread_own_axis")));
    }
    if (rows.empty()) return {};
    return table("Tiers, from the table and from the stone's own axis",
                 head_of({"Tier", "Mean", "Spread", "Mean, own axis", "Spread, own axis"}), rows);
}

std::string help_table(const Json& fit, const std::string& unit) {
    std::string rows;
    for (const Json& help : array_at(fit, "help")) {
        const auto sigma = number_at(help, "sigma");
        const auto share = number_at(help, "reduces");
        rows +=
            fmt::format("<tr><th scope=\"row\">{}</th>{}{}{}</tr>\n", escaped(reading_words(help)),
                        cell(to_place_of(sigma, sigma, reading_unit(text_at(help, "kind"), unit))),
                        cell(share ? decimals(100 * *share, 1) + " %" : "–"),
                        cell(true_at(help, "closes") ? "yes" : "no"));
    }
    if (rows.empty()) return {};
    return table("Further readings that would help most",
                 head_of({"Reading", "if read to ±", "takes off the facets' variance",
                          "settles what is open"}),
                 rows);
}

// A probability as people read it.
std::string chance(const std::optional<double>& p) {
    if (!p) return "–";
    if (*p < 1e-4) return "under 0.01 %";
    return significant(100 * *p, 2) + " %";
}

std::string meets_table(const Json& fit, const std::string& unit) {
    const auto meets = fit.find("meets");
    if (meets == fit.end()) return {};
    std::vector<const Json*> order;
    for (const Json& meet : array_at(*meets, "list")) order.push_back(&meet);
    std::stable_sort(order.begin(), order.end(), [](const Json* a, const Json* b) {
        return number_at(*a, "p").value_or(1) < number_at(*b, "p").value_or(1);
    });
    std::string rows;
    for (const Json* meet : order) {
        const bool bad = true_at(*meet, "contradicted");
        rows +=
            fmt::format("<tr{}><th scope=\"row\">{}{}</th><td>{}</td>{}{}</tr>\n",
                        bad ? " class=\"suspect\"" : "", escaped(list_at(*meet, "facets")),
                        bad ? " <span class=\"badge\">does not meet</span>" : "",
                        escaped(text_at(*meet, "how")),
                        cell(quantity(number_at(*meet, "miss"), number_at(*meet, "sigma"), unit)),
                        cell(chance(number_at(*meet, "p"))));
    }
    if (rows.empty()) return {};
    return table("Meets of more than three facets, the least likely first",
                 "<th scope=\"col\">Facets</th><th scope=\"col\">Treated</th>"
                 "<th scope=\"col\" class=\"n\">Miss</th>"
                 "<th scope=\"col\" class=\"n\">Chance of as large a miss</th>",
                 rows);
}

std::string shape_list(const Json& fit) {
    std::vector<std::string> items;
    for (const char* key : {"shape", "extra_facets"}) {
        for (const Json& one : array_at(fit, key)) {
            items.push_back(escaped(as_sentence(typeset(text_at(one, "what")))));
        }
    }
    return short_list(items);
}

std::string symmetry_tables(const Json& fit) {
    const auto symmetry = fit.find("symmetry");
    if (symmetry == fit.end() || !symmetry->is_object()) return {};
    std::string rows, tiers;
    for (const Json& g : array_at(*symmetry, "groups")) {
        rows += fmt::format(
            "<tr><th scope=\"row\">{}</th>{}{}{}<td>{}</td></tr>\n", escaped(text_at(g, "group")),
            cell(fmt::format("{} / {}", whole(number_at(g, "tested")),
                             whole(number_at(g, "conditions")))),
            cell(significant(number_at(g, "chi2"), 3)), cell(chance(number_at(g, "p"))),
            true_at(g, "supported") ? "supported" : "not supported");
    }
    for (const Json& t : array_at(*symmetry, "tiers")) {
        tiers +=
            fmt::format("<tr><th scope=\"row\">{}</th>{}{}{}{}</tr>\n", escaped(text_at(t, "tier")),
                        cell(angle_at(t, "deviation")), cell(angle_at(t, "sigma")),
                        cell(angle_at(t, "at_most")), cell(text_at(t, "worst")));
    }
    std::string body =
        "<p>" + escaped(as_sentence(typeset(text_at(*symmetry, "message")))) + "</p>\n";
    if (!rows.empty()) {
        body += table("Groups held against the readings",
                      "<th scope=\"col\">Group</th><th scope=\"col\" class=\"n\">Conditions "
                      "tested</th><th scope=\"col\" class=\"n\">χ²</th><th scope=\"col\" "
                      "class=\"n\">Chance of as much</th><th scope=\"col\"></th>",
                      rows);
    }
    if (!tiers.empty()) {
        body +=
            table("How alike the facets of each tier are",
                  head_of({"Tier", "Deviation", "True scatter", "At most (95 %)", "Worst"}), tiers);
    }
    return body;
}

}  // namespace

std::string findings_tables(const Json& fit, const std::string& length_unit) {
    if (!fit.is_object()) return {};
    return folded("Symmetry", symmetry_tables(fit)) +
           folded("Tiers and the stone's own axis", tiers_table(fit)) +
           folded("Readings that would help", help_table(fit, length_unit)) +
           folded("Meets", meets_table(fit, length_unit)) +
           folded("Edges and facets that are in doubt", shape_list(fit));
}

}  // namespace culet
