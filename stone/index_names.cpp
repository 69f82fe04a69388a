#include "stone/index_names.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <map>
#include <optional>

#include "stone/design.h"
#include "stone/repeating_gear.h"
#include "stone/tiers.h"

namespace culet {

namespace {

// Level facets have no index: below this a machine does not tell where they look.
constexpr double k_no_index_deg = 0.05;

std::optional<double> index_number(std::string_view text) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool whole = error == std::errc() && end == text.data() + text.size();
    return whole && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

std::optional<double> tooth_of(const Facet& facet, double gear) {
    if (gear == 0) return std::nullopt;
    Design wheel;
    wheel.gear = gear;
    const CutSetting setting = setting_of(facet.plane, wheel);
    if (setting.angle_deg < k_no_index_deg) return std::nullopt;
    const double tooth = std::round(100 * setting.index) / 100;
    return tooth > 0 ? tooth : std::abs(gear);
}

// `A` of A.12; empty of what does not end so.
std::string_view before_number(std::string_view name) {
    const std::size_t digits = name.find_last_not_of("0123456789");
    if (digits == std::string_view::npos || digits == 0 || digits + 1 == name.size() ||
        name[digits] != '.') {
        return {};
    }
    return name.substr(0, digits);
}

// Of facets of a design's tier (A, A.1, A.2, ...) its name.
std::vector<std::string> design_tiers(const Solid& solid) {
    std::map<std::string_view, int> count;
    for (const Facet& facet : solid.facets) {
        const std::string_view tier = before_number(facet.name);
        if (!tier.empty() && find_facet(solid, std::string(tier)) >= 0) ++count[tier];
    }
    std::vector<std::string> tiers;
    for (const Facet& facet : solid.facets) {
        const std::string_view tier = before_number(facet.name);
        tiers.emplace_back(count.count(tier) > 0         ? tier
                           : count.count(facet.name) > 0 ? std::string_view(facet.name)
                                                         : std::string_view());
    }
    return tiers;
}

}  // namespace

std::vector<std::string> index_teeth(const Solid& solid, double gear) {
    std::vector<std::string> teeth;
    for (const Facet& facet : solid.facets) {
        const auto tooth = tooth_of(facet, gear);
        teeth.push_back(tooth ? fmt::format("{:g}", *tooth) : std::string());
    }
    return teeth;
}

std::vector<std::string> index_names(const Solid& solid, double gear) {
    const std::vector<std::string> teeth = index_teeth(solid, gear), tiers = design_tiers(solid);
    const std::string wheel = gear == k_usual_gear ? "" : fmt::format("of{:g}", gear);
    std::vector<std::string> names;
    std::map<std::string, int> count;
    for (std::size_t f = 0; f < solid.facets.size(); ++f) {
        const bool named = !tiers[f].empty() && !teeth[f].empty();
        names.push_back(named ? tiers[f] + "@" + teeth[f] + wheel : solid.facets[f].name);
        ++count[names.back()];
    }
    for (std::size_t f = 0; f < names.size(); ++f) {
        if (count[names[f]] > 1) names[f] = solid.facets[f].name;
    }
    return names;
}

std::vector<int> facets_at_index(const Solid& solid, std::string_view name) {
    const std::size_t at = name.rfind('@');
    if (at == std::string_view::npos || at == 0) return {};
    const std::string_view tier = name.substr(0, at);
    std::string_view index = name.substr(at + 1);
    double gear = k_usual_gear;
    if (const std::size_t of = index.find("of"); of != std::string_view::npos) {
        const auto teeth = index_number(index.substr(of + 2));
        if (!teeth || !(std::abs(*teeth) >= 1)) return {};
        gear = *teeth;
        index = index.substr(0, of);
    }
    const auto wanted = index_number(index);
    if (!wanted) return {};
    const std::vector<std::string> designs = design_tiers(solid),
                                   others = tier_names_of(solid, {0, 0, 1});
    std::vector<int> found;
    for (std::size_t f = 0; f < solid.facets.size(); ++f) {
        const Facet& facet = solid.facets[f];
        if (facet.name != tier && designs[f] != tier && others[f] != tier) continue;
        const auto tooth = tooth_of(facet, gear);
        if (tooth && std::abs(std::remainder(*tooth - *wanted, std::abs(gear))) < 0.5) {
            found.push_back(int(f));
        }
    }
    return found;
}

}  // namespace culet
