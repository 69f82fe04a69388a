#include "render/beams/disc_in_part.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "render/beams/screen_region.h"

namespace culet {

namespace {

// In pixels: for narrower parts only the width is used.
constexpr float k_least_width = 1e-3f;

double cross(const ScreenPoint& a, const ScreenPoint& b) {
    return a.x * b.y - a.y * b.x;
}
double dot(const ScreenPoint& a, const ScreenPoint& b) {
    return a.x * b.x + a.y * b.y;
}

// Twice the signed area of the circle within the triangle of its centre and an edge.
double doubled_area_in_circle(const ScreenPoint& p, const ScreenPoint& q, double radius) {
    const ScreenPoint d{q.x - p.x, q.y - p.y};
    const double a = dot(d, d), b = dot(p, d), c = dot(p, p) - radius * radius;
    const auto sector = [&](const ScreenPoint& from, const ScreenPoint& to) {
        return radius * radius * std::atan2(cross(from, to), dot(from, to));
    };
    const double discriminant = b * b - a * c;
    if (!(discriminant > 0)) return sector(p, q);
    const double root = std::sqrt(discriminant), first = (-b - root) / a, last = (-b + root) / a;
    if (first >= 1 || last <= 0) return sector(p, q);
    const auto at = [&](double t) { return ScreenPoint{p.x + t * d.x, p.y + t * d.y}; };
    const ScreenPoint in = first > 0 ? at(first) : p, out = last < 1 ? at(last) : q;
    return (first > 0 ? sector(p, in) : 0) + cross(in, out) + (last < 1 ? sector(out, q) : 0);
}

}  // namespace

double share_in_circle(const ScreenPoint* corners, std::size_t count, double radius) {
    double inside = 0, all = 0;
    for (std::size_t i = 0, j = count - 1; i < count; j = i++) {
        inside += doubled_area_in_circle(corners[j], corners[i], radius);
        all += cross(corners[j], corners[i]);
    }
    return all != 0 ? std::clamp(inside / all, 0.0, 1.0) : 0;
}

double share_in_disc(const Fragments& fragments, int fragment, const PartBesideDisc& seen) {
    if (fragments.corners == nullptr || fragment >= fragments.count) return -1;
    const float xx = fragments.xx[fragment], yx = fragments.yx[fragment],
                yy = fragments.yy[fragment];
    if (!(std::min(xx, yy) > k_least_width)) return -1;
    const ScreenPoint middle{fragments.reference.x + static_cast<double>(fragments.x[fragment]),
                             fragments.reference.y + static_cast<double>(fragments.y[fragment])};
    // Clip the region to the pixel.
    const double left = std::floor(middle.x), top = std::floor(middle.y);
    thread_local RegionCutter cutter;
    cutter.take(fragments.corners, fragments.corner_count, 4);
    for (const Vec3& line :
         {Vec3{1, 0, -left}, Vec3{-1, 0, left + 1}, Vec3{0, 1, -top}, Vec3{0, -1, top + 1}}) {
        cutter.measure(line);
        cutter.cut();
        if (cutter.count() < 3) return -1;
    }
    // Derivatives per pixel; then the part's corners relative to the disc.
    const Vec3 y = seen.down / static_cast<double>(yy),
               x = (seen.along - static_cast<double>(yx) * y) / static_cast<double>(xx);
    const double length = glm::length(x);
    if (!(length > 0)) return -1;
    const Vec3 first = x / length, second = glm::cross(seen.normal, first);
    thread_local std::vector<ScreenPoint> corners;
    corners.clear();
    for (std::size_t i = 0; i < cutter.count(); ++i) {
        const ScreenPoint& corner = cutter.corners()[i];
        const Vec3 at = seen.offset + (corner.x - middle.x) * x + (corner.y - middle.y) * y;
        corners.push_back({glm::dot(at, first), glm::dot(at, second)});
    }
    return share_in_circle(corners.data(), corners.size(), seen.radius);
}

}  // namespace culet
