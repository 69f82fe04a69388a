#pragma once
// Pictures of imaginary stones: a polygon of flat colour cells on a plain ground, so that every
// transform and gain between two of them is known.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include "compare/photo/photo.h"

namespace culet::synthetic {

struct StonePicture {
    int width = 320, height = 300;
    double centre_x = 158.3, centre_y = 149.6;  ///< pixels
    double diameter = 200;                      ///< of the circle about the long axis, pixels
    double turn = 0;                            ///< radians, clockwise as seen
    double flatness = 0.8;                      ///< short over long axis
    int sides = 10;
    bool mirrored = false;
    std::uint64_t pattern = 1;  ///< seed of the cells
    double cell_shift = 0;      ///< how far cells are moved, in radii: a slightly wrong stone
    double gain[3] = {1, 1, 1};
    double ground = 0.002;  ///< linear
    bool with_coverage = false;
    int samples = 4;  ///< per pixel and axis
};

struct Cell {
    double x, y, colour[3];
};

inline std::vector<Cell> cells_of(const StonePicture& p) {
    std::mt19937_64 random(p.pattern), other(p.pattern + 1000);
    const auto uniform = [](std::mt19937_64& r) {
        return static_cast<double>(r() >> 11) * 0x1.0p-53;
    };
    std::vector<Cell> cells(70);
    for (Cell& cell : cells) {
        cell.x = 2 * uniform(random) - 1;
        cell.y = 2 * uniform(random) - 1;
        const double bright = 0.02 * std::pow(30.0, uniform(random));
        for (double& c : cell.colour) c = bright * (0.7 + 0.6 * uniform(random));
        cell.x += p.cell_shift * (2 * uniform(other) - 1);
        cell.y += p.cell_shift * (2 * uniform(other) - 1);
    }
    return cells;
}

inline bool inside_outline(const StonePicture& p, double u, double v) {
    v /= p.flatness;
    for (int i = 0; i < p.sides; ++i) {
        // Slightly irregular, so that no turn maps the outline onto itself.
        const double a = 2 * std::numbers::pi * (i + 0.07 * (i % 3)) / p.sides;
        if (u * std::cos(a) + v * std::sin(a) > 0.95 + 0.03 * (i % 2)) return false;
    }
    return u * u + v * v < 1.1;
}

inline Photo draw(const StonePicture& p) {
    Photo photo;
    photo.width = p.width;
    photo.height = p.height;
    photo.saturation = 1;
    const auto cells = cells_of(p);
    const double c = std::cos(p.turn), s = std::sin(p.turn), radius = p.diameter / 2;
    for (int y = 0; y < p.height; ++y) {
        for (int x = 0; x < p.width; ++x) {
            double sum[3] = {0, 0, 0}, covered = 0;
            for (int k = 0; k < p.samples * p.samples; ++k) {
                const double px = x + (k % p.samples + 0.5) / p.samples - 0.5 - p.centre_x;
                const double py = y + (k / p.samples + 0.5) / p.samples - 0.5 - p.centre_y;
                double u = (c * px + s * py) / radius;
                const double v = (-s * px + c * py) / radius;
                if (p.mirrored) u = -u;
                if (!inside_outline(p, u, v)) {
                    for (double& channel : sum) channel += p.ground;
                    continue;
                }
                ++covered;
                const Cell* nearest = &cells[0];
                double least = 1e9;
                for (const Cell& cell : cells) {
                    const double d = (cell.x - u) * (cell.x - u) + (cell.y - v) * (cell.y - v);
                    if (d < least) {
                        least = d;
                        nearest = &cell;
                    }
                }
                for (int i = 0; i < 3; ++i) sum[i] += nearest->colour[i];
            }
            const double n = p.samples * p.samples;
            for (int i = 0; i < 3; ++i) {
                const double value = std::min(1.0, p.gain[i] * sum[i] / n);
                photo.rgb.push_back(static_cast<float>(value));
            }
            if (p.with_coverage) photo.coverage.push_back(static_cast<float>(covered / n));
        }
    }
    return photo;
}

inline Photo flat(int width, int height, float value) {
    Photo photo;
    photo.width = width;
    photo.height = height;
    photo.saturation = 1;
    photo.rgb.assign(3 * static_cast<std::size_t>(width * height), value);
    return photo;
}

}  // namespace culet::synthetic
