#include "stone/design/repeating_gear.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace culet {

namespace {

constexpr double k_same_index = 0.01;        // of a tooth; files give two decimals or more
constexpr std::size_t k_most_facets = 1000;  // larger tiers are not tested: the test compares all
                                             // pairs

// True if a turn by `teeth` maps the tier onto itself.
bool tier_repeats(const DesignTier& tier, double gear, double teeth) {
    if (tier.setting.angle_deg == 0) return true;
    return std::all_of(tier.facets.begin(), tier.facets.end(), [&](const DesignFacet& one) {
        return one.index <= gear &&
               std::any_of(tier.facets.begin(), tier.facets.end(), [&](const DesignFacet& other) {
                   return std::abs(std::remainder(other.index - one.index - teeth, gear)) <
                          k_same_index;
               });
    });
}

bool repeats_on(const Design& design, double gear) {
    const int stated = design.symmetry;
    for (int order = stated > 1 ? stated : 2; order <= (stated > 1 ? stated : 16); ++order) {
        if (std::all_of(design.tiers.begin(), design.tiers.end(), [&](const DesignTier& tier) {
                return tier_repeats(tier, gear, gear / order);
            }))
            return true;
    }
    return false;
}

}  // namespace

std::optional<double> repeating_gear(const Design& design) {
    std::size_t facets = 0;
    for (const DesignTier& tier : design.tiers) facets += tier.facets.size();
    if (facets > k_most_facets || repeats_on(design, k_usual_gear)) return std::nullopt;
    std::vector<double> fitting;
    for (const double gear :
         {32, 36, 40, 48, 60, 64, 72, 77, 80, 84, 88, 90, 99, 100, 108, 112, 120, 128, 144}) {
        if (repeats_on(design, gear)) fitting.push_back(gear);
    }
    return fitting.size() == 1 ? std::optional(fitting[0]) : std::nullopt;
}

}  // namespace culet
