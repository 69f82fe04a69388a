// The proportions of the cut.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "page/fit_fields.h"
#include "page/fit_page.h"
#include "page/html.h"
#include "page/parts.h"
#include "page/quantity.h"

namespace culet {

namespace {

using Json = nlohmann::json;

const Json* named(const Json& proportions, const std::string& name) {
    for (const Json& p : proportions) {
        if (text_at(p, "name") == name) return &p;
    }
    return nullptr;
}

std::string shown(const Json& p) {
    return escaped(quantity(number_at(p, "value"), number_at(p, "sigma"), text_at(p, "unit")));
}

std::string row(const std::string& name, const std::string& about, const std::string& value) {
    return fmt::format("<tr><th scope=\"row\">{}{}</th><td>{}</td></tr>\n", escaped(name),
                       about.empty() ? "" : " <small>" + about + "</small>", value);
}

// The one diameter of a stone that is not quite round is an average: what the caliper shows on the
// way round stands beside it.
std::string calipers(const Json& proportions) {
    std::string text;
    for (const auto& [name, words] : {std::pair{"caliper min", "least"},
                                      {"caliper max", "largest"},
                                      {"caliper mean", "mean"}}) {
        const Json* p = named(proportions, name);
        if (p == nullptr) continue;
        text += (text.empty() ? "" : "<br>") + std::string(words) + " " + shown(*p);
    }
    return text;
}

}  // namespace

std::string fit_proportions_section(const FitView& view) {
    const Json fit = parsed_object<Json>(view.fit_json, "the fit report for the page");
    const Json& proportions = array_at(fit, "proportions");
    const bool round = named(proportions, "diameter") != nullptr;
    std::vector<std::string> first{"depth",       "total depth",    "table",
                                   "crown angle", "pavilion angle", "weight"};
    first.insert(first.begin(), round ? "diameter" : "length");
    if (!round) first.insert(first.begin() + 1, "width");
    std::string rows, rest;
    int count = 0;
    for (const std::string& name : first) {
        const Json* p = named(proportions, name);
        if (p != nullptr) {
            rows += row(name, name == "diameter" ? "the mean of all directions" : "", shown(*p));
        }
        if (name != (round ? "diameter" : "width")) continue;
        const std::string around = calipers(proportions);
        if (!around.empty()) rows += row("caliper", "on the way round the stone", around);
    }
    for (const Json& p : proportions) {
        const std::string name = text_at(p, "name");
        if (name.starts_with("caliper ") || std::ranges::find(first, name) != first.end()) continue;
        rest += row(name, "", shown(p));
        ++count;
    }
    const char* const head = "<th scope=\"col\">Proportion</th><th scope=\"col\">Value</th>";
    std::string body = rows.empty() ? "" : table("Proportions of the cut", head, rows);
    if (!rest.empty()) {
        body += folded(fmt::format("{} more proportions", count),
                       table("Further proportions", head, rest));
    }
    if (!body.empty()) {
        body += fmt::format(
            "<p class=\"note\">± is one standard uncertainty. % is of the {}.{}</p>\n",
            round ? "diameter" : "width",
            round ? " A caliper shows something between the least and the largest; on a girdle of "
                    "flats the largest is from corner to corner."
                  : "");
    }
    if (text_at(fit, "status") == "not_converged") {
        return folded_section("proportions", "Proportions, not to be relied on", body);
    }
    return section("proportions", "Proportions", body);
}

}  // namespace culet
