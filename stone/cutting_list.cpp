#include "stone/cutting_list.h"

#include <algorithm>

#include "stone/cut_planes.h"

namespace culet {

namespace {

int order_of(StonePart part) {
    switch (part) {
        case StonePart::pavilion:
            return 0;
        case StonePart::culet:
            return 1;
        case StonePart::girdle:
            return 2;
        case StonePart::crown:
            return 3;
        case StonePart::table:
            break;
    }
    return 4;
}

}  // namespace

std::vector<CuttingStep> cutting_list(const Solid& solid, const CutSheet& sheet) {
    std::vector<CuttingStep> list;
    for (const FacetTier& tier : tiers_of(solid, {0, 0, 1})) {
        CuttingStep step;
        step.part = tier.part;
        step.tier = tier.facets.size() == 1 || tier.name.empty()
                        ? solid.facets[std::size_t(tier.facets[0])].name
                        : tier.name;
        step.least_angle_deg = 90;
        for (const int f : tier.facets) {
            const CutSetting setting = setting_of(solid.facets[std::size_t(f)].plane, sheet);
            step.angle_deg += setting.angle_deg / double(tier.facets.size());
            step.least_angle_deg = std::min(step.least_angle_deg, setting.angle_deg);
            step.most_angle_deg = std::max(step.most_angle_deg, setting.angle_deg);
            step.indices.push_back(setting.index);
        }
        std::sort(step.indices.begin(), step.indices.end());
        list.push_back(std::move(step));
    }
    std::stable_sort(list.begin(), list.end(), [](const CuttingStep& a, const CuttingStep& b) {
        return order_of(a.part) < order_of(b.part);
    });
    return list;
}

}  // namespace culet
