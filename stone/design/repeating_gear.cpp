#include "stone/design/repeating_gear.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace culet {

namespace {

constexpr double k_same_index = 0.01;        // of a tooth; files give two decimals or more
constexpr std::size_t k_most_facets = 1000;  // larger tiers are not tested: the test compares all
                                             // pairs

// True if a turn by `teeth` maps each tier onto itself; `sign` -1: if a mirroring does.
bool repeat(const Design& design, double gear, double teeth, int sign = 1) {
    const auto repeats = [&](const DesignTier& tier) {
        const auto has_image = [&](const DesignFacet& one) {
            const auto is_image = [&](const DesignFacet& other) {
                return std::abs(std::remainder(other.index - sign * one.index - teeth, gear)) <
                       k_same_index;
            };
            return one.index <= gear &&
                   std::any_of(tier.facets.begin(), tier.facets.end(), is_image);
        };
        return tier.hidden || tier.setting.angle_deg == 0 ||
               std::all_of(tier.facets.begin(), tier.facets.end(), has_image);
    };
    return std::all_of(design.tiers.begin(), design.tiers.end(), repeats);
}

bool repeats_on(const Design& design, double gear) {
    const int stated = design.symmetry;
    for (int order = stated > 1 ? stated : 2; order <= (stated > 1 ? stated : 16); ++order) {
        if (repeat(design, gear, gear / order)) return true;
    }
    return false;
}

std::size_t facets_in(const Design& design) {
    std::size_t facets = 0;
    for (const DesignTier& tier : design.tiers) facets += tier.facets.size();
    return facets;
}

}  // namespace

std::optional<double> repeating_gear(const Design& design) {
    if (facets_in(design) > k_most_facets || repeats_on(design, k_usual_gear)) return std::nullopt;
    std::vector<double> fitting;
    for (const double gear :
         {32, 36, 40, 48, 60, 64, 72, 77, 80, 84, 88, 90, 99, 100, 108, 112, 120, 128, 144}) {
        if (repeats_on(design, gear)) fitting.push_back(gear);
    }
    return fitting.size() == 1 ? std::optional(fitting[0]) : std::nullopt;
}

void state_symmetry(Design& design) {
    constexpr int k_most_folds = 64;
    design.symmetry = 1;
    design.mirror = false;
    const auto tier = std::find_if(
        design.tiers.begin(), design.tiers.end(),
        [](const DesignTier& own) { return own.setting.angle_deg != 0 && !own.hidden; });
    if (tier == design.tiers.end() || facets_in(design) > k_most_facets) return;
    for (int order = 2; order <= k_most_folds; ++order) {
        if (repeat(design, design.gear, design.gear / order)) design.symmetry = order;
    }
    const double first = tier->facets.front().index;
    design.mirror = std::any_of(tier->facets.begin(), tier->facets.end(), [&](const auto& facet) {
        return repeat(design, design.gear, first + facet.index, -1);
    });
}

}  // namespace culet
