#include "stone/setting/section_path.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "stone/text/errors.h"

namespace culet {

namespace {

// Outward normal of the way from a to b: angle from outward, counter-clockwise; -pi/2 is down.
double normal_angle(const PlanPoint& a, const PlanPoint& b) {
    return std::atan2(-(b.x - a.x), b.y - a.y);
}

PlanPoint at_angle(double angle) {
    return {std::cos(angle), std::sin(angle)};
}

// Normal angles before the first corner, of every side, and after the last corner.
std::vector<double> normal_angles(const std::vector<PlanPoint>& hull) {
    std::vector<double> angles{-std::numbers::pi / 2};
    for (std::size_t i = 0; i + 1 < hull.size(); ++i)
        angles.push_back(normal_angle(hull[i], hull[i + 1]));
    angles.push_back(std::numbers::pi / 2);
    return angles;
}

}  // namespace

std::vector<PlanPoint> outer_hull_of(const std::vector<PlanPoint>& points) {
    const PlanOutline hull = convex_hull(points);
    const auto lower = [](const PlanPoint& a, const PlanPoint& b) {
        return a.y < b.y || (a.y == b.y && a.x < b.x);
    };
    // Of several lowest or highest corners take the outermost.
    std::size_t lowest = 0, highest = 0;
    for (std::size_t i = 0; i < hull.size(); ++i) {
        if (hull[i].y < hull[lowest].y ||
            (hull[i].y == hull[lowest].y && hull[i].x > hull[lowest].x))
            lowest = i;
        if (lower(hull[highest], hull[i])) highest = i;
    }
    std::vector<PlanPoint> outer;
    for (std::size_t i = lowest;; i = (i + 1) % hull.size()) {
        outer.push_back(hull[i]);
        if (i == highest) break;
    }
    return outer;
}

std::vector<PlanPoint> outer_hull(const Solid& solid, const GirdlePlace& place, double half_width) {
    const PlanPoint out = place.outward, aside{-out.y, out.x};
    std::vector<PlanPoint> points;
    // The part of every edge between the two planes. A facet's hull is that of its edges' parts.
    for (const Facet& facet : solid.facets) {
        for (std::size_t i = 0; i < facet.corners.size(); ++i) {
            const Vec3 &a = solid.vertices[facet.corners[i]],
                       &b = solid.vertices[facet.corners[(i + 1) % facet.corners.size()]];
            const PlanPoint from = PlanPoint(a) - place.at, to = PlanPoint(b) - place.at;
            const double s = glm::dot(from, aside), t = glm::dot(to, aside);
            double first = 0, last = 1;
            for (const double bound : {-half_width, half_width}) {
                if ((s < bound) == (t < bound)) {
                    if ((s < bound) == (bound > 0)) continue;
                    last = -1;  // the whole edge is outside
                    break;
                }
                const double cut = (bound - s) / (t - s);
                if ((s < bound) == (bound > 0)) {
                    last = std::min(last, cut);
                } else {
                    first = std::max(first, cut);
                }
            }
            if (first > last) continue;
            for (const double at : {first, last})
                points.emplace_back(glm::dot(from + at * (to - from), out), a.z + at * (b.z - a.z));
        }
    }
    if (points.size() < 3) throw InputError("the stone has nothing to grip where a prong stands");
    return outer_hull_of(points);
}

std::vector<PlanPoint> curve_beside(const std::vector<PlanPoint>& hull, double distance,
                                    int steps) {
    const std::vector<double> angles = normal_angles(hull);
    std::vector<PlanPoint> curve;
    for (std::size_t i = 0; i < hull.size(); ++i) {
        const double turn = angles[i + 1] - angles[i];
        const int chords =
            std::max(1, static_cast<int>(std::ceil(turn * steps / (2 * std::numbers::pi))));
        for (int k = 0; k <= chords; ++k)
            curve.push_back(hull[i] + distance * at_angle(angles[i] + turn * k / chords));
    }
    return curve;
}

std::vector<PlanPoint> taut_path(const std::vector<PlanPoint>& curve, const PlanPoint& from,
                                 double inside) {
    // The tangent point: the whole curve lies to the left of the line to it.
    std::size_t tangent = 0;
    for (std::size_t i = 1; i < curve.size(); ++i) {
        if (cross(curve[tangent] - from, curve[i] - from) < 0) tangent = i;
    }
    std::vector<PlanPoint> path{from};
    for (std::size_t i = tangent; i < curve.size(); ++i) {
        if (curve[i].x < inside && i > tangent && curve[i - 1].x > inside) {
            const double t = (inside - curve[i - 1].x) / (curve[i].x - curve[i - 1].x);
            path.push_back(curve[i - 1] + t * (curve[i] - curve[i - 1]));
            return path;
        }
        path.push_back(curve[i]);
    }
    // Over a flat top the path continues level.
    if (path.back().x > inside) path.emplace_back(inside, path.back().y);
    return path;
}

std::vector<PlanPoint> taut_path_between(const std::vector<PlanPoint>& curve, const PlanPoint& from,
                                         const PlanPoint& to) {
    std::vector<PlanPoint> path{from};
    for (const PlanPoint& point : curve) {
        if (point.y <= from.y || point.y >= to.y || cross(to - from, point - from) >= 0) continue;
        while (path.size() > 1 &&
               cross(path.back() - path[path.size() - 2], point - path.back()) <= 0)
            path.pop_back();
        path.push_back(point);
    }
    while (path.size() > 1 && cross(path.back() - path[path.size() - 2], to - path.back()) <= 0)
        path.pop_back();
    path.push_back(to);
    return path;
}

std::vector<PlanPoint> line_beside(const std::vector<PlanPoint>& hull, double distance,
                                   double inside) {
    // Lines that touch the hull; neighbours differ by at most 45 degrees.
    struct Touching {
        PlanPoint at{0, 0};
        double angle = 0;
    };
    const std::vector<double> angles = normal_angles(hull);
    std::vector<Touching> lines;
    for (std::size_t i = 0; i < hull.size(); ++i) {
        const double turn = angles[i + 1] - angles[i];
        const int parts = std::max(1, static_cast<int>(std::ceil(turn / (std::numbers::pi / 4))));
        for (int k = i == 0 ? 0 : 1; k <= parts; ++k)
            lines.push_back({hull[i], angles[i] + turn * k / parts});
    }
    std::vector<PlanPoint> line;
    for (std::size_t i = 0; i + 1 < lines.size(); ++i) {
        const double turn = lines[i + 1].angle - lines[i].angle;
        if (turn < 1e-9) continue;
        // Where both lines meet after moving outward.
        const PlanPoint first = at_angle(lines[i].angle), next = at_angle(lines[i + 1].angle);
        const double a = glm::dot(lines[i].at, first) + distance,
                     b = glm::dot(lines[i + 1].at, next) + distance;
        line.push_back(PlanPoint(a * next.y - b * first.y, b * first.x - a * next.x) /
                       std::sin(turn));
    }
    std::vector<PlanPoint> kept;
    for (std::size_t i = 0; i < line.size(); ++i) {
        if (i > 0 && (line[i - 1].x < inside) != (line[i].x < inside)) {
            const double t = (inside - line[i - 1].x) / (line[i].x - line[i - 1].x);
            kept.push_back(line[i - 1] + t * (line[i] - line[i - 1]));
        }
        if (line[i].x >= inside) kept.push_back(line[i]);
    }
    if (kept.size() < 3) throw InputError("the stone is too flat at its girdle for a bezel");
    return kept;
}

}  // namespace culet
