#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "page/grade_section.h"
#include "page/html.h"
#include "page/json_fields.h"

namespace culet {

namespace {

using Json = nlohmann::json;

// The lights of docs/grade.md, with their names in brackets.
std::string light_words(const std::string& model) {
    const std::map<std::string, std::string> words{{"iso", "even light"},
                                                   {"cos", "light from above"},
                                                   {"sc2", "light from the sides"},
                                                   {"random", "uneven light"},
                                                   {"wlr", "light with GIA's weights"}};
    const auto known = words.find(model);
    return known == words.end() ? model : fmt::format("{}, {}", known->second, model);
}

}  // namespace

View optimized_view(const std::string& optimized_json) {
    if (optimized_json.empty()) return false;
    const Json json = parsed_object<Json>(optimized_json, "what was optimised");
    const auto merits = [&](const char* when) {
        const Json merit = json.value("merit", Json::object());
        return merit.is_object() ? merit.value(when, Json::object()) : Json::object();
    };
    const auto merit = [&](const char* when, const std::string& part) {
        return decimals(number_at(merits(when), part.c_str()), 2);
    };
    std::vector<View> parts, tiers;
    const Json start = merits("start");
    for (const auto& [part, value] : start.items()) {
        if (part != "total" && start.size() > 2)
            parts.push_back(
                {{"part", part}, {"before", merit("start", part)}, {"now", merit("better", part)}});
    }
    for (const Json& tier : array_at(json, "tiers")) {
        const Json& facets = array_at(tier, "facets");
        std::string name = text_at(tier, "name");
        if (name.empty() && !facets.empty() && facets.front().is_string())
            name = facets.front().get<std::string>();
        const double from = value_at(tier, "from_deg"), to = value_at(tier, "to_deg");
        tiers.push_back({{"name", name},
                         {"part", text_at(tier, "part")},
                         {"facets", fmt::format("{}", facets.size())},
                         {"before", decimals(from, 2)},
                         {"now", decimals(to, 2)},
                         {"change", decimals(to - from, 2)}});
    }
    const auto table = [&](const char* when) {
        return decimals(number_at(json.value("table_percent", Json::object()), when), 1);
    };
    const double volume = 100 * (value_at(json, "volume_ratio") - 1);
    const std::string weight =
        true_at(json, "recut")
            ? fmt::format("{} % of the weight is cut away", decimals(-volume, 2))
            : fmt::format("the weight for the same outline changes by {} %", decimals(volume, 2));
    return {{"objective", text_at(json, "objective")},
            {"light", light_words(text_at(json, "model"))},
            {"before", merit("start", "total")},
            {"now", merit("better", "total")},
            {"two_factors", merit("two_factors", "total")},
            {"found", true_at(json, "found")},
            {"parts", parts},
            {"several", !parts.empty()},
            {"tiers", tiers},
            {"table_before", table("start")},
            {"table_now", table("better")},
            {"weight", weight}};
}

}  // namespace culet
