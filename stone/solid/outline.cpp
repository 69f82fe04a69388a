#include "stone/solid/outline.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <numeric>

namespace culet {

CornerTriple spread_corners(const Solid& solid, const Facet& facet) {
    const std::size_t n = facet.corners.size();
    if (n < 3) return {};
    const auto at = [&](std::size_t i) -> const Vec3& { return solid.vertices[facet.corners[i]]; };
    const auto furthest = [&](auto measure) {
        std::size_t best = 0;
        for (std::size_t i = 1; i < n; ++i) {
            if (measure(at(i)) > measure(at(best))) best = i;
        }
        return best;
    };
    const std::size_t i = furthest([&](const Vec3& p) { return glm::length(p - at(0)); });
    const std::size_t j = furthest([&](const Vec3& p) { return glm::length(p - at(i)); });
    const double reach = glm::length(at(j) - at(i));
    if (!(reach > 0)) return {};
    const Vec3 line = (at(j) - at(i)) / reach;
    const auto distance = [&](const Vec3& p) { return glm::length(glm::cross(p - at(i), line)); };
    const std::size_t k = furthest(distance);
    std::size_t order[3] = {i, j, k};
    std::sort(order, order + 3);
    return {at(order[0]), at(order[1]), at(order[2]), distance(at(k))};
}

std::vector<Vec2> flat_outline(const Solid& solid, const Facet& facet, const Vec3& normal) {
    const Vec3 size = glm::abs(normal);
    const int dropped = size.z >= size.x && size.z >= size.y ? 2 : (size.y >= size.x ? 1 : 0);
    int u = (dropped + 1) % 3, v = (dropped + 2) % 3;
    if (normal[dropped] < 0) std::swap(u, v);
    std::vector<Vec2> outline;
    outline.reserve(facet.corners.size());
    for (const int corner : facet.corners) {
        outline.push_back({solid.vertices[corner][u], solid.vertices[corner][v]});
    }
    return outline;
}

bool is_convex_outline(const std::vector<Vec2>& outline, double allowance) {
    const std::size_t n = outline.size();
    if (n < 3) return false;
    double turned = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const Vec2 &a = outline[i], &b = outline[(i + 1) % n], &c = outline[(i + 2) % n];
        const Vec2 ab = b - a, bc = c - b;
        turned += std::atan2(ab.x * bc.y - ab.y * bc.x, ab.x * bc.x + ab.y * bc.y);
        if (turn(a, b, c) >= 0) continue;
        const Vec2 ac = c - a;
        const double dent = std::abs(ac.x * ab.y - ac.y * ab.x) / std::hypot(ac.x, ac.y);
        if (!(dent <= allowance)) return false;
    }
    // The sum is a whole number of full turns, so rounding cannot mislead.
    return std::abs(turned - 2 * std::numbers::pi) < 1;
}

bool crosses_itself(const std::vector<Vec2>& outline) {
    const std::size_t n = outline.size();
    if (n < 4 || is_convex_outline(outline, 0)) return false;
    const auto end = [&](std::size_t i) -> const Vec2& { return outline[(i + 1) % n]; };
    const auto left = [&](std::size_t i) { return std::min(outline[i].x, end(i).x); };
    const auto right = [&](std::size_t i) { return std::max(outline[i].x, end(i).x); };
    // Sorted by their left ends; only edges that overlap in x are compared.
    std::vector<std::size_t> order(n);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t i, std::size_t j) { return left(i) < left(j); });
    for (std::size_t s = 0; s < n; ++s) {
        for (std::size_t t = s + 1; t < n && left(order[t]) <= right(order[s]); ++t) {
            const std::size_t i = std::min(order[s], order[t]), j = std::max(order[s], order[t]);
            const bool follows = j == i + 1, closes = i == 0 && j == n - 1;
            if (follows || closes) {
                // Neighbours share a corner; they overlap when the outline turns straight back.
                const Vec2& shared = outline[follows ? j : 0];
                const Vec2& before = outline[follows ? i : j];
                const Vec2& after = follows ? end(j) : end(i);
                if (turn(before, shared, after) == 0 &&
                    glm::dot(shared - before, after - shared) < 0)
                    return true;
            } else if (segments_touch(outline[i], end(i), outline[j], end(j))) {
                return true;
            }
        }
    }
    return false;
}

}  // namespace culet
