// The proportions of the cut.

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "page/fit_fields.h"
#include "page/fit_page.h"
#include "page/parts.h"
#include "page/templates.h"

namespace culet {

namespace {

using Json = nlohmann::json;

View row(const std::string& name, const std::string& about, const std::vector<View>& values) {
    return {{"name", name}, {"about", about}, {"values", values}};
}

// The diameter of a stone that is not quite round is an average, so show the caliper's range beside
// it.
std::vector<View> calipers(const Json& proportions) {
    std::vector<View> values;
    for (const auto& [name, words] : {std::pair{"caliper min", "least"},
                                      {"caliper max", "largest"},
                                      {"caliper mean", "mean"}}) {
        const Json* p = named_in(proportions, name);
        if (p == nullptr) continue;
        values.push_back({{"further", !values.empty()},
                          {"value", std::string(words) + " " + proportion_text(*p)},
                          {"rounded", ""}});
    }
    return values;
}

}  // namespace

std::string fit_proportions_section(const FitView& view) {
    const Json fit = parsed_object<Json>(view.fit_json, "the fit report for the page");
    const Json& proportions = array_at(fit, "proportions");
    const bool round = named_in(proportions, "diameter") != nullptr;
    std::vector<std::string> first{"depth",       "total depth",    "table",
                                   "crown angle", "pavilion angle", "weight"};
    first.insert(first.begin(), round ? "diameter" : "length");
    if (!round) first.insert(first.begin() + 1, "width");
    std::vector<View> rows, rest;
    for (const std::string& name : first) {
        const Json* p = named_in(proportions, name);
        if (p != nullptr) {
            rows.push_back(row(name, name == "diameter" ? "the mean of all directions" : "",
                               {{{"further", false},
                                 {"value", proportion_text(*p)},
                                 {"rounded", rounded_text(*p)}}}));
        }
        if (name != (round ? "diameter" : "width")) continue;
        const std::vector<View> around = calipers(proportions);
        if (!around.empty()) rows.push_back(row("caliper", "on the way round the stone", around));
    }
    for (const Json& p : proportions) {
        const std::string name = text_at(p, "name");
        if (name.starts_with("caliper ") || std::ranges::find(first, name) != first.end()) continue;
        rest.push_back(
            {{"name", name}, {"value", proportion_text(p)}, {"rounded", rounded_text(p)}});
    }
    if (rows.empty() && rest.empty()) return {};
    const std::string body =
        filled(templates::fit_proportions, {{"first", table_view(rows)},
                                            {"further_proportions", table_view(rest)},
                                            {"count", std::to_string(rest.size())},
                                            {"round", round}});
    if (text_at(fit, "status") == "not_converged") {
        return folded_section("proportions", "Proportions, not to be relied on", body);
    }
    return section("proportions", "Proportions", body);
}

}  // namespace culet
