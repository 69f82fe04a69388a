#include "stone/design/design.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>
#include <map>
#include <numbers>
#include <set>

#include "stone/design/drawn_symmetry.h"
#include "stone/design/tiers.h"
#include "stone/numbers/units.h"
#include "stone/text/text_scan.h"

namespace culet {

namespace {

constexpr Vec3 k_up{0, 0, 1};

struct SinCos {
    double sin = 0, cos = 1;
};

/// Of part / whole of a full turn, reduced exactly to an eighth of a turn about the nearest
/// quarter, so that mirrored settings give exactly mirrored values.
SinCos of_turn(double part, double whole) {
    part = std::fmod(part, whole);
    const double rest = std::remainder(4 * part, whole);
    const int quarter = static_cast<int>(std::lround((4 * part - rest) / whole));
    const double s = std::sin(rest / whole * (std::numbers::pi / 2));
    const double c = std::cos(rest / whole * (std::numbers::pi / 2));
    switch (((quarter % 4) + 4) % 4) {
        case 0:
            return {s, c};
        case 1:
            return {c, -s};
        case 2:
            return {-s, -c};
        default:
            return {-c, s};
    }
}

// Labels are one word in every file that holds a design.
std::string one_word(std::string_view name) {
    std::string word(trimmed(name));
    std::replace(word.begin(), word.end(), ' ', '_');
    return word;
}

bool digit(char c) {
    return c >= '0' && c <= '9';
}

// C for C1 and C12; A for A and A.1; C1 for C1NE and C1SW; empty: nothing in common.
std::string common_stem(const std::vector<std::string>& labels) {
    std::string stem = labels.front();
    for (const std::string& label : labels) {
        const auto apart = std::mismatch(stem.begin(), stem.end(), label.begin(), label.end());
        stem.erase(apart.first, stem.end());
    }
    const bool numbered = std::any_of(labels.begin(), labels.end(), [&](const std::string& label) {
        return label.size() == stem.size() || digit(label[stem.size()]);
    });
    const bool repeated = std::find(labels.begin(), labels.end(), stem) != labels.end();
    if (numbered && !repeated) {
        while (!stem.empty() && digit(stem.back())) stem.pop_back();
    }
    if (!stem.empty() && stem.back() == '.') stem.pop_back();
    return stem;
}

// The letters before what tells facets of a standard cut, or of one tier, apart.
std::string stem_of(const std::string& label) {
    const std::size_t point = label.rfind('.');
    if (point != std::string::npos && point > 0 && point + 1 < label.size() &&
        std::all_of(label.begin() + std::ptrdiff_t(point) + 1, label.end(), digit))
        return label.substr(0, point);
    const std::size_t digits = label.find_last_not_of("0123456789") + 1;
    if (digits > 0 && digits < label.size()) return label.substr(0, digits);
    const std::size_t letters = label.find_last_of("0123456789") + 1;
    return letters > 0 ? label.substr(0, letters) : label;
}

int turn_of(StonePart part) {
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

// Rounds to a design's digits if only the planes' rounding error is lost.
double without_rounding(double value) {
    constexpr double k_step = 1e-4, k_rounding = 1e-9;
    const double near = k_step * std::round(value / k_step);
    return std::abs(near - value) < k_rounding ? near : value;
}

DesignTier tier_of(const Solid& solid, const std::vector<int>& facets, const Design& design) {
    DesignTier tier;
    for (const int f : facets) {
        const Facet& facet = solid.facets[std::size_t(f)];
        const CutSetting own = setting_of(facet.plane, design);
        tier.setting.angle_deg += own.angle_deg / double(facets.size());
        tier.setting.distance += own.distance / double(facets.size());
        tier.setting.pavilion = own.pavilion;
        tier.facets.push_back({without_rounding(own.index), facet.name, facet.name});
    }
    tier.setting.angle_deg = without_rounding(tier.setting.angle_deg);
    std::stable_sort(tier.facets.begin(), tier.facets.end(),
                     [](const DesignFacet& a, const DesignFacet& b) { return a.index < b.index; });
    return tier;
}

}  // namespace

Plane plane_of(const CutSetting& setting, const Design& design) {
    const SinCos around = of_turn(setting.index - design.gear_offset, design.gear);
    const SinCos tilt = of_turn(setting.angle_deg, 360);
    const double up = setting.pavilion ? -tilt.cos : tilt.cos;
    return {{tilt.sin * around.sin, tilt.sin * around.cos, up}, setting.distance};
}

CutSetting setting_of(const Plane& plane, const Design& design) {
    const Vec3& n = plane.normal;
    const double level = std::hypot(n.x, n.y);
    CutSetting setting;
    setting.angle_deg = degrees(std::atan2(level, std::abs(n.z)));
    setting.pavilion = n.z < 0;
    setting.distance = plane.offset;
    const double teeth = std::abs(design.gear);
    double index = design.gear_offset;
    // A level table has no index of its own; any will do.
    if (level > 0) index += std::atan2(n.x, n.y) / (2 * std::numbers::pi) * design.gear;
    index = std::fmod(index, teeth);
    if (index <= 0) index += teeth;
    setting.index = index;
    return setting;
}

std::vector<DesignPlace> places_of(const Solid& solid) {
    std::vector<DesignPlace> places(solid.facets.size());
    if (!solid.design) return places;
    std::map<std::string, DesignPlace> known;
    const std::vector<DesignTier>& tiers = solid.design->tiers;
    for (std::size_t t = 0; t < tiers.size(); ++t) {
        for (std::size_t i = 0; i < tiers[t].facets.size(); ++i) {
            const std::string& facet = tiers[t].facets[i].facet;
            if (!facet.empty()) known[one_word(facet)] = {int(t), int(i)};
        }
    }
    for (std::size_t f = 0; f < places.size(); ++f) {
        const auto found = known.find(one_word(solid.facets[f].name));
        if (found != known.end()) places[f] = found->second;
    }
    return places;
}

std::vector<bool> ground_facets(const Solid& solid) {
    if (frosted_tiers(solid).empty()) return {};
    std::vector<bool> ground;
    for (const DesignPlace& place : places_of(solid))
        ground.push_back(place.tier >= 0 &&
                         solid.design->tiers[std::size_t(place.tier)].frosting > 0);
    return ground;
}

std::string frosted_tiers(const Design& design) {
    std::string names;
    std::vector<std::string> titles;
    for (std::size_t t = 0; t < design.tiers.size(); ++t) {
        if (!(design.tiers[t].frosting > 0) || design.tiers[t].hidden) continue;
        if (titles.empty()) titles = tier_titles(design);
        names += (names.empty() ? "" : ", ") + titles[t];
    }
    return names;
}

std::string frosted_tiers(const Solid& solid) {
    return solid.design ? frosted_tiers(*solid.design) : std::string();
}

std::vector<std::string> tier_titles(const Design& design) {
    std::vector<std::vector<std::string>> labels(design.tiers.size());
    std::map<std::string, int> count;
    std::vector<std::string> titles;
    for (std::size_t t = 0; t < design.tiers.size(); ++t) {
        for (const DesignFacet& facet : design.tiers[t].facets) {
            if (!facet.label.empty()) labels[t].push_back(facet.label);
        }
        titles.push_back(labels[t].empty() ? std::string() : common_stem(labels[t]));
        ++count[titles[t]];
    }
    for (std::size_t t = 0; t < titles.size(); ++t) {
        if (!labels[t].empty() && (titles[t].empty() || count[titles[t]] > 1))
            titles[t] = labels[t].front();
    }
    std::map<char, int> unnamed;
    for (std::size_t t = 0; t < titles.size(); ++t) {
        if (!titles[t].empty()) continue;
        const CutSetting& cut = design.tiers[t].setting;
        const char side = cut.angle_deg > 89 ? 'G' : cut.pavilion ? 'P' : 'C';
        do {
            titles[t] = cut.angle_deg == 0 && !cut.pavilion && unnamed['T']++ == 0
                            ? "T"
                            : fmt::format("{}{}", side, ++unnamed[side]);
        } while (std::count(titles.begin(), titles.end(), titles[t]) > 1);
    }
    return titles;
}

Design drawn_design(const Solid& solid) {
    Design design;
    Solid drawn = solid;
    drawn.design.reset();
    const AxisGroup group = drawn_symmetry(drawn, k_up, table_facet(drawn, k_up)).group;
    design.symmetry = group.order;
    design.mirror = group.mirrors;
    std::vector<FacetTier> tiers = tiers_of(drawn, k_up);
    std::stable_sort(tiers.begin(), tiers.end(), [](const FacetTier& a, const FacetTier& b) {
        if (turn_of(a.part) != turn_of(b.part)) return turn_of(a.part) < turn_of(b.part);
        return a.inclination > b.inclination;
    });
    for (const FacetTier& tier : tiers) design.tiers.push_back(tier_of(drawn, tier.facets, design));
    return design;
}

Design cutting_design(const Solid& solid) {
    return solid.design ? *solid.design : drawn_design(solid);
}

void join_split_tiers(const Solid& solid, Design& design) {
    const auto stem = [](const DesignTier& tier) {
        const std::string own = stem_of(tier.facets.front().label);
        const bool all =
            std::all_of(tier.facets.begin(), tier.facets.end(), [&](const DesignFacet& facet) {
                return !facet.facet.empty() && !facet.label.empty() && stem_of(facet.label) == own;
            });
        return all ? own : std::string();
    };
    // Tiers of one setting that an author lists separately stay separate.
    const auto differ = [](const CutSetting& a, const CutSetting& b) {
        constexpr double k_digits = 1e-6;
        return std::abs(a.angle_deg - b.angle_deg) > k_digits ||
               std::abs(a.distance - b.distance) > k_digits;
    };
    std::vector<bool> split(design.tiers.size(), false);
    for (std::size_t t = 0; t + 1 < split.size(); ++t) {
        const std::string own = stem(design.tiers[t]);
        if (!own.empty() && own == stem(design.tiers[t + 1]) &&
            differ(design.tiers[t].setting, design.tiers[t + 1].setting))
            split[t] = split[t + 1] = true;
    }
    if (std::find(split.begin(), split.end(), true) == split.end()) return;
    Solid drawn = solid;
    drawn.design.reset();
    std::map<std::string, std::size_t> group;
    const std::vector<FacetTier> groups = tiers_of(drawn, k_up);
    for (std::size_t g = 0; g < groups.size(); ++g) {
        for (const int f : groups[g].facets) group[solid.facets[std::size_t(f)].name] = g;
    }
    std::vector<DesignTier> joined;
    std::map<std::pair<std::size_t, std::string>, std::size_t> at;
    for (std::size_t t = 0; t < split.size(); ++t) {
        DesignTier& tier = design.tiers[t];
        const auto key = std::pair(split[t] ? group[tier.facets[0].facet] : 0, stem(tier));
        const auto known = split[t] ? at.find(key) : at.end();
        if (known == at.end()) {
            if (split[t]) at[key] = joined.size();
            joined.push_back(std::move(tier));
            continue;
        }
        DesignTier& whole = joined[known->second];
        const double n = double(whole.facets.size()), more = double(tier.facets.size());
        for (double CutSetting::*part : {&CutSetting::angle_deg, &CutSetting::distance}) {
            whole.setting.*part =
                (n * whole.setting.*part + more * tier.setting.*part) / (n + more);
        }
        std::move(tier.facets.begin(), tier.facets.end(), std::back_inserter(whole.facets));
        if (whole.instruction.empty()) whole.instruction = std::move(tier.instruction);
    }
    design.tiers = std::move(joined);
}

}  // namespace culet
