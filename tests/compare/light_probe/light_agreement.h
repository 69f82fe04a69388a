#pragma once
// The error of a light map against the panorama that it was reconstructed from.

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>
#include <vector>

#include "compare/pose/stone_view.h"
#include "render/colour/colour.h"
#include "render/scene/environment_layout.h"
#include "tests/compare/light_probe/simulated_ball.h"

namespace culet::simulated {

struct Agreement {
    double mean_stops = 0, worst_percent_stops = 0, energy_ratio = 0;
};

inline double angle_apart(const glm::dmat3& a, const glm::dmat3& b) {
    return angle_of(glm::transpose(a) * b);
}

// Weighted by solid angle: luminance against the panorama's mean over each texel.
inline Agreement agreement_of(const EnvironmentMap& map, const Panorama& panorama, int parts = 3) {
    std::vector<std::pair<double, double>> errors;
    double sum = 0, total = 0, found = 0, truth = 0;
    for (int y = 0; y < map.height; ++y) {
        const double omega = lat_long_solid_angle(y, map.width, map.height);
        for (int x = 0; x < map.width; ++x) {
            Rgb mean{};
            for (int k = 0; k < parts * parts; ++k) {
                const Rgb light = panorama(lat_long_direction(x + (k % parts + 0.5) / parts,
                                                              y + (k / parts + 0.5) / parts,
                                                              map.width, map.height));
                for (std::size_t c = 0; c < 3; ++c) mean[c] += light[c] / (parts * parts);
            }
            const double a = luminance(&map.rgb[3 * (static_cast<std::size_t>(y) * map.width + x)]);
            const double b = luminance(mean), stops = std::abs(std::log2((a + 1e-6) / (b + 1e-6)));
            found += omega * a;
            truth += omega * b;
            sum += omega * stops;
            total += omega;
            errors.emplace_back(stops, omega);
        }
    }
    std::sort(errors.rbegin(), errors.rend());
    Agreement result{sum / total, 0, found / truth};
    double covered = 0;
    for (const auto& [stops, omega] : errors) {
        covered += omega;
        result.worst_percent_stops = stops;
        if (covered > 0.01 * total) break;
    }
    return result;
}

}  // namespace culet::simulated
