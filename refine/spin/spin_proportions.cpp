#include "refine/spin/spin_proportions.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <set>

#include "stone/design/tiers.h"
#include "stone/numbers/units.h"
#include "stone/solid/angles.h"
#include "stone/solid/caliper.h"

namespace culet {

namespace {

const Vec3 k_up{0, 0, 1};
constexpr std::size_t k_least_mains = 3;
constexpr double k_one_tier = radians(6.0), k_same_side = radians(20.0);

struct Rims {
    std::optional<double> upper, lower;  // mean heights of the girdle's corners
};

// Where crown and pavilion meet the girdle, or each other.
Rims rims_of(const StandingStone& stone) {
    const Solid& solid = stone.solid;
    const int table = table_facet(solid, k_up);
    std::set<int> crown, girdle, pavilion;
    for (std::size_t f = 0; f < solid.facets.size(); ++f) {
        const StonePart part = part_of(solid, int(f), table, k_up);
        std::set<int>& corners = part == StonePart::girdle                              ? girdle
                                 : part == StonePart::table || part == StonePart::crown ? crown
                                                                                        : pavilion;
        corners.insert(solid.facets[f].corners.begin(), solid.facets[f].corners.end());
    }
    const auto mean_height = [&](const std::set<int>& a,
                                 const std::set<int>& b) -> std::optional<double> {
        double sum = 0;
        int count = 0;
        for (const int c : a) {
            if (b.count(c) == 0) continue;
            sum += solid.vertices[std::size_t(c)].z;
            ++count;
        }
        if (count == 0) return std::nullopt;
        return sum / count;
    };
    const std::set<int>& below = girdle.empty() ? pavilion : girdle;
    const std::set<int>& above = girdle.empty() ? crown : girdle;
    return {mean_height(crown, below), mean_height(pavilion, above)};
}

void add_angle(const StandingStone& stone, bool crown, std::vector<SpinProportion>& all) {
    const std::vector<int> mains = main_facets(stone.solid, k_up, crown);
    double least = HUGE_VAL, most = -HUGE_VAL;
    for (const int f : mains) {
        const double tilt = inclination(stone.solid.facets[std::size_t(f)].plane.normal, k_up);
        least = std::min(least, tilt);
        most = std::max(most, tilt);
    }
    // Facets that differ more are no tier: found facets are often in pieces.
    if (mains.size() < k_least_mains || most - least > k_one_tier) return;
    SpinProportion angle{crown ? "crown_angle_deg" : "pavilion_angle_deg", 0, 0, true};
    double squares = 0;
    for (const int f : mains) {
        const double tilt = inclination(stone.solid.facets[std::size_t(f)].plane.normal, k_up);
        angle.value += degrees(tilt) / double(mains.size());
        squares += std::pow(degrees(stone.tilt_sigmas[std::size_t(f)]), 2);
        angle.read = angle.read && stone.seen[std::size_t(f)];
    }
    angle.sigma = std::sqrt(squares) / double(mains.size());
    all.push_back(angle);
}

void add_heights(const StandingStone& stone, double width, double length_sigma,
                 std::vector<SpinProportion>& all) {
    double top = -HUGE_VAL, bottom = HUGE_VAL;
    for (const Vec3& v : stone.solid.vertices) {
        top = std::max(top, v.z);
        bottom = std::min(bottom, v.z);
    }
    const double sigma = 100 * length_sigma / width;
    const bool read = stone.edges > 0 && ends_are_seen(stone.solid, stone.seen, k_up);
    all.push_back({"depth_pct", 100 * (top - bottom) / width, sigma, read});
    const Rims rims = rims_of(stone);
    if (!rims.upper || !rims.lower) return;
    all.push_back({"crown_height_pct", 100 * (top - *rims.upper) / width, sigma, stone.edges > 0});
    all.push_back({"girdle_pct", 100 * (*rims.upper - *rims.lower) / width, sigma, true});
    all.push_back({"pavilion_depth_pct", 100 * (*rims.lower - bottom) / width, sigma, read});
}

// Whether a crown facet that is seen bounds the table at its end towards `way`.
bool end_is_seen(const StandingStone& stone, const Facet& table, const Vec3& way) {
    const std::vector<Vec3>& all = stone.solid.vertices;
    const int end =
        *std::max_element(table.corners.begin(), table.corners.end(), [&](int a, int b) {
            return glm::dot(all[std::size_t(a)], way) < glm::dot(all[std::size_t(b)], way);
        });
    for (std::size_t f = 0; f < stone.seen.size(); ++f) {
        const Facet& facet = stone.solid.facets[f];
        const Vec3 out{facet.plane.normal.x, facet.plane.normal.y, 0};
        if (stone.seen[f] && facet.name != table.name && angle_between(out, way) < k_same_side &&
            std::count(facet.corners.begin(), facet.corners.end(), end) > 0)
            return true;
    }
    return false;
}

// Along the stone's least width.
void add_table(const StandingStone& stone, const Vec3& across, double width, double length_sigma,
               std::vector<SpinProportion>& all) {
    for (const Facet& table : stone.solid.facets) {
        if (table.name != k_table_name) continue;
        double least = HUGE_VAL, most = -HUGE_VAL;
        for (const int c : table.corners) {
            const double at = glm::dot(across, stone.solid.vertices[std::size_t(c)]);
            least = std::min(least, at);
            most = std::max(most, at);
        }
        all.push_back({"table_pct", 100 * (most - least) / width,
                       100 * std::sqrt(2.0) * length_sigma / width,
                       end_is_seen(stone, table, across) && end_is_seen(stone, table, -across)});
    }
}

}  // namespace

std::vector<SpinProportion> proportions_of(const StandingStone& stone, double length_sigma) {
    const CaliperWidths calipers = caliper_widths(stone.solid);
    const Vec3 across{std::cos(calipers.least_azimuth), std::sin(calipers.least_azimuth), 0},
        along{-across.y, across.x, 0};
    const double width = calipers.least;
    const bool width_seen = ends_are_seen(stone.solid, stone.seen, across);
    const double part = length_sigma / width;
    std::vector<SpinProportion> all{{"width", width, length_sigma, width_seen},
                                    {"length_to_width", calipers.length / width,
                                     std::hypot(1.0, calipers.length / width) * part,
                                     width_seen && ends_are_seen(stone.solid, stone.seen, along)}};
    add_table(stone, across, width, length_sigma, all);
    add_heights(stone, width, length_sigma, all);
    add_angle(stone, true, all);
    add_angle(stone, false, all);
    return all;
}

const SpinProportion* proportion(const std::vector<SpinProportion>& all, const std::string& name) {
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const auto& p) { return p.name == name; });
    return found == all.end() ? nullptr : &*found;
}

}  // namespace culet
