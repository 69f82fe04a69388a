#include "render/grade/scope_map.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

namespace culet {

namespace {

constexpr double k_room = 1.04;

struct Frame {
    double x = 0, y = 0, half = 1;  // middle and half width
    int size = 1;
    double column(double px) const { return (px - x + half) / (2 * half) * size; }
    double row(double py) const { return (y + half - py) / (2 * half) * size; }
};

Frame frame_of(const EyeLight& light, int size) {
    double low_x = std::numeric_limits<double>::infinity(), low_y = low_x;
    double high_x = -low_x, high_y = -low_x;
    for (const std::vector<ScreenPoint>& outline : light.regions) {
        for (const ScreenPoint& p : outline) {
            low_x = std::min(low_x, p.x);
            high_x = std::max(high_x, p.x);
            low_y = std::min(low_y, p.y);
            high_y = std::max(high_y, p.y);
        }
    }
    if (!(high_x > low_x)) return {0, 0, 1, size};
    const double half = 0.5 * k_room * std::max(high_x - low_x, high_y - low_y);
    return {0.5 * (low_x + high_x), 0.5 * (low_y + high_y), half, size};
}

// Calls `point` for every map point whose centre lies in the convex outline.
template <class Point>
void for_points_in(const Frame& frame, const std::vector<ScreenPoint>& outline, Point&& point) {
    if (outline.size() < 3) return;
    double top = frame.size, bottom = 0;
    for (const ScreenPoint& p : outline) {
        top = std::min(top, frame.row(p.y));
        bottom = std::max(bottom, frame.row(p.y));
    }
    const int first = std::max(0, static_cast<int>(std::floor(top - 0.5)));
    const int last = std::min(frame.size - 1, static_cast<int>(std::ceil(bottom)));
    for (int row = first; row <= last; ++row) {
        const double middle = row + 0.5;
        double from = frame.size, to = 0;
        bool meets = false;
        for (std::size_t i = 0; i < outline.size(); ++i) {
            const ScreenPoint &p = outline[i], &q = outline[(i + 1) % outline.size()];
            const double y0 = frame.row(p.y), y1 = frame.row(q.y);
            if ((y0 <= middle) == (y1 <= middle)) continue;
            const double x0 = frame.column(p.x), x1 = frame.column(q.x);
            const double x = x0 + (middle - y0) / (y1 - y0) * (x1 - x0);
            from = std::min(from, x);
            to = std::max(to, x);
            meets = true;
        }
        if (!meets) continue;
        const int begin = std::max(0, static_cast<int>(std::ceil(from - 0.5)));
        for (int column = begin; column < frame.size && column + 0.5 < to; ++column)
            point(row * frame.size + column);
    }
}

}  // namespace

ScopeMap scope_map(const EyeLight& light, const ScopeBands& bands, int size) {
    ScopeMap map;
    const Frame frame = frame_of(light, size);
    const std::size_t count = static_cast<std::size_t>(size) * static_cast<std::size_t>(size);
    map.size = size;
    map.half_width = frame.half;
    map.radius = std::sqrt(light.area / std::numbers::pi);
    map.shares.assign(count, BandShares{});
    map.inside.assign(count, 0);
    for (std::size_t i = 0; i < light.exits.size(); ++i) {
        const EyeExit& exit = light.exits[i];
        if (exit.parent < 0)
            for_points_in(frame, light.regions[i],
                          [&](int at) { map.inside[static_cast<std::size_t>(at)] = 1; });
        if (!(exit.weight > 0)) continue;
        const auto band =
            static_cast<std::size_t>(bands.of(glm::dot(exit.direction, light.towards_eye)));
        for_points_in(frame, light.regions[i], [&](int at) {
            map.shares[static_cast<std::size_t>(at)][band] += exit.weight;
        });
    }
    map.brightest.reserve(count);
    for (const BandShares& shares : map.shares) {
        const auto most = std::max_element(shares.begin(), shares.end());
        map.brightest.push_back(static_cast<ScopeBand>(most - shares.begin()));
    }
    return map;
}

}  // namespace culet
