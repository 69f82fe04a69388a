#include "stone/tiers.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <set>

#include "stone/stone.h"
#include "stone/units.h"

namespace culet {

namespace {

// The tables of real designs are tilted by up to a few degrees; the flattest tiers stand at 8.
constexpr double k_level_deg = 7;
constexpr double k_girdle_deg = 80;
// Designs give angles to 0.01 degrees.
constexpr double k_same_angle_deg = 0.02;

bool touches(const Facet& facet, const std::set<int>& corners) {
    return std::any_of(facet.corners.begin(), facet.corners.end(),
                       [&](int corner) { return corners.contains(corner); });
}

// Where the mains of a side end: the corners of the table, or the lowest one and the culet's.
std::set<int> far_end(const Solid& solid, const Vec3& up, bool crown, int table) {
    std::set<int> end;
    if (crown && table >= 0) {
        end.insert(solid.facets[table].corners.begin(), solid.facets[table].corners.end());
        return end;
    }
    const double sign = crown ? -1 : 1;
    int lowest = -1;
    for (std::size_t v = 0; v < solid.vertices.size(); ++v) {
        if (lowest < 0 ||
            sign * glm::dot(up, solid.vertices[v]) < sign * glm::dot(up, solid.vertices[lowest])) {
            lowest = static_cast<int>(v);
        }
    }
    end.insert(lowest);
    for (std::size_t f = 0; f < solid.facets.size(); ++f) {
        const bool level = part_of(solid, static_cast<int>(f), table, up) == StonePart::culet;
        if (!crown && level && touches(solid.facets[f], {lowest})) {
            end.insert(solid.facets[f].corners.begin(), solid.facets[f].corners.end());
        }
    }
    return end;
}

double tilt(const Solid& solid, int facet, const Vec3& up) {
    return inclination(solid.facets[facet].plane.normal, up);
}

// In the order of inclination, split where it jumps.
std::vector<std::vector<int>> by_angle(const Solid& solid, const Vec3& up,
                                       std::vector<int> facets) {
    std::stable_sort(facets.begin(), facets.end(),
                     [&](int a, int b) { return tilt(solid, a, up) < tilt(solid, b, up); });
    std::vector<std::vector<int>> groups;
    for (const int f : facets) {
        const bool alike =
            !groups.empty() &&
            tilt(solid, f, up) - tilt(solid, groups.back().back(), up) < radians(k_same_angle_deg);
        if (!alike) groups.emplace_back();
        groups.back().push_back(f);
    }
    for (std::vector<int>& group : groups) std::sort(group.begin(), group.end());
    return groups;
}

// `prefix*` or `prefix.*` when it matches these facets and no others.
std::string pattern_of(const Solid& solid, const std::string& name,
                       const std::vector<int>& facets) {
    if (facets.size() < 2) return {};
    if (name.empty() || name.find_first_of("*/,()") != std::string::npos) return {};
    const std::set<int> wanted(facets.begin(), facets.end());
    for (const std::string& pattern : {name + "*", name + ".*"}) {
        std::set<int> found;
        for (std::size_t f = 0; f < solid.facets.size(); ++f) {
            if (name_matches(pattern, solid.facets[f].name)) found.insert(static_cast<int>(f));
        }
        if (found == wanted) return pattern;
    }
    return {};
}

// G of GNE: what stands before the side that a facet looks to; empty where no side is named.
std::string before_side(const std::string& name) {
    for (const std::string_view side : {"NE", "NW", "SE", "SW", "N", "E", "S", "W"}) {
        if (name.size() > side.size() && name.ends_with(side)) {
            return name.substr(0, name.size() - side.size());
        }
    }
    return {};
}

// A of A.1; empty for any other name.
std::string repeated_name(const std::string& name) {
    const std::size_t digits = name.find_last_not_of("0123456789") + 1;
    const bool numbered = digits > 1 && digits < name.size() && name[digits - 1] == '.';
    return numbered ? name.substr(0, digits - 1) : std::string();
}

bool matches(std::string_view pattern, std::string_view name) {
    std::size_t p = 0, n = 0, star = std::string_view::npos, resume = 0;
    while (n < name.size()) {
        if (p < pattern.size() && pattern[p] == '*') {
            star = p++;
            resume = n;
        } else if (p < pattern.size() && pattern[p] == name[n]) {
            ++p;
            ++n;
        } else if (star != std::string_view::npos) {
            p = star + 1;
            n = ++resume;
        } else {
            return false;
        }
    }
    while (p < pattern.size() && pattern[p] == '*') ++p;
    return p == pattern.size();
}

}  // namespace

bool name_matches(std::string_view pattern, std::string_view name) {
    if (matches(pattern, name)) return true;
    return pattern.ends_with(".*") && matches(pattern.substr(0, pattern.size() - 2), name);
}

std::vector<std::string> tier_names_of(const Solid& solid) {
    std::set<std::string> repeated;
    std::map<std::string, int> sides;
    for (const Facet& facet : solid.facets) {
        repeated.insert(repeated_name(facet.name));
        if (const std::string tier = before_side(facet.name); !tier.empty()) ++sides[tier];
    }
    std::vector<std::string> names;
    for (const Facet& facet : solid.facets) {
        const std::string& name = facet.name;
        const std::string base = repeated_name(name);
        if (!base.empty() || repeated.contains(name)) {
            names.push_back(base.empty() ? name : base);
            continue;
        }
        const std::size_t digits = name.find_last_not_of("0123456789") + 1;
        if (digits > 0 && digits < name.size()) {
            names.push_back(digits == 1 && name[0] == 'f' ? std::string() : name.substr(0, digits));
            continue;
        }
        // C1NE, P2Ea: a tier's number before the letters of the side; GNE: no number.
        const std::size_t letters = name.find_last_of("0123456789") + 1;
        const auto side = sides.find(before_side(name));
        if (letters > 0) {
            names.push_back(name.substr(0, letters));
        } else {
            names.push_back(side != sides.end() && side->second > 2 ? side->first : name);
        }
    }
    return names;
}

int table_facet(const Solid& solid, const Vec3& up) {
    int best = -1;
    double largest = 0;
    for (std::size_t f = 0; f < solid.facets.size(); ++f) {
        if (glm::dot(solid.facets[f].plane.normal, up) < std::cos(radians(k_level_deg))) continue;
        const double size = area(solid, solid.facets[f]);
        if (size > largest) {
            best = static_cast<int>(f);
            largest = size;
        }
    }
    return best;
}

StonePart part_of(const Solid& solid, int facet, int table, const Vec3& up) {
    if (facet == table) return StonePart::table;
    const double angle = degrees(tilt(solid, facet, up));
    if (angle > k_girdle_deg) return StonePart::girdle;
    if (glm::dot(solid.facets[facet].plane.normal, up) > 0) return StonePart::crown;
    return angle < k_level_deg ? StonePart::culet : StonePart::pavilion;
}

std::vector<int> main_facets(const Solid& solid, const Vec3& up, bool crown) {
    const int table = table_facet(solid, up);
    const StonePart side = crown ? StonePart::crown : StonePart::pavilion;
    std::set<int> girdle;
    std::vector<int> all;
    for (std::size_t f = 0; f < solid.facets.size(); ++f) {
        const StonePart part = part_of(solid, static_cast<int>(f), table, up);
        const std::vector<int>& corners = solid.facets[f].corners;
        if (part == StonePart::girdle) girdle.insert(corners.begin(), corners.end());
        if (part == side) all.push_back(static_cast<int>(f));
    }
    const std::set<int> end = far_end(solid, up, crown, table);
    std::vector<int> mains;
    for (const int f : all) {
        if (touches(solid.facets[f], end) && touches(solid.facets[f], girdle)) mains.push_back(f);
    }
    if (!mains.empty()) return mains;
    double largest = 0;
    for (const FacetTier& tier : tiers_of(solid, up)) {
        if (tier.part != side) continue;
        double size = 0;
        for (const int f : tier.facets) size += area(solid, solid.facets[f]);
        if (size > largest) {
            largest = size;
            mains = tier.facets;
        }
    }
    return mains;
}

std::vector<FacetTier> tiers_of(const Solid& solid, const Vec3& up) {
    const int table = table_facet(solid, up);
    const std::vector<std::string> names = tier_names_of(solid);
    std::map<std::pair<StonePart, std::string>, std::vector<int>> families;
    for (std::size_t f = 0; f < solid.facets.size(); ++f) {
        const StonePart part = part_of(solid, static_cast<int>(f), table, up);
        families[{part, names[f]}].push_back(static_cast<int>(f));
    }
    std::vector<FacetTier> tiers;
    for (const auto& [key, facets] : families) {
        std::vector<std::vector<int>> groups = by_angle(solid, up, facets);
        // A hand-made mesh's angles are all different: a name is a tier there.
        const bool designed =
            key.second.empty() || std::all_of(groups.begin(), groups.end(),
                                              [](const auto& group) { return group.size() > 1; });
        if (!designed) groups = {facets};
        for (std::vector<int>& group : groups) {
            FacetTier tier;
            tier.part = key.first;
            tier.name = key.second;
            tier.pattern = pattern_of(solid, tier.name, group);
            for (const int f : group) tier.inclination += tilt(solid, f, up);
            tier.inclination /= static_cast<double>(group.size());
            tier.facets = std::move(group);
            tiers.push_back(std::move(tier));
        }
    }
    std::sort(tiers.begin(), tiers.end(),
              [](const FacetTier& a, const FacetTier& b) { return a.facets[0] < b.facets[0]; });
    return tiers;
}

}  // namespace culet
