#include "page/fit_findings.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "page/html.h"
#include "page/json_fields.h"
#include "page/parts.h"
#include "page/quantity.h"
#include "page/reading_words.h"
#include "page/templates.h"

namespace culet {

namespace {

using Json = nlohmann::json;

std::string list_at(const Json& object, const char* key) {
    std::string text;
    for (const Json& name : array_at(object, key)) {
        if (name.is_string()) text += (text.empty() ? "" : " / ") + name.get<std::string>();
    }
    return text;
}

std::string angle_at(const Json& object, const char* key) {
    const std::string text = decimals(number_at(object, key), 2);
    return text == "–" ? text : text + "°";
}

View tiers_of(const Json& fit) {
    std::vector<View> rows;
    for (const Json& tier : array_at(fit, "tiers")) {
        rows.push_back({{"name", text_at(tier, "name")},
                        {"facets", std::to_string(array_at(tier, "facets").size())},
                        {"mean", angle_at(tier, "inclination")},
                        {"spread", angle_at(tier, "spread")},
                        {"own_mean", angle_at(tier, "inclination_own_axis")},
                        {"own_spread", angle_at(tier, "spread_own_axis")}});
    }
    return table_view(rows);
}

View help_of(const Json& fit, const std::string& length_unit) {
    std::vector<View> rows;
    for (const Json& help : array_at(fit, "help")) {
        const auto sigma = number_at(help, "sigma"), share = number_at(help, "reduces");
        const std::string unit = reading_unit(text_at(help, "kind"), length_unit);
        rows.push_back(
            {{"reading", reading_words(help)},
             {"sigma", to_place_of(sigma, sigma, unit)},
             {"takes_off", share ? decimals(100 * (1 - std::sqrt(1 - *share)), 1) + " %" : "–"},
             {"settles", true_at(help, "closes") ? "yes" : "no"}});
    }
    return table_view(rows);
}

std::string chance(const std::optional<double>& p) {
    if (!p) return "–";
    if (*p < 1e-4) return "under 0.01 %";
    return significant(100 * *p, 2) + " %";
}

View meets_of(const Json& fit, const std::string& unit) {
    const auto meets = fit.find("meets");
    if (meets == fit.end()) return false;
    std::vector<const Json*> order;
    for (const Json& meet : array_at(*meets, "list")) order.push_back(&meet);
    std::stable_sort(order.begin(), order.end(), [](const Json* a, const Json* b) {
        return number_at(*a, "p").value_or(1) < number_at(*b, "p").value_or(1);
    });
    std::vector<View> rows;
    for (const Json* meet : order) {
        const auto miss = number_at(*meet, "miss"), sigma = number_at(*meet, "sigma");
        rows.push_back({{"bad", true_at(*meet, "contradicted")},
                        {"facets", list_at(*meet, "facets")},
                        {"how", text_at(*meet, "how")},
                        {"miss", quantity(miss, sigma, unit)},
                        {"chance", chance(number_at(*meet, "p"))}});
    }
    return table_view(rows);
}

std::string shape_list(const Json& fit) {
    std::vector<ListItem> items;
    for (const Json& one : array_at(fit, "shape")) {
        items.push_back({"", as_sentence(typeset(text_at(one, "what")))});
    }
    return short_list(items);
}

View symmetry_of(const Json& fit) {
    const auto symmetry = fit.find("symmetry");
    if (symmetry == fit.end() || !symmetry->is_object()) return false;
    std::vector<View> groups, tiers;
    for (const Json& g : array_at(*symmetry, "groups")) {
        groups.push_back({{"group", text_at(g, "group")},
                          {"tested", whole(number_at(g, "tested"))},
                          {"conditions", whole(number_at(g, "conditions"))},
                          {"chi2", significant(number_at(g, "chi2"), 3)},
                          {"chance", chance(number_at(g, "p"))},
                          {"supported", true_at(g, "supported")}});
    }
    for (const Json& t : array_at(*symmetry, "tiers")) {
        tiers.push_back({{"tier", text_at(t, "tier")},
                         {"deviation", angle_at(t, "deviation")},
                         {"scatter", angle_at(t, "sigma")},
                         {"at_most", angle_at(t, "at_most")},
                         {"worst", text_at(t, "worst")}});
    }
    return {{"message", as_sentence(typeset(text_at(*symmetry, "message")))},
            {"groups", table_view(groups)},
            {"alike", table_view(tiers)}};
}

}  // namespace

std::string findings_tables(const Json& fit, const std::string& length_unit) {
    if (!fit.is_object()) return {};
    return filled(templates::fit_findings, {{"symmetry", symmetry_of(fit)},
                                            {"tiers", tiers_of(fit)},
                                            {"help", help_of(fit, length_unit)},
                                            {"meets", meets_of(fit, length_unit)},
                                            {"doubts_html", shape_list(fit)}});
}

}  // namespace culet
