#include "stone/cutting_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <set>

#include "stone/checks.h"
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

// Whether the facets meet over the middle, or would if nothing else were cut: as real designs miss.
bool meet_over_the_middle(const Solid& solid, const std::vector<int>& facets) {
    double least = 0, most = 0;
    for (std::size_t i = 0; i < facets.size(); ++i) {
        const Plane& plane = solid.facets[std::size_t(facets[i])].plane;
        const double height = plane.offset / plane.normal.z;
        least = i == 0 ? height : std::min(least, height);
        most = i == 0 ? height : std::max(most, height);
    }
    return facets.size() >= 3 && most - least <= k_largest_miss * diameter(solid);
}

class Depths {
public:
    Depths(const Solid& solid, const std::vector<CuttingStep>& list)
        : solid_(solid), list_(list), step_of_(solid.facets.size()), at_(solid.vertices.size()) {
        for (std::size_t s = 0; s < list.size(); ++s) {
            for (const int f : list[s].facets) step_of_[std::size_t(f)] = s;
        }
        for (std::size_t f = 0; f < solid.facets.size(); ++f) {
            for (const int c : solid.facets[f].corners) at_[std::size_t(c)].push_back(f);
        }
    }

    CutDepth of(std::size_t step) const {
        const CuttingStep& cut = list_[step];
        CutDepth best;
        std::size_t most = 0;
        for (const int corner : solid_.facets[std::size_t(cut.facets.front())].corners) {
            std::set<std::size_t> tiers;
            std::size_t before = 0, own = 0;
            for (const std::size_t f : at_[std::size_t(corner)]) {
                own += step_of_[f] == step;
                if (step_of_[f] >= step) continue;
                ++before;
                tiers.insert(step_of_[f]);
            }
            const bool meets = before >= 3, pairs = before == 2 && own >= 2;
            if ((!meets && !pairs) || before <= most) continue;
            most = before;
            best.to = meets ? CutDepth::To::meet : CutDepth::To::pair;
            best.at.clear();
            for (const std::size_t tier : tiers) best.at.push_back(list_[tier].tier);
        }
        if (best.to == CutDepth::To::meet) return best;
        // An edge of the girdle alone fixes nothing: how much of the girdle is left is free.
        const bool girdle_alone =
            best.to == CutDepth::To::pair &&
            std::all_of(list_.begin(), list_.end(), [&](const CuttingStep& other) {
                return other.part == StonePart::girdle ||
                       std::find(best.at.begin(), best.at.end(), other.tier) == best.at.end();
            });
        if (cut.part == StonePart::girdle) return {CutDepth::To::outline, {}};
        if (girdle_alone) return {CutDepth::To::girdle_width, {}};
        if (best.to == CutDepth::To::pair) return best;
        if (step == 0 && cut.part == StonePart::pavilion &&
            meet_over_the_middle(solid_, cut.facets))
            return {CutDepth::To::centre, {}};
        return {};
    }

private:
    const Solid& solid_;
    const std::vector<CuttingStep>& list_;
    std::vector<std::size_t> step_of_;
    std::vector<std::vector<std::size_t>> at_;  // facets by corner
};

std::string joined(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
    return text;
}

}  // namespace

const char* name_of(StonePart part) {
    switch (part) {
        case StonePart::table:
            return "table";
        case StonePart::crown:
            return "crown";
        case StonePart::girdle:
            return "girdle";
        case StonePart::pavilion:
            return "pavilion";
        case StonePart::culet:
            break;
    }
    return "culet";
}

std::string depth_words(const CutDepth& depth) {
    switch (depth.to) {
        case CutDepth::To::meet:
            return "meet " + joined(depth.at);
        case CutDepth::To::pair:
            return "meet its neighbour on " + joined(depth.at);
        case CutDepth::To::centre:
            return "centre point";
        case CutDepth::To::outline:
            return "the outline's size";
        case CutDepth::To::girdle_width:
            return "the girdle's width";
        case CutDepth::To::size:
            break;
    }
    return "size";
}

std::string index_settings(const CuttingStep& step, double gear) {
    if (step.part == StonePart::table || step.part == StonePart::culet) return "any";
    std::string text;
    for (const double index : step.indices) {
        const double tooth = std::round(100 * index) / 100;
        text += fmt::format("{}{:g}", text.empty() ? "" : " ", tooth == 0 ? std::abs(gear) : tooth);
    }
    return text;
}

double least_girdle(const Solid& solid) {
    const int table = table_facet(solid, {0, 0, 1});
    std::map<std::pair<int, int>, int> seen;  // edges of girdle facets
    double least = 0;
    for (int f = 0; f < static_cast<int>(solid.facets.size()); ++f) {
        if (part_of(solid, f, table, {0, 0, 1}) != StonePart::girdle) continue;
        const std::vector<int>& corners = solid.facets[std::size_t(f)].corners;
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const int a = corners[i], b = corners[(i + 1) % corners.size()];
            if (++seen[{std::min(a, b), std::max(a, b)}] < 2) continue;
            const double length =
                glm::length(solid.vertices[std::size_t(a)] - solid.vertices[std::size_t(b)]);
            least = least == 0 ? length : std::min(least, length);
        }
    }
    return least;
}

std::vector<CuttingStep> cutting_list(const Solid& solid, const CutSheet& sheet,
                                      bool steepest_first) {
    std::vector<CuttingStep> list;
    for (const FacetTier& tier : tiers_of(solid, {0, 0, 1})) {
        CuttingStep step;
        step.part = tier.part;
        step.facets = tier.facets;
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
    std::stable_sort(list.begin(), list.end(), [&](const CuttingStep& a, const CuttingStep& b) {
        if (order_of(a.part) != order_of(b.part)) return order_of(a.part) < order_of(b.part);
        return steepest_first && a.angle_deg > b.angle_deg;
    });
    const Depths depths(solid, list);
    for (std::size_t s = 0; s < list.size(); ++s) list[s].depth = depths.of(s);
    return list;
}

}  // namespace culet
