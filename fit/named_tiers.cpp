#include "fit/named_tiers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <utility>

#include "stone/units.h"

namespace culet {

namespace {

// Facets of one name that differ by more than a hand-made mesh can be off are cut at two settings.
constexpr double k_other_setting_deg = 15;
// Facets without telling names that a design gives one angle differ by the rounding of its file.
constexpr double k_same_setting_deg = 0.05;

// A facet without a name of its own is called f0, f1, ... (stone/facet_names.h).
bool names_a_tier(const std::string& stem) {
    return !stem.empty() && stem != "f";
}

std::string common_prefix(const Solid& solid, const std::vector<int>& facets) {
    std::string prefix = solid.facets[std::size_t(facets.front())].name;
    for (const int f : facets) {
        const std::string& name = solid.facets[std::size_t(f)].name;
        const auto [end, other] =
            std::mismatch(prefix.begin(), prefix.end(), name.begin(), name.end());
        prefix.erase(end, prefix.end());
    }
    return prefix;
}

std::string pattern_of(const Solid& solid, const std::vector<int>& facets) {
    std::string prefix = common_prefix(solid, facets);
    const auto matching = std::count_if(
        solid.facets.begin(), solid.facets.end(),
        [&](const Facet& facet) { return facet.name.starts_with(prefix); });
    if (!prefix.empty() && std::size_t(matching) == facets.size()) return prefix + "*";
    return solid.facets[std::size_t(facets.front())].name + ".." +
           solid.facets[std::size_t(facets.back())].name;
}

// The names that the standard cuts of stone/cuts give; polar angles from up.
std::string words_of(const std::string& stem, double polar, const std::string& pattern) {
    struct Trade {
        const char* stem;
        bool crown;
        const char* words;
    };
    static constexpr std::array<Trade, 5> trade{{{"S", true, "stars"},
                                                 {"C", true, "crown mains"},
                                                 {"U", true, "upper halves"},
                                                 {"L", false, "lower halves"},
                                                 {"P", false, "pavilion mains"}}};
    constexpr double k_girdle_deg = 10;
    if (std::abs(degrees(polar) - 90) < k_girdle_deg) return "girdle facets";
    for (const Trade& t : trade) {
        if (stem == t.stem && t.crown == (degrees(polar) < 90)) return t.words;
    }
    return "facets of tier " + pattern;
}

// Pieces of a list sorted by angle whose neighbours differ by no more than `gap`.
std::vector<std::vector<int>> split_at_gaps(std::vector<std::pair<double, int>> by_angle,
                                            double gap) {
    std::stable_sort(by_angle.begin(), by_angle.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<std::vector<int>> pieces;
    for (std::size_t i = 0; i < by_angle.size(); ++i) {
        if (i == 0 || by_angle[i].first - by_angle[i - 1].first > gap) pieces.emplace_back();
        pieces.back().push_back(by_angle[i].second);
    }
    return pieces;
}

}  // namespace

std::string name_stem(const std::string& name) {
    const std::size_t last = name.find_last_not_of("0123456789.");
    return last == std::string::npos ? std::string() : name.substr(0, last + 1);
}

std::vector<NamedTier> named_tiers(const Solid& solid, const Vec3& up) {
    std::map<std::string, std::vector<std::pair<double, int>>> by_stem;
    std::vector<std::pair<double, int>> rest;
    const auto polar = [&](int f) {
        const Vec3& n = solid.facets[std::size_t(f)].plane.normal;
        return std::atan2(glm::length(glm::cross(up, n)), glm::dot(up, n));
    };
    for (int f = 0; f < int(solid.facets.size()); ++f) {
        const std::string stem = name_stem(solid.facets[std::size_t(f)].name);
        if (names_a_tier(stem)) {
            by_stem[stem].emplace_back(polar(f), f);
        } else {
            rest.emplace_back(polar(f), f);
        }
    }
    std::vector<std::vector<int>> groups;
    for (const auto& [stem, facets] : by_stem) {
        for (std::vector<int>& piece : split_at_gaps(facets, radians(k_other_setting_deg))) {
            if (piece.size() > 1) {
                groups.push_back(std::move(piece));
            } else {
                rest.emplace_back(polar(piece[0]), piece[0]);
            }
        }
    }
    for (std::vector<int>& piece : split_at_gaps(rest, radians(k_same_setting_deg))) {
        if (piece.size() > 1) groups.push_back(std::move(piece));
    }
    std::vector<NamedTier> tiers;
    for (std::vector<int>& facets : groups) {
        std::sort(facets.begin(), facets.end());
        NamedTier tier;
        tier.name = pattern_of(solid, facets);
        tier.words = words_of(name_stem(solid.facets[std::size_t(facets[0])].name),
                              polar(facets[0]), tier.name);
        tier.facets = std::move(facets);
        tiers.push_back(std::move(tier));
    }
    std::sort(tiers.begin(), tiers.end(), [](const NamedTier& a, const NamedTier& b) {
        return a.facets.front() < b.facets.front();
    });
    return tiers;
}

}  // namespace culet
