#include "studio/cut_handles.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "render/optimize/optimized_json.h"
#include "stone/numbers/units.h"
#include "stone/solid/caliper.h"

namespace culet {

namespace {

CutHandle height_handle(const TierDesign& design, StonePart part, const Solid& solid) {
    CutHandle handle{
        part == StonePart::crown ? "Height of the crown" : "Depth of the pavilion", part, {}, true};
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (std::size_t t = 0; t < design.tiers().size(); ++t) {
        if (design.tiers()[t].part != part) continue;
        handle.tiers.push_back(static_cast<int>(t));
        for (const int f : design.tiers()[t].facets) {
            for (const int corner : solid.facets[std::size_t(f)].corners) {
                least = std::min(least, solid.vertices[std::size_t(corner)].z);
                most = std::max(most, solid.vertices[std::size_t(corner)].z);
            }
        }
    }
    const CaliperWidths widths = caliper_widths(solid);
    handle.value = 100 * (most - least) / (widths.round() ? widths.mean : widths.least);
    return handle;
}

}  // namespace

std::vector<CutHandle> handles_of(const TierDesign& design, const Solid& solid) {
    const std::vector<std::string> words = tier_words(solid, cutting_design(solid), design.tiers());
    std::vector<CutHandle> handles;
    for (const StonePart part : {StonePart::crown, StonePart::pavilion}) {
        CutHandle height = height_handle(design, part, solid);
        if (height.tiers.size() > 1) handles.push_back(std::move(height));
        for (const std::vector<int>& tied : design.tied_tiers()) {
            const FacetTier& first = design.tiers()[std::size_t(tied.front())];
            if (first.part != part) continue;
            std::string name;
            for (const int t : tied) name += (name.empty() ? "" : ", ") + words[std::size_t(t)];
            handles.push_back({name, part, tied, false, degrees(mean_angle(solid, first))});
        }
    }
    return handles;
}

std::vector<double> turned_to(const TierDesign& design, const Solid& solid, const CutHandle& handle,
                              double value, double share) {
    std::vector<double> steeper(design.tiers().size(), 0);
    for (const int t : handle.tiers) {
        const double now = mean_angle(solid, design.tiers()[std::size_t(t)]);
        const double there = handle.is_height ? std::atan(value / handle.value * std::tan(now))
                                              : now + radians(value - handle.value);
        steeper[std::size_t(t)] = share * (there - now);
    }
    return steeper;
}

}  // namespace culet
