#include "render/scene/environment_layout.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

namespace culet {

namespace {

constexpr double k_pi = std::numbers::pi;

// CubeMap::direction of ImfEnvmap.cpp in culet's axes: face, then s (right) and t (down) in -1..1.
Vec3 on_cube(int face, double s, double t) {
    switch (face) {
        case 0:  // OpenEXR +X
            return {1, -t, s};
        case 1:  // -X
            return {-1, -t, -s};
        case 2:  // +Y
            return {s, 1, -t};
        case 3:  // -Y
            return {s, -1, t};
        case 4:  // +Z
            return {-s, -t, 1};
        default:  // -Z
            return {s, -t, -1};
    }
}

Vec3 culet_of_exr(const Vec3& v) {
    return {v.z, v.x, v.y};
}
Vec3 exr_of_culet(const Vec3& v) {
    return {v.y, v.z, v.x};
}

// Signed solid angle of the rectangle from (0, 0) to (x, y) at distance 1.
double corner_angle(double x, double y) {
    return std::atan2(x * y, std::sqrt(x * x + y * y + 1));
}

struct Lat {
    const EnvironmentMap& map;
    Vec3 direction(double column, double row) const {
        return lat_long_direction(column, row, map.width, map.height);
    }
    MapPlace place(const Vec3& d) const { return lat_long_place(d, map.width, map.height); }
    double solid_angle(int, int row) const {
        return lat_long_solid_angle(row, map.width, map.height);
    }
    // Relative density of solid angle within a texel.
    static double density(const Vec3& d) { return std::hypot(d.x, d.y); }
};
struct Cube {
    const EnvironmentMap& map;
    Vec3 direction(double column, double row) const {
        return cube_direction(column, row, map.width);
    }
    MapPlace place(const Vec3& d) const { return cube_place(d, map.width); }
    double solid_angle(int column, int row) const {
        return cube_solid_angle(column, row % map.width, map.width);
    }
    // The largest component is 1 over the distance to the unit cube.
    static double density(const Vec3& d) {
        const double most = std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
        return most * most * most;
    }
};

std::size_t texel_at(const EnvironmentMap& map, const MapPlace& place) {
    const int x = std::clamp(static_cast<int>(place.column), 0, map.width - 1);
    const int y = std::clamp(static_cast<int>(place.row), 0, map.height - 1);
    return 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width) +
                static_cast<std::size_t>(x));
}

constexpr double k_unlimited = std::numeric_limits<double>::infinity();

// Of the light up to `most`.
template <class Layout>
Rgb energy_of(const Layout& layout, const Rgb& most = {k_unlimited, k_unlimited, k_unlimited}) {
    Rgb sum{};
    const EnvironmentMap& map = layout.map;
    for (int y = 0; y < map.height; ++y) {
        for (int x = 0; x < map.width; ++x) {
            const double omega = layout.solid_angle(x, y);
            const std::size_t at = 3 * (static_cast<std::size_t>(y) * map.width + x);
            for (std::size_t c = 0; c < 3; ++c)
                sum[c] += omega * std::min<double>(map.rgb[at + c], most[c]);
        }
    }
    return sum;
}

// Samples per texel and direction: several per texel of the finer map.
int steps_for(double coarse, double fine) {
    return std::clamp(static_cast<int>(std::ceil(4 * coarse / fine)), 4, 24);
}

double pitch_of(const EnvironmentMap& map) {
    return std::sqrt(4 * k_pi / (static_cast<double>(map.rgb.size()) / 3));
}

// Sets the target to the light up to `most`: mean over an even grid in each texel, weighted by
// solid angle.
template <class From, class To>
void sample_up_to(const Rgb& most, const From& from, EnvironmentMap& to_map, const To& to) {
    const EnvironmentMap& source = from.map;
    const int steps = steps_for(pitch_of(to_map), pitch_of(source));
    for (int y = 0; y < to_map.height; ++y) {
        for (int x = 0; x < to_map.width; ++x) {
            Rgb sum{};
            double weight = 0;
            for (int k = 0; k < steps * steps; ++k) {
                const double column = x + (k % steps + 0.5) / steps;
                const double row = y + (k / steps + 0.5) / steps;
                const Vec3 d = to.direction(column, row);
                const double density = To::density(d);
                const std::size_t at = texel_at(source, from.place(d));
                for (std::size_t c = 0; c < 3; ++c)
                    sum[c] += density * std::min<double>(source.rgb[at + c], most[c]);
                weight += density;
            }
            const std::size_t at = 3 * (static_cast<std::size_t>(y) * to_map.width + x);
            for (std::size_t c = 0; c < 3; ++c)
                to_map.rgb[at + c] = static_cast<float>(sum[c] / weight);
        }
    }
}

// Adds the light above `most`: moves each piece of a source texel, with its solid angle, to one
// target texel.
template <class From, class To>
void move_above(const Rgb& most, const From& from, EnvironmentMap& to_map, const To& to) {
    const EnvironmentMap& source = from.map;
    const int pieces = steps_for(pitch_of(source), pitch_of(to_map));
    std::vector<double> carried(to_map.rgb.size(), 0.0);
    for (int y = 0; y < source.height; ++y) {
        for (int x = 0; x < source.width; ++x) {
            const std::size_t at = 3 * (static_cast<std::size_t>(y) * source.width + x);
            Rgb excess{};
            for (std::size_t c = 0; c < 3; ++c)
                excess[c] = std::max(0.0, source.rgb[at + c] - most[c]);
            if (excess[0] + excess[1] + excess[2] <= 0) continue;
            const double omega = from.solid_angle(x, y) / (pieces * pieces);
            for (int k = 0; k < pieces * pieces; ++k) {
                const Vec3 d = from.direction(x + (k % pieces + 0.5) / pieces,
                                              y + (k / pieces + 0.5) / pieces);
                const std::size_t target = texel_at(to_map, to.place(d));
                for (std::size_t c = 0; c < 3; ++c) carried[target + c] += omega * excess[c];
            }
        }
    }
    for (int y = 0; y < to_map.height; ++y) {
        for (int x = 0; x < to_map.width; ++x) {
            const double omega = to.solid_angle(x, y);
            const std::size_t at = 3 * (static_cast<std::size_t>(y) * to_map.width + x);
            for (std::size_t c = 0; c < 3; ++c)
                to_map.rgb[at + c] += static_cast<float>(carried[at + c] / omega);
        }
    }
}

template <class From, class To>
void resample(const From& from, EnvironmentMap& to_map, const To& to) {
    const Rgb energy = energy_of(from);
    Rgb most{};
    for (std::size_t c = 0; c < 3; ++c) most[c] = 4 * energy[c] / (4 * k_pi);
    sample_up_to(most, from, to_map, to);
    // Sampling is off by about a thousandth: scale it to the right total.
    const Rgb base = energy_of(from, most), sampled = energy_of(to);
    for (std::size_t i = 0; i < to_map.rgb.size(); ++i) {
        if (sampled[i % 3] > 0)
            to_map.rgb[i] = static_cast<float>(to_map.rgb[i] * (base[i % 3] / sampled[i % 3]));
    }
    move_above(most, from, to_map, to);
}

EnvironmentMap empty_map(int width, int height) {
    EnvironmentMap map;
    map.width = width;
    map.height = height;
    map.rgb.resize(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    return map;
}

}  // namespace

Vec3 lat_long_direction(double column, double row, int width, int height) {
    const double azimuth = (0.5 - column / width) * 2 * k_pi, polar = row / height * k_pi;
    return {std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth),
            std::cos(polar)};
}

MapPlace lat_long_place(const Vec3& d, int width, int height) {
    const double azimuth = std::atan2(d.y, d.x), polar = std::atan2(std::hypot(d.x, d.y), d.z);
    return {(0.5 - azimuth / (2 * k_pi)) * width, polar / k_pi * height};
}

double lat_long_solid_angle(int row, int width, int height) {
    // cos a - cos b, without cancellation at the poles.
    const double middle = (row + 0.5) * k_pi / height, half = 0.5 * k_pi / height;
    return 2 * k_pi / width * 2 * std::sin(middle) * std::sin(half);
}

Vec3 cube_direction(double column, double row, int size) {
    const int face = std::clamp(static_cast<int>(row / size), 0, 5);
    const double s = 2 * column / size - 1, t = 2 * (row - face * size) / size - 1;
    return glm::normalize(culet_of_exr(on_cube(face, s, t)));
}

MapPlace cube_place(const Vec3& direction, int size) {
    const Vec3 d = exr_of_culet(direction), a = glm::abs(d);
    int face = 0;
    double s = 0, t = 0;
    if (a.x >= a.y && a.x >= a.z) {
        face = d.x > 0 ? 0 : 1;
        s = d.z / d.x;  // signed: matches on_cube's faces 0 and 1
        t = -d.y / a.x;
    } else if (a.y >= a.z) {
        face = d.y > 0 ? 2 : 3;
        s = d.x / a.y;
        t = -d.z / d.y;
    } else {
        face = d.z > 0 ? 4 : 5;
        s = -d.x / d.z;
        t = -d.y / a.z;
    }
    const double inside = size * (1 - 1e-12);
    return {std::clamp((s + 1) / 2 * size, 0.0, inside),
            face * static_cast<double>(size) + std::clamp((t + 1) / 2 * size, 0.0, inside)};
}

double cube_solid_angle(int column, int row, int size) {
    const double x0 = 2.0 * column / size - 1, x1 = 2.0 * (column + 1) / size - 1;
    const double y0 = 2.0 * row / size - 1, y1 = 2.0 * (row + 1) / size - 1;
    return corner_angle(x0, y0) - corner_angle(x0, y1) - corner_angle(x1, y0) +
           corner_angle(x1, y1);
}

Rgb lat_long_energy(const EnvironmentMap& map) {
    return energy_of(Lat{map});
}
Rgb cube_energy(const EnvironmentMap& cube) {
    return energy_of(Cube{cube});
}

EnvironmentMap cube_of_lat_long(const EnvironmentMap& map, int size) {
    EnvironmentMap cube = empty_map(size, 6 * size);
    resample(Lat{map}, cube, Cube{cube});
    return cube;
}

EnvironmentMap lat_long_of_cube(const EnvironmentMap& cube, int width) {
    EnvironmentMap map = empty_map(width, width / 2);
    resample(Cube{cube}, map, Lat{map});
    return map;
}

}  // namespace culet
