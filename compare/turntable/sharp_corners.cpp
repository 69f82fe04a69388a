#include "compare/turntable/sharp_corners.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "stone/solid/plan.h"

namespace culet {

namespace {

// Pixels: distance of a side's points from its chord; reach of blur along the sides; largest
// distance of a corner from its blurred image.
constexpr double k_one_side = 0.5, k_blurred = 3, k_farthest_px = 6;
constexpr double k_turn = 0.14;  // radians, 8 degrees: a flatter corner is blurred by less than 0.1
constexpr std::size_t k_least = 4;

struct Line {
    glm::dvec2 through, along;
};

// Total least squares.
Line line_through(const std::vector<glm::dvec2>& points) {
    glm::dvec2 mean(0);
    for (const glm::dvec2& p : points) mean += p / double(points.size());
    double xx = 0, xy = 0, yy = 0;
    for (const glm::dvec2& p : points) {
        const glm::dvec2 d = p - mean;
        xx += d.x * d.x;
        xy += d.x * d.y;
        yy += d.y * d.y;
    }
    const double angle = std::atan2(2 * xy, xx - yy) / 2;
    return {mean, {std::cos(angle), std::sin(angle)}};
}

std::optional<glm::dvec2> crossing_of(const Line& a, const Line& b) {
    const double sine = cross(a.along, b.along);
    if (std::abs(sine) < std::sin(k_turn)) return std::nullopt;
    return a.through + a.along * (cross(b.through - a.through, b.along) / sine);
}

std::vector<glm::dvec2> between(const std::vector<glm::dvec2>& points, const glm::dvec2& from,
                                const glm::dvec2& to) {
    const glm::dvec2 along = glm::normalize(to - from);
    const double length = glm::distance(from, to);
    std::vector<glm::dvec2> found;
    for (const glm::dvec2& p : points) {
        const double at = glm::dot(p - from, along);
        if (at < k_blurred || at > length - k_blurred) continue;
        if (std::abs(cross(along, p - from)) < 2 * k_one_side) found.push_back(p);
    }
    return found;
}

}  // namespace

SharpOutline sharpened(const std::vector<glm::dvec2>& points) {
    std::vector<cv::Point2f> all, hull, polygon;
    for (const glm::dvec2& p : points) all.emplace_back(float(p.x), float(p.y));
    cv::convexHull(all, hull);
    cv::approxPolyDP(hull, polygon, k_one_side, true);
    const std::size_t sides = polygon.size();
    const auto corner = [&](std::size_t i) {
        const cv::Point2f& p = polygon[i % sides];
        return glm::dvec2(double(p.x), double(p.y));
    };
    std::vector<std::optional<Line>> lines;
    for (std::size_t i = 0; i < sides; ++i) {
        const std::vector<glm::dvec2> on = between(points, corner(i), corner(i + 1));
        lines.push_back(on.size() < k_least ? std::optional<Line>() : line_through(on));
    }
    SharpOutline result;
    std::vector<glm::dvec2> sharp;
    for (std::size_t i = 0; i < sides; ++i) {
        const auto &before = lines[(i + sides - 1) % sides], &after = lines[i];
        const glm::dvec2 seen = corner(i);
        std::optional<glm::dvec2> found;
        if (before && after) found = crossing_of(*before, *after);
        if (found && glm::distance(*found, seen) > k_farthest_px) found.reset();
        result.corners.push_back(found.value_or(seen));
        const glm::dvec2 in = glm::normalize(seen - corner(i + sides - 1)),
                         out = glm::normalize(corner(i + 1) - seen);
        if (std::abs(cross(in, out)) > std::sin(k_turn)) sharp.push_back(result.corners.back());
    }
    for (const glm::dvec2& p : points) {
        const bool displaced = std::any_of(sharp.begin(), sharp.end(), [&](const glm::dvec2& c) {
            return glm::distance(p, c) < k_blurred;
        });
        if (!displaced) result.points.push_back(p);
    }
    return result;
}

}  // namespace culet
