#include "stone/design/tiers.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>
#include <set>

#include "stone/design/design.h"
#include "stone/design/drawn_symmetry.h"
#include "stone/numbers/units.h"
#include "stone/solid/angles.h"
#include "stone/solid/checks.h"

namespace culet {

namespace {

// The tables of real designs are tilted by up to a few degrees; the flattest tiers are at 8.
constexpr double k_level_deg = 7;
constexpr double k_girdle_deg = 80;
// Designs give angles to 0.01 degrees.
constexpr double k_same_angle_deg = 0.02;
// Distances have five decimals of the width, and meets miss.
constexpr double k_same_distance = k_largest_miss;
// As near as drawings come to their symmetry (drawn_symmetry.h): radians, and share of half the
// diameter.
constexpr double k_near_drawing = 0.05;

bool touches(const Facet& facet, const std::set<int>& corners) {
    return std::any_of(facet.corners.begin(), facet.corners.end(),
                       [&](int corner) { return corners.contains(corner); });
}

// The table's corners, or the lowest corner and the culet's.
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

// `prefix*` or `prefix.*` if that matches these facets and no others.
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

}  // namespace

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

namespace {

class TierFinder {
public:
    TierFinder(const Solid& solid, const Vec3& up)
        : solid_(solid), up_(up), table_(table_facet(solid, up)), names_(tier_names_of(solid, up)) {
        drawn_ = drawn_symmetry(solid, up, table_);
        middle_ = std::accumulate(solid.vertices.begin(), solid.vertices.end(), Vec3(0)) /
                  static_cast<double>(std::max<std::size_t>(1, solid.vertices.size()));
        const double size = diameter(solid);
        distance_limit_ = k_same_distance * size;
        near_limit_ = 0.5 * k_near_drawing * size;
        for (const std::string& name : names_) ++named_[name];
    }

    // The most frequent: a girdle drawn by hand is not upright everywhere.
    StonePart part(const std::vector<int>& facets) const {
        std::map<StonePart, int> count;
        for (const int f : facets) ++count[part(f)];
        return std::max_element(count.begin(), count.end(),
                                [](const auto& a, const auto& b) { return a.second < b.second; })
            ->first;
    }
    double variance(int facet) const {
        return std::pow(drawn_.tilt_sigma(solid_, facet, up_), 2) +
               std::pow(radians(k_same_angle_deg), 2) / 12;
    }
    std::string name(const std::vector<int>& facets) const {
        const std::string& first = names_[static_cast<std::size_t>(facets.front())];
        const bool common = std::all_of(facets.begin(), facets.end(), [&](int f) {
            return names_[static_cast<std::size_t>(f)] == first;
        });
        return common ? first : std::string();
    }
    // Each is sorted; tiers are in the order of their first facets.
    std::vector<std::vector<int>> tiers() const {
        std::vector<int> root = roots_by_design(places_of(solid_));
        if (root.empty()) root = roots_by_drawing();
        std::map<int, std::vector<int>> by_root;
        for (int f = 0; f < static_cast<int>(root.size()); ++f) {
            by_root[root[static_cast<std::size_t>(f)]].push_back(f);
        }
        std::vector<std::vector<int>> all;
        for (auto& [first, facets] : by_root) all.push_back(std::move(facets));
        return all;
    }

private:
    // For each facet the first of its tier; empty where the design lacks facets.
    static std::vector<int> roots_by_design(const std::vector<DesignPlace>& places) {
        std::map<int, int> first;
        std::vector<int> root;
        for (const DesignPlace& place : places) {
            if (place.tier < 0) return {};
            root.push_back(first.try_emplace(place.tier, int(root.size())).first->second);
        }
        return root;
    }
    std::vector<int> roots_by_drawing() const {
        std::vector<int> root(solid_.facets.size());
        std::iota(root.begin(), root.end(), 0);
        const auto join = [&](int a, int b) {
            const int from = root[static_cast<std::size_t>(a)],
                      to = root[static_cast<std::size_t>(b)];
            if (from == to) return;
            std::replace(root.begin(), root.end(), std::max(from, to), std::min(from, to));
        };
        for (const FacetOrbit& orbit : orbits_of(drawn_.group, solid_.facets.size())) {
            for (const int f : orbit.facets) {
                for (const int other : orbit.facets) {
                    if (other < f && may_belong(f, other)) join(f, other);
                }
            }
        }
        // A common name confirms what the drawing alone would separate.
        for (const FacetOrbit& orbit : orbits_of(drawn_.near, solid_.facets.size())) {
            for (const int f : orbit.facets) {
                for (const int other : orbit.facets) {
                    if (other < f && have_one_name(f, other)) join(f, other);
                }
            }
        }
        for (int f = 0; f < static_cast<int>(root.size()); ++f) {
            for (int other = 0; other < f; ++other) {
                if (are_cut_alike(f, other) || are_one_name_and_near(f, other)) join(f, other);
            }
        }
        return root;
    }

    StonePart part(int facet) const { return part_of(solid_, facet, table_, up_); }
    // Names that each belong to several facets separate tiers.
    bool may_belong(int a, int b) const {
        const std::string& one = names_[static_cast<std::size_t>(a)];
        const std::string& other = names_[static_cast<std::size_t>(b)];
        const auto tells = [&](const std::string& name) {
            return !name.empty() && named_.at(name) > 1;
        };
        return one == other || !tells(one) || !tells(other);
    }
    bool have_one_name(int a, int b) const {
        const std::string& name = names_[static_cast<std::size_t>(a)];
        return !name.empty() && name == names_[static_cast<std::size_t>(b)];
    }
    double from_middle(int f) const {
        const Plane& p = solid_.facets[static_cast<std::size_t>(f)].plane;
        return p.offset - glm::dot(p.normal, middle_);
    }
    // If one askew facet spoils the symmetry, a common name confirms near facets.
    bool are_one_name_and_near(int a, int b) const {
        return drawn_.near.is_trivial() && have_one_name(a, b) && part(a) == part(b) &&
               std::abs(tilt(solid_, a, up_) - tilt(solid_, b, up_)) < k_near_drawing &&
               std::abs(from_middle(a) - from_middle(b)) < near_limit_;
    }
    // One setting of the machine apart from the index; a name stands for the same distance.
    bool are_cut_alike(int a, int b) const {
        if (std::abs(tilt(solid_, a, up_) - tilt(solid_, b, up_)) > radians(k_same_angle_deg) ||
            part(a) != part(b) || !may_belong(a, b)) {
            return false;
        }
        if (have_one_name(a, b)) return true;
        const Plane& p = solid_.facets[static_cast<std::size_t>(a)].plane;
        const Plane& q = solid_.facets[static_cast<std::size_t>(b)].plane;
        return std::abs(p.offset - q.offset) < distance_limit_ ||
               std::abs(from_middle(a) - from_middle(b)) < distance_limit_;
    }

    const Solid& solid_;
    const Vec3& up_;
    int table_;
    std::vector<std::string> names_;
    std::map<std::string, int> named_;
    DrawnSymmetry drawn_;
    Vec3 middle_;
    double distance_limit_ = 0, near_limit_ = 0;
};

}  // namespace

std::vector<FacetTier> tiers_of(const Solid& solid, const Vec3& up) {
    const TierFinder finder(solid, up);
    std::vector<FacetTier> tiers;
    for (std::vector<int>& facets : finder.tiers()) {
        FacetTier tier;
        tier.part = finder.part(facets);
        tier.name = finder.name(facets);
        tier.pattern = pattern_of(solid, tier.name, facets);
        const double count = static_cast<double>(facets.size());
        for (const int f : facets) {
            tier.inclination += tilt(solid, f, up) / count;
            tier.scatter += finder.variance(f) / count;
        }
        tier.scatter = std::sqrt(tier.scatter);
        tier.facets = std::move(facets);
        tiers.push_back(std::move(tier));
    }
    return tiers;
}

}  // namespace culet
