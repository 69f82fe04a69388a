#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <optional>
#include <utility>

#include "stone/numbers/units.h"
#include "stone/solid/checks.h"
#include "stone/solid/perpendicular.h"
#include "stone/solid/plan.h"
#include "stone/upright.h"

namespace culet {

namespace {

// A table is among the largest facets; the pieces of a scanned or triangulated facet are smaller.
constexpr std::size_t k_most_tables = 16;
// Share of the outline's area: tables of standard cuts take 0.2 to 0.7; the flat base of a rose, a
// cabochon or a pyramid takes nearly all.
constexpr double k_least_share = 0.1, k_most_share = 0.85;
// The other side ends in a point, an edge, or a culet of at most this share of the table's area.
constexpr double k_largest_culet = 0.4;
// Shares of the depth: how far the outline's corners lie from one plane, and how far that is below
// the table.
constexpr double k_girdle_band = 0.2, k_least_crown = 0.02, k_most_crown = 0.45;
// Distance of the table's middle from the outline's, in square roots of the outline's area.
constexpr double k_off_middle = 0.2;

struct PlanCorner {
    PlanPoint place;
    double height = 0;
};

class TableTest {
public:
    TableTest(const Solid& solid, const std::vector<double>& areas)
        : solid_(solid), areas_(areas) {}

    bool holds(int facet) const {
        const Vec3 n = facet_at(facet).plane.normal;
        const Vec3 x = perpendicular_to(n), y = glm::cross(n, x);
        std::vector<PlanCorner> corners;
        for (const Vec3& v : solid_.vertices)
            corners.push_back({{glm::dot(v, x), glm::dot(v, y)}, glm::dot(v, n)});
        const auto [low, high] = std::minmax_element(
            corners.begin(), corners.end(),
            [](const PlanCorner& a, const PlanCorner& b) { return a.height < b.height; });
        const double bottom = low->height, top = high->height, depth = top - bottom;
        const auto is_at_top = [&](int corner) {
            return corners[std::size_t(corner)].height > top - k_least_crown * depth;
        };
        if (!std::all_of(facet_at(facet).corners.begin(), facet_at(facet).corners.end(), is_at_top))
            return false;
        const PlanOutline outline = outline_of(corners);
        const double size = area_of(outline);
        const double table = facing(n, k_table_tilt), end = facing(-n, 2 * k_table_tilt);
        if (!(table > k_least_share * size && table < k_most_share * size &&
              end < k_largest_culet * table)) {
            return false;
        }
        return girdle_is_flat(corners, outline, top, depth) &&
               is_in_the_middle(corner_mean(solid_, facet_at(facet)), x, y, outline, size);
    }

private:
    const Facet& facet_at(int facet) const { return solid_.facets[std::size_t(facet)]; }

    double facing(const Vec3& direction, double tilt) const {
        double sum = 0;
        for (std::size_t f = 0; f < solid_.facets.size(); ++f) {
            if (glm::dot(solid_.facets[f].plane.normal, direction) > std::cos(tilt))
                sum += areas_[f];
        }
        return sum;
    }

    static PlanOutline outline_of(const std::vector<PlanCorner>& corners) {
        std::vector<PlanPoint> places;
        for (const PlanCorner& c : corners) places.push_back(c.place);
        return convex_hull(std::move(places));
    }

    static bool girdle_is_flat(const std::vector<PlanCorner>& corners, const PlanOutline& outline,
                               double top, double depth) {
        const auto before = [](const PlanPoint& a, const PlanPoint& b) {
            return std::pair(a.x, a.y) < std::pair(b.x, b.y);
        };
        PlanOutline sorted = outline;
        std::sort(sorted.begin(), sorted.end(), before);
        double low = INFINITY, high = -INFINITY;
        for (const PlanCorner& c : corners) {
            if (!std::binary_search(sorted.begin(), sorted.end(), c.place, before)) continue;
            low = std::min(low, c.height);
            high = std::max(high, c.height);
        }
        const double crown = top - (low + high) / 2;
        return high - low < k_girdle_band * depth && crown > k_least_crown * depth &&
               crown < k_most_crown * depth;
    }

    static bool is_in_the_middle(const Vec3& table, const Vec3& x, const Vec3& y,
                                 const PlanOutline& outline, double size) {
        const PlanPoint off =
            PlanPoint{glm::dot(table, x), glm::dot(table, y)} - middle_of(outline);
        return std::hypot(off.x, off.y) < k_off_middle * std::sqrt(size);
    }

    const Solid& solid_;
    const std::vector<double>& areas_;
};

}  // namespace

std::optional<int> table_by_shape(const Solid& solid) {
    if (!is_closed(solid) || !(volume(solid) > 0)) return {};
    std::vector<double> areas;
    for (const Facet& facet : solid.facets) areas.push_back(area(solid, facet));
    std::vector<int> order(solid.facets.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [&](int a, int b) { return areas[std::size_t(a)] > areas[std::size_t(b)]; });
    if (order.size() > k_most_tables) order.resize(k_most_tables);
    const TableTest is_table(solid, areas);
    std::optional<int> found;
    for (const int facet : order) {
        if (!is_table.holds(facet)) continue;
        const auto normal = [&](int f) { return solid.facets[std::size_t(f)].plane.normal; };
        if (!found) found = facet;
        if (glm::dot(normal(*found), normal(facet)) < std::cos(2 * k_table_tilt)) return {};
    }
    return found;
}

}  // namespace culet
