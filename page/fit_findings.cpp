#include "page/fit_findings.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "page/html.h"
#include "page/json_fields.h"
#include "page/parts.h"

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
    return "<td class=\"n\">" + text + "</td>";
}

std::string folded(const std::string& summary, const std::string& body) {
    if (body.empty()) return {};
    return "<details><summary>" + summary + "</summary>\n" + body + "</details>\n";
}

std::string proportions_table(const Json& fit) {
    std::string rows;
    for (const Json& p : array_at(fit, "proportions")) {
        rows += fmt::format("<tr><th scope=\"row\">{}</th>{}{}</tr>\n", escaped(text_at(p, "name")),
                            cell(fmt::format("{} {}", significant(number_at(p, "value"), 5),
                                             escaped(text_at(p, "unit")))),
                            cell(significant(number_at(p, "sigma"), 2)));
    }
    return rows.empty()
               ? ""
               : table("Proportions of the cut", head_of({"Proportion", "Value", "±"}), rows);
}

std::string tiers_table(const Json& fit) {
    std::string rows;
    for (const Json& tier : array_at(fit, "tiers")) {
        rows += fmt::format("<tr><th scope=\"row\">{} <small>{} facets</small></th>{}{}{}{}</tr>\n",
                            escaped(text_at(tier, "name")), array_at(tier, "facets").size(),
                            cell(decimals(number_at(tier, "inclination"), 2)),
                            cell(decimals(number_at(tier, "spread"), 2)),
                            cell(decimals(number_at(tier, "inclination_own_axis"), 2)),
                            cell(decimals(number_at(tier, "spread_own_axis"), 2)));
    }
    if (rows.empty()) return {};
    return table("Tiers, in degrees from the table and from the stone's own axis",
                 head_of({"Tier", "Mean", "Spread", "Mean, own axis", "Spread, own axis"}), rows);
}

std::string help_table(const Json& fit) {
    std::string rows;
    for (const Json& help : array_at(fit, "help")) {
        rows += fmt::format(
            "<tr><th scope=\"row\">{} {}</th>{}{}{}</tr>\n", escaped(text_at(help, "kind")),
            escaped(list_at(help, "of")), cell(significant(number_at(help, "sigma"), 2)),
            cell(number_at(help, "reduces") ? decimals(100 * *number_at(help, "reduces"), 1) : "–"),
            cell(true_at(help, "closes") ? "yes" : "no"));
    }
    if (rows.empty()) return {};
    return table(
        "Further readings that would help most",
        head_of({"Reading", "with a σ of", "takes off the variance, %", "settles what is open"}),
        rows);
}

std::string meets_table(const Json& fit) {
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
        rows += fmt::format("<tr{}><th scope=\"row\">{}{}</th><td>{}</td>{}{}{}</tr>\n",
                            bad ? " class=\"suspect\"" : "", escaped(list_at(*meet, "facets")),
                            bad ? " <span class=\"badge\">does not meet</span>" : "",
                            escaped(text_at(*meet, "how")),
                            cell(significant(number_at(*meet, "miss"), 2)),
                            cell(significant(number_at(*meet, "sigma"), 2)),
                            cell(significant(number_at(*meet, "p"), 2)));
    }
    if (rows.empty()) return {};
    return table("Meets of more than three facets, the least likely first",
                 "<th scope=\"col\">Facets</th><th scope=\"col\">Treated</th>"
                 "<th scope=\"col\" class=\"n\">Miss</th><th scope=\"col\" class=\"n\">σ</th>"
                 "<th scope=\"col\" class=\"n\">p</th>",
                 rows);
}

std::string shape_list(const Json& fit) {
    std::string items;
    for (const char* key : {"shape", "extra_facets"}) {
        for (const Json& one : array_at(fit, key)) {
            items += "<li>" + escaped(text_at(one, "what")) + "</li>";
        }
    }
    return items.empty() ? "" : "<ul>" + items + "</ul>\n";
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
            cell(significant(number_at(g, "chi2"), 3)), cell(significant(number_at(g, "p"), 2)),
            true_at(g, "supported") ? "supported" : "not supported");
    }
    for (const Json& t : array_at(*symmetry, "tiers")) {
        tiers += fmt::format(
            "<tr><th scope=\"row\">{}</th>{}{}{}{}</tr>\n", escaped(text_at(t, "tier")),
            cell(significant(number_at(t, "deviation"), 2)),
            cell(significant(number_at(t, "sigma"), 2)),
            cell(significant(number_at(t, "at_most"), 2)), cell(escaped(text_at(t, "worst"))));
    }
    std::string body = "<p>" + escaped(text_at(*symmetry, "message")) + ".</p>\n";
    if (!rows.empty()) {
        body += table("Groups held against the readings",
                      "<th scope=\"col\">Group</th><th scope=\"col\" class=\"n\">Conditions "
                      "tested</th><th scope=\"col\" class=\"n\">χ²</th><th scope=\"col\" "
                      "class=\"n\">p</th><th scope=\"col\"></th>",
                      rows);
    }
    if (!tiers.empty()) {
        body +=
            table("How alike the facets of each tier are, degrees",
                  head_of({"Tier", "Deviation", "True scatter", "At most (95 %)", "Worst"}), tiers);
    }
    return body;
}

}  // namespace

std::string findings_tables(const Json& fit) {
    if (!fit.is_object()) return {};
    return proportions_table(fit) + folded("Symmetry", symmetry_tables(fit)) +
           folded("Tiers and the stone's own axis", tiers_table(fit)) +
           folded("What to read next", help_table(fit)) + folded("Meets", meets_table(fit)) +
           folded("Edges and facets that are in doubt", shape_list(fit));
}

}  // namespace culet
