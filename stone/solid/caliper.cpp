#include "stone/solid/caliper.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "stone/solid/plan.h"

namespace culet {

namespace {

constexpr double k_round = 1.05;

double half_turn(const Vec2& direction) {
    const double angle =
        std::fmod(std::atan2(direction.y, direction.x) + 2 * std::numbers::pi, std::numbers::pi);
    // Just below a half turn counts as 0.
    return std::numbers::pi - angle < 1e-9 ? 0 : angle;
}

}  // namespace

bool CaliperWidths::round() const {
    return least > 0 && length < k_round * least && mean < k_round * least;
}

PlanFrame plan_frame(const Vec3& up) {
    const Vec3 z = glm::normalize(up);
    const Vec3 aside = std::abs(z.x) < 0.9 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    const Vec3 x = glm::normalize(aside - glm::dot(aside, z) * z);
    return {x, glm::cross(z, x)};
}

CaliperWidths caliper_widths(const Solid& solid, const Vec3& up) {
    CaliperWidths widths;
    const PlanFrame frame = plan_frame(up);
    std::vector<Vec2> points;
    for (const Vec3& v : solid.vertices) {
        points.push_back({glm::dot(frame.x, v), glm::dot(frame.y, v)});
    }
    if (points.size() < 3) return widths;
    const double size = diameter(solid);
    // Drops corners within rounding of an edge.
    widths.outline = hull_corners(points, 1e-12 * size * size);
    if (widths.outline.size() < 3) return {};
    std::vector<Vec2> hull;
    for (const int p : widths.outline) hull.push_back(points[std::size_t(p)]);
    const auto extent = [&](const Vec2& direction) {
        double low = INFINITY, high = -INFINITY;
        for (const Vec2& p : hull) {
            low = std::min(low, glm::dot(direction, p));
            high = std::max(high, glm::dot(direction, p));
        }
        return high - low;
    };
    widths.least = INFINITY;
    for (std::size_t i = 0; i < hull.size(); ++i) {
        const Vec2 edge = hull[(i + 1) % hull.size()] - hull[i];
        const double length = glm::length(edge);
        widths.mean += length / std::numbers::pi;
        const Vec2 across{-edge.y / length, edge.x / length};
        // Of equal widths (to rounding) take the first, so that the last digit does not decide.
        if (const double width = extent(across); width < widths.least * (1 - 1e-12)) {
            widths.least = width;
            widths.least_edge = i;
            widths.least_azimuth = half_turn(across);
            widths.length = extent(edge / length);
        }
        for (std::size_t j = i + 1; j < hull.size(); ++j) {
            const Vec2 between = hull[j] - hull[i];
            if (const double width = glm::length(between); width > widths.largest * (1 + 1e-12)) {
                widths.largest = width;
                widths.largest_between = {i, j};
                widths.largest_azimuth = half_turn(between);
            }
        }
    }
    return widths;
}

}  // namespace culet
