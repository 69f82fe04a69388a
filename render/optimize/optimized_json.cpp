#include "render/optimize/optimized_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace culet {

namespace {

nlohmann::ordered_json json_of(const Merit& merit, const MeritOptions& options) {
    nlohmann::ordered_json json{{"total", merit.total}};
    for (std::size_t p = 0; p < merit.parts.size(); ++p) {
        if (options.weights[p] > 0) json[name_of(static_cast<MeritPart>(p))] = merit.parts[p];
    }
    return json;
}

}  // namespace

std::vector<std::string> tier_words(const Solid& solid, const Design& design,
                                    const std::vector<FacetTier>& tiers) {
    Solid designed = solid;
    designed.design = std::make_shared<const Design>(design);
    const std::vector<std::string> titles = tier_titles(design);
    const std::vector<DesignPlace> places = places_of(designed);
    std::vector<std::string> words;
    for (const FacetTier& tier : tiers) {
        std::vector<std::string> own;
        for (const int f : tier.facets) {
            const int t = places[std::size_t(f)].tier;
            const std::string& title =
                t < 0 ? solid.facets[std::size_t(f)].name : titles[std::size_t(t)];
            if (std::find(own.begin(), own.end(), title) == own.end()) own.push_back(title);
        }
        words.push_back(fmt::format("{}", fmt::join(own, " ")));
    }
    return words;
}

std::vector<std::string> tier_words(const Optimized& result, const Design& design) {
    std::vector<FacetTier> tiers;
    for (const OptimizedTier& tier : result.tiers) tiers.push_back(tier.tier);
    return tier_words(result.start, design, tiers);
}

std::string optimized_json(const Optimized& result, const Design& design,
                           const OptimizeOptions& options, const std::string& objective) {
    nlohmann::ordered_json json{{"schema", 1},
                                {"objective", objective},
                                {"model", name_of(options.merit.model)},
                                {"index", options.merit.index.n},
                                {"merit",
                                 {{"start", json_of(result.at_start, options.merit)},
                                  {"two_factors", json_of(result.by_two_factors, options.merit)},
                                  {"better", json_of(result.at_better, options.merit)}}},
                                {"found", result.found},
                                {"recut", options.recut.has_value()},
                                {"volume_ratio", result.volume_ratio},
                                {"table_percent",
                                 {{"start", 100 * table_share(result.start)},
                                  {"better", 100 * table_share(result.better)}}},
                                {"evaluations", result.evaluations},
                                {"tiers", nlohmann::ordered_json::array()}};
    const std::vector<std::string> names = tier_words(result, design);
    for (std::size_t t = 0; t < names.size(); ++t) {
        const OptimizedTier& tier = result.tiers[t];
        nlohmann::ordered_json facets = nlohmann::ordered_json::array();
        for (const int f : tier.tier.facets)
            facets.push_back(result.start.facets[static_cast<std::size_t>(f)].name);
        json["tiers"].push_back(
            {{"name", names[t]},
             {"part", tier.tier.part == StonePart::crown ? "crown" : "pavilion"},
             {"facets", facets},
             {"from_deg", degrees(tier.from)},
             {"to_deg", degrees(tier.to)}});
    }
    return json.dump(1) + "\n";
}

}  // namespace culet
