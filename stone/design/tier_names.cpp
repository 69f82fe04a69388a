// What facets' names tell about tiers.

#include <map>
#include <set>

#include "stone/design/tiers.h"

namespace culet {

namespace {

// G for GNE; empty where the name has no side.
std::string before_side(const std::string& name) {
    for (const std::string_view side : {"NE", "NW", "SE", "SW", "N", "E", "S", "W"}) {
        if (name.size() > side.size() && name.ends_with(side)) {
            return name.substr(0, name.size() - side.size());
        }
    }
    return {};
}

// A for A.1; empty for any other name.
std::string repeated_name(const std::string& name) {
    const std::size_t digits = name.find_last_not_of("0123456789") + 1;
    const bool numbered = digits > 1 && digits < name.size() && name[digits - 1] == '.';
    return numbered ? name.substr(0, digits - 1) : std::string();
}

std::vector<std::string> stems_of(const Solid& solid) {
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
            names.push_back(name.substr(0, digits));
            continue;
        }
        // C1NE, P2Ea have a tier's number before the letters of the side; GNE has none.
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

std::vector<std::string> tier_names_of(const Solid& solid, const Vec3& up) {
    std::vector<std::string> names = stems_of(solid);
    const int table = table_facet(solid, up);
    std::map<std::string, std::set<bool>> sides;
    for (std::size_t f = 0; f < names.size(); ++f) {
        const StonePart part = part_of(solid, static_cast<int>(f), table, up);
        if (part != StonePart::girdle) {
            sides[names[f]].insert(part == StonePart::table || part == StonePart::crown);
        }
    }
    for (std::size_t f = 0; f < names.size(); ++f) {
        const bool numbered = names[f] == "f" && solid.facets[f].name != "f";
        if (numbered || sides[names[f]].size() > 1) names[f].clear();
    }
    return names;
}

}  // namespace culet
