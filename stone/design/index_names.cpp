#include "stone/design/index_names.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <map>
#include <optional>

#include "stone/design/design.h"
#include "stone/design/repeating_gear.h"
#include "stone/design/tiers.h"

namespace culet {

namespace {

// Level facets have no index. Below this tilt a machine does not show where they face.
constexpr double k_no_index_deg = 0.05;

std::optional<double> index_number(std::string_view text) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool whole = error == std::errc() && end == text.data() + text.size();
    return whole && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

// The tier and the tooth of each facet, as a cutter calls them.
class Places {
public:
    Places(const Solid& solid, double gear)
        : solid_(solid), gear_(gear), places_(places_of(solid)) {
        if (solid.design) titles_ = tier_titles(*solid.design);
    }

    /// Empty: no tier.
    std::string tier(std::size_t f) const {
        return places_[f].tier < 0 ? std::string() : titles_[std::size_t(places_[f].tier)];
    }

    /// The design's tooth, which a fit keeps; for other facets and on another wheel, the azimuth.
    std::optional<double> tooth(std::size_t f) const {
        if (gear_ == 0) return std::nullopt;
        Design wheel;
        wheel.gear = gear_;
        const CutSetting cut = setting_of(solid_.facets[f].plane, wheel);
        if (cut.angle_deg < k_no_index_deg) return std::nullopt;
        double index = cut.index;
        if (places_[f].tier >= 0 && solid_.design->gear == gear_) {
            const DesignTier& tier = solid_.design->tiers[std::size_t(places_[f].tier)];
            index = tier.facets[std::size_t(places_[f].facet)].index;
        }
        const double teeth = std::abs(gear_);
        const double tooth = std::fmod(std::round(100 * index) / 100, teeth);
        return tooth > 0 ? tooth : tooth + teeth;
    }

    std::string told_tooth(std::size_t f) const {
        const auto number = tooth(f);
        return number ? fmt::format("{:g}", *number) : std::string();
    }

private:
    const Solid& solid_;
    double gear_;
    std::vector<DesignPlace> places_;
    std::vector<std::string> titles_;
};

}  // namespace

std::vector<std::string> index_teeth(const Solid& solid, double gear) {
    std::vector<std::string> teeth;
    const Places places(solid, gear);
    for (std::size_t f = 0; f < solid.facets.size(); ++f) teeth.push_back(places.told_tooth(f));
    return teeth;
}

std::vector<std::string> index_names(const Solid& solid, double gear) {
    const Places places(solid, gear);
    const std::string wheel = gear == k_usual_gear ? "" : fmt::format("of{:g}", gear);
    std::vector<std::string> names;
    std::map<std::string, int> count;
    for (std::size_t f = 0; f < solid.facets.size(); ++f) {
        const std::string tier = places.tier(f), tooth = places.told_tooth(f);
        const bool named = !tier.empty() && !tooth.empty();
        names.push_back(named ? tier + "@" + tooth + wheel : solid.facets[f].name);
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
    const Places places(solid, gear);
    const std::vector<std::string> others = tier_names_of(solid, {0, 0, 1});
    std::vector<int> found;
    for (std::size_t f = 0; f < solid.facets.size(); ++f) {
        if (solid.facets[f].name != tier && places.tier(f) != tier && others[f] != tier) continue;
        const auto tooth = places.tooth(f);
        if (tooth && std::abs(std::remainder(*tooth - *wanted, std::abs(gear))) < 0.5) {
            found.push_back(int(f));
        }
    }
    return found;
}

}  // namespace culet
