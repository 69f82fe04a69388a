#include "stone/solid/plan.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>
#include <utility>

#include "stone/text/errors.h"

namespace culet {

namespace {

PlanPoint normal_of(const PlanPoint& from, const PlanPoint& to) {
    const PlanPoint along = glm::normalize(to - from);
    return {along.y, -along.x};
}

// Velocity of the corner between two edges when both move outward at unit speed.
PlanPoint corner_speed(const PlanPoint& a, const PlanPoint& b) {
    const double cosine = glm::dot(a, b);
    if (cosine < -1 + 1e-9) throw InputError("the outline is too narrow to be moved so far");
    return (a + b) / (1 + cosine);
}

}  // namespace

std::vector<int> hull_corners(const std::vector<PlanPoint>& points, double least_area) {
    const auto at = [&](int p) -> const PlanPoint& { return points[std::size_t(p)]; };
    std::vector<int> order(points.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
        return std::pair(at(a).x, at(a).y) < std::pair(at(b).x, at(b).y);
    });
    std::vector<int> hull;
    for (int pass = 0; pass < 2; ++pass) {
        const std::size_t begin = hull.size();
        for (const int p : order) {
            while (hull.size() >= begin + 2 && cross(at(hull.back()) - at(hull[hull.size() - 2]),
                                                     at(p) - at(hull.back())) <= least_area) {
                hull.pop_back();
            }
            hull.push_back(p);
        }
        hull.pop_back();
        std::reverse(order.begin(), order.end());
    }
    return hull;
}

PlanOutline convex_hull(const std::vector<PlanPoint>& points) {
    PlanOutline hull;
    for (const int p : hull_corners(points, 0)) hull.push_back(points[std::size_t(p)]);
    return hull;
}

double area_of(const PlanOutline& outline) {
    double twice = 0;
    for (std::size_t i = 0; i < outline.size(); ++i)
        twice += cross(outline[i], outline[(i + 1) % outline.size()]);
    return twice / 2;
}

PlanOutline moved_outline(const PlanOutline& outline, double distance) {
    const std::size_t count = outline.size();
    const double sign = distance < 0 ? -1 : 1;
    // Edge i begins at corner i. `left` are the remaining edges; left[k] begins at starts[k].
    std::vector<PlanPoint> normals;
    for (std::size_t i = 0; i < count; ++i)
        normals.push_back(normal_of(outline[i], outline[(i + 1) % count]));
    std::vector<std::size_t> left(count);
    std::iota(left.begin(), left.end(), std::size_t{0});
    PlanOutline starts = outline;
    double still = std::abs(distance);
    while (true) {
        const std::size_t size = left.size();
        if (size < 3) throw InputError("the outline is too narrow to be moved so far");
        std::vector<PlanPoint> speeds;
        for (std::size_t k = 0; k < size; ++k)
            speeds.push_back(sign *
                             corner_speed(normals[left[(k + size - 1) % size]], normals[left[k]]));
        double soonest = still;
        std::size_t vanishes = size;
        for (std::size_t k = 0; k < size; ++k) {
            const PlanPoint& normal = normals[left[k]];
            const PlanPoint along{-normal.y, normal.x};
            const std::size_t next = (k + 1) % size;
            const double length = glm::dot(starts[next] - starts[k], along);
            const double shrinks = -glm::dot(speeds[next] - speeds[k], along);
            if (!(shrinks > 0)) continue;
            const double after = std::max(length, 0.0) / shrinks;
            if (after >= soonest) continue;
            soonest = after;
            vanishes = k;
        }
        for (std::size_t k = 0; k < size; ++k) starts[k] += soonest * speeds[k];
        still -= soonest;
        if (vanishes == size) break;
        left.erase(left.begin() + static_cast<std::ptrdiff_t>(vanishes));
        starts.erase(starts.begin() + static_cast<std::ptrdiff_t>(vanishes));
    }
    // A corner goes where the next remaining edge begins.
    PlanOutline moved(count);
    for (std::size_t i = 0; i < count; ++i) {
        const auto next = std::lower_bound(left.begin(), left.end(), i);
        moved[i] = starts[next == left.end() ? 0 : static_cast<std::size_t>(next - left.begin())];
    }
    return moved;
}

double length_round(const PlanOutline& outline) {
    double length = 0;
    for (std::size_t i = 0; i < outline.size(); ++i)
        length += glm::length(outline[(i + 1) % outline.size()] - outline[i]);
    return length;
}

PlanPoint middle_of(const PlanOutline& outline) {
    double area = 0;
    PlanPoint moment{0, 0};
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const PlanPoint a = outline[i] - outline[0],
                        b = outline[(i + 1) % outline.size()] - outline[0];
        area += cross(a, b);
        moment += cross(a, b) * (a + b) / 3.0;
    }
    return outline[0] + moment / area;
}

double inner_radius(const PlanOutline& convex_outline) {
    return -distance_outside(convex_outline, middle_of(convex_outline));
}

double distance_outside(const PlanOutline& outline, const PlanPoint& point) {
    double nearest = std::numeric_limits<double>::infinity();
    bool inside = false;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const PlanPoint &a = outline[i], &b = outline[(i + 1) % outline.size()];
        const PlanPoint side = b - a;
        const double t = std::clamp(glm::dot(point - a, side) / glm::dot(side, side), 0.0, 1.0);
        nearest = std::min(nearest, glm::length(a + t * side - point));
        if ((a.y > point.y) != (b.y > point.y) &&
            point.x < a.x + (point.y - a.y) / (b.y - a.y) * (b.x - a.x))
            inside = !inside;
    }
    return inside ? -nearest : nearest;
}

double distance_along(const PlanOutline& outline, const PlanPoint& from,
                      const PlanPoint& direction) {
    double nearest = -1;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const PlanPoint &a = outline[i], side = outline[(i + 1) % outline.size()] - a;
        const double across = cross(direction, side);
        if (across == 0) continue;
        const double t = cross(a - from, side) / across, s = cross(a - from, direction) / across;
        if (t > 0 && s >= 0 && s <= 1 && (nearest < 0 || t < nearest)) nearest = t;
    }
    return nearest;
}

}  // namespace culet
