#include "fit/readings/named_tiers.h"

#include <fmt/format.h>

#include <array>
#include <map>
#include <utility>

#include "stone/design/tiers.h"
#include "stone/numbers/units.h"

namespace culet {

namespace {

// The names in the standard cuts of stone/cuts.
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
    std::vector<FacetTier> all = tiers_of(solid, up);
    std::map<std::pair<StonePart, std::string>, int> count;
    for (const FacetTier& tier : all) ++count[{tier.part, tier.name}];
    std::vector<NamedTier> tiers;
    for (FacetTier& tier : all) {
        if (tier.facets.size() < 2) continue;
        const bool alone = !tier.name.empty() && count[{tier.part, tier.name}] == 1;
        const std::string name = alone
                                     ? tier.name + "*"
                                     : solid.facets[std::size_t(tier.facets.front())].name + ".." +
                                           solid.facets[std::size_t(tier.facets.back())].name;
        std::string words = words_of(tier.name, tier.part, name);
        if (!alone) words += fmt::format(" of {:.1f} degrees", degrees(tier.inclination));
        tiers.push_back(
            {name, std::move(words), std::move(tier.facets), tier.scatter, !tier.name.empty()});
    }
    return tiers;
}

}  // namespace culet
