#include "stone/design/tiers_as_cut.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "stone/design/proportions.h"
#include "stone/numbers/units.h"

namespace culet {

namespace {

// Level facets have no index.
constexpr double k_without_index_deg = 0.05;

// `facets`: of the solid, by the tier's facets; -1: none.
TierAsCut tier_as_cut(const Solid& solid, const Design& design, const DesignTier& own,
                      const std::vector<int>& facets) {
    TierAsCut tier;
    tier.own = &own;
    std::vector<CutSetting> cuts;
    for (std::size_t i = 0; i < facets.size(); ++i) {
        const double index = own.facets[i].index;
        cuts.push_back(own.setting);
        if (facets[i] >= 0)
            cuts.back() = setting_of(solid.facets[std::size_t(facets[i])].plane, design);
        if (facets[i] < 0 || std::abs(cuts.back().index - index) < k_equal_teeth)
            cuts.back().index = index;
    }
    std::vector<double> shown;
    for (const CutSetting& cut : cuts) {
        tier.angle_deg += cut.angle_deg / double(cuts.size());
        tier.distance += cut.distance / double(cuts.size());
        const double turn = (cut.index - design.gear_offset) / design.gear;
        tier.turns.push_back(turn - std::floor(turn + k_equal_teeth / std::abs(design.gear)));
        shown.push_back(std::round(cut.index / k_equal_teeth) * k_equal_teeth);
    }
    if (tier.angle_deg < k_without_index_deg) {
        tier.turns.clear();
        shown.clear();
    }
    std::sort(tier.turns.begin(), tier.turns.end());
    tier.teeth = shown.empty() ? "any" : fmt::format("{:g}", fmt::join(shown, " "));
    tier.side = tier.angle_deg > 90 - k_equal_deg ? 'G' : own.setting.pavilion ? 'P' : 'C';
    tier.up = std::cos(radians(tier.angle_deg)) * (own.setting.pavilion ? -1 : 1);
    return tier;
}

}  // namespace

DesignAsCut::DesignAsCut(const Solid& given) : design(cutting_design(given)) {
    Solid solid = given;
    solid.design = std::make_shared<const Design>(design);
    const std::vector<DesignPlace> places = places_of(solid);
    const std::vector<std::string> titles = tier_titles(design);
    for (std::size_t t = 0; t < titles.size(); ++t) {
        std::vector<int> facets(design.tiers[t].facets.size(), -1);
        for (std::size_t f = 0; f < places.size(); ++f) {
            if (places[f].tier == int(t)) facets[std::size_t(places[f].facet)] = int(f);
        }
        tiers.push_back(tier_as_cut(solid, design, design.tiers[t], facets));
        tiers.back().title = titles[t];
    }
    width = proportions(solid).width;
    double low = INFINITY, high = -INFINITY;
    for (const Vec3& v : solid.vertices) {
        low = std::min(low, v.z);
        high = std::max(high, v.z);
    }
    middle = (low + high) / 2;
}

}  // namespace culet
