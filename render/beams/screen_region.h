#pragma once
// Convex regions of the picture and how to cut them.

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "render/beams/screen_view.h"

namespace culet {

/// A range of corners in a shared pool; positively oriented in x and y.
struct Region {
    std::size_t first = 0, count = 0;
};

inline double doubled_area(const ScreenPoint* p, std::size_t count) {
    double sum = 0;
    for (std::size_t i = 2; i < count; ++i) {
        sum +=
            (p[i - 1].x - p[0].x) * (p[i].y - p[0].y) - (p[i].x - p[0].x) * (p[i - 1].y - p[0].y);
    }
    return sum;
}

/// Centroid of the area, which must not be 0.
inline ScreenPoint middle_of(const ScreenPoint* p, std::size_t count) {
    double weight = 0, x = 0, y = 0;
    for (std::size_t i = 2; i < count; ++i) {
        const double ax = p[i - 1].x - p[0].x, ay = p[i - 1].y - p[0].y, bx = p[i].x - p[0].x,
                     by = p[i].y - p[0].y, w = ax * by - bx * ay;
        weight += w;
        x += w * (ax + bx);
        y += w * (ay + by);
    }
    return {p[0].x + x / (3 * weight), p[0].y + y / (3 * weight)};
}

/// Cuts a region by lines l. Keeps the side where l.x x + l.y y + l.z >= 0.
class RegionCutter {
public:
    /// Takes a region to be cut at most `cuts` times; each cut adds at most one corner.
    void take(const ScreenPoint* corners, std::size_t count, std::size_t cuts);
    /// Evaluates the line at all corners; returns the lowest and highest value, including 0.
    std::pair<double, double> measure(const Vec3& line);
    /// Cuts at the line measured last (Sutherland & Hodgman 1974). With opposite signs the
    /// crossings are identical to the bit, so the two parts of a region fit.
    void cut();

    const ScreenPoint* corners() const { return kept_.data(); }
    std::size_t count() const { return count_; }

private:
    std::vector<ScreenPoint> kept_, cut_;
    std::vector<double> sides_;
    std::size_t count_ = 0;
};

inline std::pair<double, double> RegionCutter::measure(const Vec3& line) {
    const ScreenPoint* corner = kept_.data();
    double* sides = sides_.data();
    double lowest = 0, highest = 0;
    for (std::size_t i = 0; i < count_; ++i) {
        sides[i] = line.x * corner[i].x + line.y * corner[i].y + line.z;
        lowest = std::min(lowest, sides[i]);
        highest = std::max(highest, sides[i]);
    }
    return {lowest, highest};
}

inline void RegionCutter::cut() {
    const ScreenPoint* from = kept_.data();
    const double* sides = sides_.data();
    ScreenPoint* to = cut_.data();
    for (std::size_t i = 0, j = count_ - 1; i < count_; j = i++) {
        if ((sides[j] < 0) != (sides[i] < 0)) {
            const double t = sides[j] / (sides[j] - sides[i]);
            *to++ = {from[j].x + t * (from[i].x - from[j].x),
                     from[j].y + t * (from[i].y - from[j].y)};
        }
        if (!(sides[i] < 0)) *to++ = from[i];
    }
    count_ = static_cast<std::size_t>(to - cut_.data());
    std::swap(kept_, cut_);
}

}  // namespace culet
