#include "fit/readings/named_tiers.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "stone/tiers.h"

namespace culet {

namespace {

// The names that the standard cuts of stone/cuts give.
std::string words_of(const std::string& name, StonePart part, const std::string& pattern) {
    struct Trade {
        const char* name;
        StonePart part;
        const char* words;
    };
    static constexpr std::array<Trade, 5> trade{{{"S", StonePart::crown, "stars"},
                                                 {"C", StonePart::crown, "crown mains"},
                                                 {"U", StonePart::crown, "upper halves"},
                                                 {"L", StonePart::pavilion, "lower halves"},
                                                 {"P", StonePart::pavilion, "pavilion mains"}}};
    if (part == StonePart::girdle) return "girdle facets";
    for (const Trade& t : trade) {
        if (name == t.name && part == t.part) return t.words;
    }
    return "facets of tier " + pattern;
}

}  // namespace

std::vector<NamedTier> named_tiers(const Solid& solid, const Vec3& up) {
    const int table = table_facet(solid, up);
    const std::vector<std::string> names = tier_names_of(solid);
    std::map<std::pair<StonePart, std::string>, std::vector<int>> families;
    for (int f = 0; f < int(solid.facets.size()); ++f) {
        if (names[std::size_t(f)].empty()) continue;
        families[{part_of(solid, f, table, up), names[std::size_t(f)]}].push_back(f);
    }
    std::vector<NamedTier> tiers;
    const auto put = [&](const std::string& name, StonePart part, std::vector<int> facets) {
        if (facets.size() < 2) return;
        const std::string pattern = name.empty()
                                        ? solid.facets[std::size_t(facets.front())].name + ".." +
                                              solid.facets[std::size_t(facets.back())].name
                                        : name + "*";
        tiers.push_back({pattern, words_of(name, part, pattern), std::move(facets)});
    };
    for (auto& [key, facets] : families) put(key.second, key.first, std::move(facets));
    for (FacetTier& tier : tiers_of(solid, up)) {
        if (tier.name.empty()) put("", tier.part, std::move(tier.facets));
    }
    std::sort(tiers.begin(), tiers.end(), [](const NamedTier& a, const NamedTier& b) {
        return a.facets.front() < b.facets.front();
    });
    return tiers;
}

}  // namespace culet
