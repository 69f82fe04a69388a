#include "stone/design/cutting_list.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>

#include "stone/design/cut_depth.h"
#include "stone/numbers/units.h"
#include "stone/numbers/upper_median.h"

namespace culet {

namespace {

// Designs give angles to 0.01 degrees.
constexpr double k_same_deg = 0.005;
// Teeth: the rounding error between a design's own planes and its index settings.
constexpr double k_exact_index = 1e-3;

class Lister {
public:
    Lister(const Solid& solid, const CuttingOptions& options)
        : solid_(solid),
          options_(options),
          design_(cutting_design(solid)),
          teeth_(gear_of(solid, options)),
          shown_teeth_(options.shown_deg * teeth_ / 360),
          table_(table_facet(solid, {0, 0, 1})) {
        std::erase_if(design_.tiers, [](const DesignTier& tier) { return tier.hidden; });
        const double factor = teeth_ / std::abs(design_.gear);
        design_.gear *= factor;
        design_.gear_offset *= factor;
        for (DesignTier& tier : design_.tiers) {
            for (DesignFacet& facet : tier.facets) facet.index *= factor;
        }
        for (std::size_t f = 0; f < solid.facets.size(); ++f)
            facet_called_[solid.facets[f].name] = static_cast<int>(f);
        find_turn();
    }

    std::vector<CuttingStep> steps() const {
        std::vector<CuttingStep> list;
        const std::vector<std::string> titles = tier_titles(design_);
        std::vector<bool> done(solid_.facets.size(), false);
        std::vector<Vec3> normals;
        for (const Facet& facet : solid_.facets) normals.push_back(facet.plane.normal);
        for (std::size_t t = 0; t < titles.size(); ++t) {
            list.push_back(step_of(design_.tiers[t]));
            list.back().tier = titles[t];
            CutSetting cut = design_.tiers[t].setting;
            cut.angle_deg = list.back().angle_deg;
            for (const DesignFacet& own : design_.tiers[t].facets) {
                const int f = facet_of(own);
                if (f < 0) continue;
                done[std::size_t(f)] = true;
                cut.index = own.index;
                normals[std::size_t(f)] = plane_of(cut, design_).normal;
            }
        }
        // Facets cut into the stone after its design.
        for (std::size_t f = 0; f < done.size(); ++f) {
            if (done[f]) continue;
            const Facet& facet = solid_.facets[f];
            const CutSetting cut = setting_of(facet.plane, design_);
            list.push_back(step_of({cut, {}, {{cut.index, facet.name, facet.name}}}));
            list.back().tier = facet.name;
        }
        find_depths(solid_, normals, list);
        return list;
    }

private:
    double wrapped(double teeth) const { return std::remainder(teeth, teeth_); }
    double on_wheel(double index) const {
        const double tooth = std::fmod(index, teeth_);
        return tooth <= 0 ? tooth + teeth_ : tooth;
    }
    int facet_of(const DesignFacet& own) const {
        const auto known = facet_called_.find(own.facet);
        return own.facet.empty() || known == facet_called_.end() ? -1 : known->second;
    }
    CutSetting setting(int f) const {
        return setting_of(solid_.facets[std::size_t(f)].plane, design_);
    }

    // Finds the turn against the design that most facets share.
    void find_turn() {
        std::vector<double> off;
        double most = 0;
        for (const DesignTier& tier : design_.tiers) {
            for (const DesignFacet& own : tier.facets) {
                const int f = facet_of(own);
                if (f < 0 || tier.setting.angle_deg == 0) continue;
                off.push_back(wrapped(setting(f).index - own.index));
                most = std::max(most, std::abs(off.back()));
            }
        }
        turn_ = most < k_exact_index ? 0 : median(std::move(off));
    }

    CuttingStep step_of(const DesignTier& tier) const {
        CuttingStep step;
        step.instruction = tier.instruction;
        if (tier.frosting > 0)
            step.instruction += tier.instruction.empty() ? "frosted" : " (frosted)";
        std::vector<double> angles;
        for (const DesignFacet& own : tier.facets) {
            const int f = facet_of(own);
            if (f < 0) continue;
            step.facets.push_back(f);
            angles.push_back(setting(f).angle_deg);
            step.indices.push_back(setting(f).index);
        }
        std::sort(step.indices.begin(), step.indices.end());
        const bool as_designed = std::all_of(angles.begin(), angles.end(), [&](double angle) {
            return std::abs(angle - tier.setting.angle_deg) < k_same_deg;
        });
        step.angle_deg = as_designed ? tier.setting.angle_deg : median(angles);
        if (angles.empty()) angles.push_back(step.angle_deg);
        step.least_angle_deg = *std::min_element(angles.begin(), angles.end());
        step.most_angle_deg = *std::max_element(angles.begin(), angles.end());
        step.part = part(tier, step);
        step.settings = settings(tier, step.angle_deg);
        return step;
    }

    StonePart part(const DesignTier& tier, const CuttingStep& step) const {
        if (!step.facets.empty()) return part_of(solid_, step.facets.front(), table_, {0, 0, 1});
        const Plane plane = plane_of(tier.setting, design_);
        Solid alone;
        alone.facets.push_back({"", plane, {}});
        return part_of(alone, 0, -1, {0, 0, 1});
    }

    std::vector<IndexSetting> settings(const DesignTier& tier, double angle_deg) const {
        struct Cut {
            double cheater = 0;
            IndexSetting::Tooth tooth;
        };
        // A turn about the axis tilts a facet by its sine, and a machine resolves tilts.
        constexpr double k_flattest_deg = 5;
        const double limit = shown_teeth_ / std::sin(radians(std::max(angle_deg, k_flattest_deg)));
        std::vector<Cut> cuts;
        for (const DesignFacet& own : tier.facets) {
            const int f = facet_of(own);
            double off = 0;
            Cut cut;
            if (f >= 0) {
                off = wrapped(setting(f).index - own.index - turn_);
                const double own_deg = setting(f).angle_deg;
                if (std::abs(own_deg - angle_deg) > options_.shown_deg) cut.tooth.own_deg = own_deg;
            }
            const double index = own.index + (std::abs(off) > limit ? off : 0);
            const double tooth = std::round(index);
            cut.cheater = index - tooth;
            cut.tooth.tooth = static_cast<int>(std::lround(on_wheel(tooth)));
            cuts.push_back(cut);
        }
        std::stable_sort(cuts.begin(), cuts.end(),
                         [](const Cut& a, const Cut& b) { return a.cheater < b.cheater; });
        std::vector<IndexSetting> all;
        double first = 0;
        for (const Cut& cut : cuts) {
            if (all.empty() || cut.cheater - first > limit) {
                all.emplace_back();
                first = cut.cheater;
            }
            IndexSetting& own = all.back();
            own.teeth.push_back(cut.tooth);
            own.cheater += (cut.cheater - own.cheater) / double(own.teeth.size());
        }
        for (IndexSetting& own : all) {
            if (std::abs(own.cheater) < limit) own.cheater = 0;
            std::sort(own.teeth.begin(), own.teeth.end(),
                      [](const auto& a, const auto& b) { return a.tooth < b.tooth; });
        }
        return all;
    }

    const Solid& solid_;
    const CuttingOptions& options_;
    Design design_;
    double teeth_ = 96, shown_teeth_ = 0, turn_ = 0;
    int table_ = -1;
    std::map<std::string, int> facet_called_;
};

}  // namespace

double gear_of(const Solid& solid, const CuttingOptions& options) {
    if (options.gear != 0) return std::abs(options.gear);
    return solid.design ? std::abs(solid.design->gear) : Design{}.gear;
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

std::vector<CuttingStep> cutting_list(const Solid& solid, const CuttingOptions& options) {
    return Lister(solid, options).steps();
}

}  // namespace culet
