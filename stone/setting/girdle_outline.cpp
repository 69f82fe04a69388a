#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <optional>

#include "stone/solid/plan.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

// Share of the largest area; smaller sections are not girdle.
constexpr double k_girdle_area = 0.998;
constexpr std::size_t k_most_levels = 200;
constexpr int k_levels_between = 32;

using EdgeName = std::pair<int, int>;

struct SectionSide {
    EdgeName from, to;  // edges of the solid where it begins and ends
    PlanPoint start{0, 0}, end{0, 0};
};

// The sides of the section at `z`; each has the solid on its left.
std::vector<SectionSide> section(const Solid& solid, double z) {
    std::vector<SectionSide> sides;
    struct Crossing {
        EdgeName edge;
        PlanPoint at{0, 0};
        bool rises = false;
    };
    for (const Facet& facet : solid.facets) {
        std::vector<Crossing> crossings;
        for (std::size_t i = 0; i < facet.corners.size(); ++i) {
            const int a = facet.corners[i], b = facet.corners[(i + 1) % facet.corners.size()];
            const Vec3 &low = solid.vertices[std::min(a, b)],
                       &high = solid.vertices[std::max(a, b)];
            if ((low.z >= z) == (high.z >= z)) continue;
            const double t = (z - low.z) / (high.z - low.z);
            crossings.push_back(
                {{std::min(a, b), std::max(a, b)},
                 PlanPoint(low.x + t * (high.x - low.x), low.y + t * (high.y - low.y)),
                 solid.vertices[b].z >= z});
        }
        // Order along the section, which has the solid on its left. Falling edges come first.
        const PlanPoint along{-facet.plane.normal.y, facet.plane.normal.x};
        std::stable_sort(crossings.begin(), crossings.end(),
                         [&](const Crossing& a, const Crossing& b) {
                             return glm::dot(a.at, along) < glm::dot(b.at, along);
                         });
        for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
            const bool in_order = !crossings[i].rises;
            const Crossing &first = crossings[in_order ? i : i + 1],
                           &last = crossings[in_order ? i + 1 : i];
            sides.push_back({first.edge, last.edge, first.at, last.at});
        }
    }
    return sides;
}

double area_of(const std::vector<SectionSide>& sides) {
    double area = 0;
    for (const SectionSide& side : sides) area += 0.5 * cross(side.start, side.end);
    return area;
}

std::vector<double> levels_of(const Solid& solid) {
    std::vector<double> levels;
    for (const Vec3& vertex : solid.vertices) levels.push_back(vertex.z);
    std::sort(levels.begin(), levels.end());
    const double extent = levels.back() - levels.front();
    const auto end = std::unique(levels.begin(), levels.end(),
                                 [extent](double a, double b) { return b - a <= 1e-9 * extent; });
    levels.erase(end, levels.end());
    if (levels.size() > k_most_levels) {
        const double low = levels.front(), step = extent / k_most_levels;
        levels.clear();
        for (std::size_t i = 0; i <= k_most_levels; ++i)
            levels.push_back(low + step * static_cast<double>(i));
    }
    return levels;
}

// Between two levels the area is a quadratic, found from three sections.
struct Stretch {
    double low = 0, high = 0, at_middle = 0, slope = 0, bend = 0;

    double area(double t) const { return at_middle + (t - 0.5) * (slope + (t - 0.5) * bend); }
};

double height_of_girdle(const Solid& solid) {
    const std::vector<double> levels = levels_of(solid);
    std::vector<Stretch> stretches;
    double largest = 0;
    for (std::size_t i = 0; i + 1 < levels.size(); ++i) {
        Stretch stretch{levels[i], levels[i + 1]};
        const auto at = [&](double t) {
            return area_of(section(solid, stretch.low + t * (stretch.high - stretch.low)));
        };
        const double before = at(0.25), after = at(0.75);
        stretch.at_middle = at(0.5);
        stretch.slope = 2 * (after - before);
        stretch.bend = 8 * (after + before - 2 * stretch.at_middle);
        stretches.push_back(stretch);
        for (int k = 0; k <= k_levels_between; ++k)
            largest = std::max(largest, stretch.area(double(k) / k_levels_between));
    }
    std::optional<double> low, high;
    for (const Stretch& stretch : stretches) {
        for (int k = 0; k <= k_levels_between; ++k) {
            const double t = double(k) / k_levels_between;
            if (stretch.area(t) < k_girdle_area * largest) continue;
            high = stretch.low + t * (stretch.high - stretch.low);
            if (!low) low = high;
        }
    }
    if (!low || !(largest > 0)) throw InputError("the stone has no girdle: it has no extent");
    return 0.5 * (*low + *high);
}

PlanOutline cleaned(const PlanOutline& points) {
    PlanOutline kept = points;
    const double near = 1e-5 * length_round(points);
    for (std::size_t i = 0; kept.size() > 3 && i < kept.size();) {
        const PlanPoint &before = kept[(i + kept.size() - 1) % kept.size()], &at = kept[i],
                        &after = kept[(i + 1) % kept.size()];
        const double turn = cross(at - before, after - at);
        const double scale = glm::length(at - before) * glm::length(after - at);
        if (glm::length(after - at) < near || std::abs(turn) <= 1e-9 * scale) {
            kept.erase(kept.begin() + static_cast<std::ptrdiff_t>(i));
        } else {
            ++i;
        }
    }
    return kept;
}

}  // namespace

GirdleOutline girdle_outline(const Solid& solid) {
    if (solid.vertices.empty()) throw InputError("the stone has no girdle: it is empty");
    GirdleOutline girdle;
    girdle.height = height_of_girdle(solid);
    const std::vector<SectionSide> sides = section(solid, girdle.height);
    std::map<EdgeName, std::size_t> side_from;
    for (std::size_t i = 0; i < sides.size(); ++i) side_from.emplace(sides[i].from, i);
    double largest = 0;
    std::vector<bool> seen(sides.size(), false);
    for (std::size_t first = 0; first < sides.size(); ++first) {
        PlanOutline loop;
        double area = 0;
        for (std::size_t i = first; !seen[i];) {
            seen[i] = true;
            loop.push_back(sides[i].start);
            area += 0.5 * cross(sides[i].start, sides[i].end);
            const auto next = side_from.find(sides[i].to);
            if (next == side_from.end()) throw InputError("the stone is not closed at its girdle");
            i = next->second;
        }
        if (area <= largest) continue;
        largest = area;
        girdle.points = std::move(loop);
    }
    girdle.points = cleaned(girdle.points);
    if (girdle.points.size() < 3) throw InputError("the stone has no girdle: it has no extent");
    return girdle;
}

}  // namespace culet
