#include "fit/silhouettes/projected_outline.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "stone/solid/perpendicular.h"

namespace culet {

namespace {

struct FlatCorner {
    double x = 0, y = 0;
    int corner = -1;
};

double turn(const FlatCorner& a, const FlatCorner& b, const FlatCorner& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

}  // namespace

FlatContour flattened(const Contour& contour, int set) {
    FlatContour flat;
    flat.across = perpendicular_to(contour.direction);
    flat.along = glm::cross(contour.direction, flat.across);
    flat.points.reserve(contour.points.size());
    for (const Vec3& p : contour.points) {
        flat.points.push_back({glm::dot(p, flat.across), glm::dot(p, flat.along)});
    }
    flat.weights = contour.weights;
    flat.sigma = contour.sigma;
    flat.set = set;
    return flat;
}

ProjectedOutline projected_outline(std::span<const Vec3> corners, const Vec3& across,
                                   const Vec3& along, const Vec3& nearing) {
    std::vector<FlatCorner> flat(corners.size());
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const double near = 1 - glm::dot(corners[i], nearing);
        flat[i] = {glm::dot(corners[i], across) / near, glm::dot(corners[i], along) / near, int(i)};
    }
    std::sort(flat.begin(), flat.end(), [](const FlatCorner& a, const FlatCorner& b) {
        return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.corner < b.corner;
    });
    std::vector<FlatCorner> hull(2 * flat.size() + 1);
    std::size_t count = 0;
    const auto add = [&](const FlatCorner& c, std::size_t least) {
        while (count >= least && turn(hull[count - 2], hull[count - 1], c) <= 0) --count;
        hull[count++] = c;
    };
    for (const FlatCorner& c : flat) add(c, 2);
    const std::size_t lower = count + 1;
    for (std::size_t i = flat.size(); i-- > 1;) add(flat[i - 1], lower);
    ProjectedOutline outline;
    for (std::size_t i = 0; i + 1 < count; ++i) {
        const FlatCorner &a = hull[i], &b = hull[i + 1];
        const double dx = b.x - a.x, dy = b.y - a.y, length = std::hypot(dx, dy);
        if (!(length > 0)) continue;
        ProjectedOutline::Edge e;
        e.from = a.corner;
        e.to = b.corner;
        e.tx = dx / length;
        e.ty = dy / length;
        e.nx = e.ty;
        e.ny = -e.tx;
        e.offset = e.nx * a.x + e.ny * a.y;
        e.begin = e.tx * a.x + e.ty * a.y;
        e.length = length;
        outline.edges.push_back(e);
    }
    return outline;
}

ProjectedOutline::Nearest ProjectedOutline::nearest(double x, double y) const {
    Nearest best;
    for (std::size_t i = 0; i < edges.size(); ++i) {
        const Edge& e = edges[i];
        const double d = e.nx * x + e.ny * y - e.offset;
        if (best.edge < 0 || d > best.distance) best = {int(i), d};
    }
    return best;
}

double ProjectedOutline::part_of(const Edge& edge, double x, double y) const {
    return std::clamp((edge.tx * x + edge.ty * y - edge.begin) / edge.length, 0.0, 1.0);
}

}  // namespace culet
