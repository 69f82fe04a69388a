#include "render/grade/hearts_arrows.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace culet {

namespace {

constexpr double k_least_of_largest = 0.4;
// Where heads, shafts and hearts lie, relative to the radius.
constexpr double k_shaft_from = 0.12, k_head_from = 0.55;
constexpr double k_axis_from = 0.25, k_axis_to = 0.5, k_least_axis = 0.5;
constexpr double k_hearts_from = 0.35, k_hearts_to = 0.92;
constexpr double k_two_pi = 2 * std::numbers::pi;

struct Polar {
    double radius = 0;  // relative to the stone's
    double azimuth = 0;
};

struct Patch {
    std::vector<int> points;
    double area = 0;     // relative to the silhouette's
    double radius = 0;   // of its centre, relative to the stone's
    double azimuth = 0;  // of its centre
};

Polar polar_of(const ScopeMap& map, int at) {
    const double step = 2 * map.half_width / map.size, middle = 0.5 * map.size;
    const double x = (at % map.size + 0.5 - middle) * step;
    const double y = (middle - (at / map.size + 0.5)) * step;
    return {std::hypot(x, y) / map.radius, std::atan2(y, x)};
}

double turned_into_range(double angle) {
    while (angle > std::numbers::pi) angle -= k_two_pi;
    while (angle < -std::numbers::pi) angle += k_two_pi;
    return angle;
}

// Points connect across edges.
std::vector<Patch> patches_of(const ScopeMap& map, const std::function<bool(int)>& belongs) {
    const int count = map.size * map.size;
    std::vector<unsigned char> open(static_cast<std::size_t>(count), 0);
    double silhouette = 0;
    for (int at = 0; at < count; ++at) {
        silhouette += map.inside[static_cast<std::size_t>(at)];
        open[static_cast<std::size_t>(at)] = belongs(at) ? 1 : 0;
    }
    std::vector<Patch> patches;
    for (int start = 0; start < count; ++start) {
        if (open[static_cast<std::size_t>(start)] == 0) continue;
        Patch patch;
        patch.points.push_back(start);
        open[static_cast<std::size_t>(start)] = 0;
        double x = 0, y = 0;
        for (std::size_t i = 0; i < patch.points.size(); ++i) {
            const int at = patch.points[i], column = at % map.size;
            const Polar polar = polar_of(map, at);
            x += polar.radius * std::cos(polar.azimuth);
            y += polar.radius * std::sin(polar.azimuth);
            const auto reach = [&](int to, bool there) {
                if (!there || open[static_cast<std::size_t>(to)] == 0) return;
                open[static_cast<std::size_t>(to)] = 0;
                patch.points.push_back(to);
            };
            reach(at - 1, column > 0);
            reach(at + 1, column + 1 < map.size);
            reach(at - map.size, at >= map.size);
            reach(at + map.size, at + map.size < count);
        }
        const double n = static_cast<double>(patch.points.size());
        patch.area = n / silhouette;
        patch.radius = std::hypot(x, y) / n;
        patch.azimuth = std::atan2(y, x);
        patches.push_back(std::move(patch));
    }
    return patches;
}

// Keeps those that are not much smaller than the largest, in order of azimuth.
std::vector<Patch> large_ones(std::vector<Patch> patches) {
    double largest = 0;
    for (const Patch& patch : patches) largest = std::max(largest, patch.area);
    std::erase_if(patches,
                  [&](const Patch& patch) { return patch.area < k_least_of_largest * largest; });
    std::sort(patches.begin(), patches.end(),
              [](const Patch& a, const Patch& b) { return a.azimuth < b.azimuth; });
    return patches;
}

template <class Item, class Value>
double least_over_most(const std::vector<Item>& items, Value&& value) {
    if (items.empty()) return 0;
    double least = value(items.front()), most = least;
    for (const Item& item : items) {
        least = std::min(least, value(item));
        most = std::max(most, value(item));
    }
    return most > 0 ? std::max(0.0, least / most) : 0;
}

Heart heart_of(const ScopeMap& map, const Patch& patch) {
    // The patch's outer reach, by angle from its centre.
    constexpr int k_bins = 90;
    constexpr double k_bin = std::numbers::pi / 180 / 2;  // half a degree
    std::vector<double> reach(2 * k_bins + 1, 0);
    double low = 0, high = 0;
    for (const int at : patch.points) {
        const Polar polar = polar_of(map, at);
        const double angle = turned_into_range(polar.azimuth - patch.azimuth);
        low = std::min(low, angle);
        high = std::max(high, angle);
        const int bin = static_cast<int>(std::lround(angle / k_bin)) + k_bins;
        if (bin < 0 || bin > 2 * k_bins) continue;
        double& most = reach[static_cast<std::size_t>(bin)];
        most = std::max(most, polar.radius);
    }
    Heart heart{patch.azimuth, patch.area, high - low, 0};
    // The cleft is the least reach in the middle half of the heart.
    const int quarter = static_cast<int>(heart.width / k_bin / 4);
    int notch = k_bins;
    for (int bin = k_bins - quarter; bin <= k_bins + quarter; ++bin) {
        if (bin >= 0 && bin <= 2 * k_bins &&
            reach[static_cast<std::size_t>(bin)] < reach[static_cast<std::size_t>(notch)])
            notch = bin;
    }
    double left = 0, right = 0;
    for (int bin = 0; bin <= 2 * k_bins; ++bin) {
        double& lobe = bin < notch ? right : left;
        lobe = std::max(lobe, reach[static_cast<std::size_t>(bin)]);
    }
    heart.cleft = std::min(left, right) - reach[static_cast<std::size_t>(notch)];
    return heart;
}

// Dark part of the line from the head towards the middle, where an arrow has its shaft.
double dark_share_of_axis(const ScopeMap& map, double azimuth,
                          const std::function<bool(int)>& dark) {
    constexpr int k_samples = 64;
    const double step = 2 * map.half_width / map.size, middle = 0.5 * map.size;
    int count = 0;
    for (int i = 0; i < k_samples; ++i) {
        const double radius =
            map.radius * (k_axis_from + (k_axis_to - k_axis_from) * (i + 0.5) / k_samples);
        const int column = static_cast<int>(middle + radius * std::cos(azimuth) / step);
        const int row = static_cast<int>(middle - radius * std::sin(azimuth) / step);
        if (dark(row * map.size + column)) ++count;
    }
    return static_cast<double>(count) / k_samples;
}

}  // namespace

Arrows find_arrows(const ScopeMap& map) {
    const auto dark = [&](int at) {
        return map.inside[static_cast<std::size_t>(at)] != 0 &&
               map.brightest[static_cast<std::size_t>(at)] == ScopeBand::eye;
    };
    // Heads and shafts may touch, as may shafts in the middle. So heads are patches, and a shaft is
    // what is dark between a head and the middle.
    const std::vector<Patch> heads = large_ones(patches_of(
        map, [&](int at) { return dark(at) && polar_of(map, at).radius >= k_head_from; }));
    Arrows arrows;
    if (heads.empty()) return arrows;
    double silhouette = 0;
    const double half_sector = std::numbers::pi / static_cast<double>(heads.size());
    for (const Patch& head : heads) arrows.list.push_back({head.azimuth, head.area, 0, 0});
    for (int at = 0; at < map.size * map.size; ++at) {
        silhouette += map.inside[static_cast<std::size_t>(at)];
        const Polar polar = polar_of(map, at);
        if (polar.radius < k_shaft_from || polar.radius >= k_head_from) continue;
        for (Arrow& arrow : arrows.list) {
            const double beside = std::abs(turned_into_range(polar.azimuth - arrow.azimuth));
            if (beside < half_sector && dark(at)) arrow.shaft += 1;
        }
    }
    for (Arrow& arrow : arrows.list) {
        arrow.shaft /= silhouette;
        arrow.axis = dark_share_of_axis(map, arrow.azimuth, dark);
        if (arrow.axis >= k_least_axis) ++arrows.count;
        arrows.area += (arrow.head + arrow.shaft) / static_cast<double>(heads.size());
    }
    arrows.evenness = least_over_most(arrows.list, [](const Arrow& a) { return a.head + a.shaft; });
    return arrows;
}

Hearts find_hearts(const ScopeMap& map) {
    const auto lit = [&](int at) {
        const double radius = polar_of(map, at).radius;
        const ScopeBand band = map.brightest[static_cast<std::size_t>(at)];
        return map.inside[static_cast<std::size_t>(at)] != 0 && radius > k_hearts_from &&
               radius < k_hearts_to && (band == ScopeBand::inner || band == ScopeBand::middle);
    };
    Hearts hearts;
    for (const Patch& patch : large_ones(patches_of(map, lit))) {
        hearts.list.push_back(heart_of(map, patch));
        hearts.area += patch.area;
        hearts.cleft += hearts.list.back().cleft;
        if (hearts.list.back().cleft > 0) ++hearts.count;
    }
    if (hearts.list.empty()) return hearts;
    hearts.area /= static_cast<double>(hearts.list.size());
    hearts.cleft /= static_cast<double>(hearts.list.size());
    hearts.evenness = least_over_most(hearts.list, [](const Heart& h) { return h.area; });
    hearts.cleft_evenness = least_over_most(hearts.list, [](const Heart& h) { return h.cleft; });
    return hearts;
}

}  // namespace culet
