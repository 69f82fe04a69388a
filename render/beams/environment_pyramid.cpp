#include "render/beams/environment_pyramid.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <mutex>
#include <numbers>
#include <utility>

namespace culet {

namespace {

// Texels as large as the map's would blur it, so the finest level has texels of half that size, up
// to this side.
constexpr int k_finest = 2048;

// Unit direction at (u, v) in -1..1, and the solid angle per area of the square there.
Vec3 direction_at(double u, double v, double& solid_angle) {
    Vec3 p{u, v, 1 - std::abs(u) - std::abs(v)};
    if (p.z < 0) {
        p.x = (1 - std::abs(v)) * (u < 0 ? -1 : 1);
        p.y = (1 - std::abs(u)) * (v < 0 ? -1 : 1);
    }
    const double length = glm::length(p);
    solid_angle = 1 / (length * length * length);
    return p / length;
}

// Red, green and blue times weights, and the weights.
using WeightedSum = glm::dvec4;

// Of `subsamples`^2 directions in a texel of the finest level.
WeightedSum sum_of_map(const EnvironmentMap& map, int side, int subsamples, int x, int y) {
    WeightedSum sum(0);
    const double step = 2.0 / (side * subsamples);
    for (int i = 0; i < subsamples * subsamples; ++i) {
        double weight = 0;
        const Vec3 direction =
            direction_at(-1 + step * (subsamples * x + i % subsamples + 0.5),
                         -1 + step * (subsamples * y + i / subsamples + 0.5), weight);
        const Rgb seen = map.at(direction);
        sum += weight * WeightedSum(seen[0], seen[1], seen[2], 1);
    }
    return sum;
}

std::size_t index_in(int side, int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(side) +
           static_cast<std::size_t>(x);
}

}  // namespace

EnvironmentPyramid::EnvironmentPyramid(const EnvironmentMap& map,
                                       const std::function<bool()>& goes_on) {
    // The square is as wide as a great circle of directions: twice the map's height.
    const int wanted = static_cast<int>(std::bit_ceil(4 * static_cast<unsigned>(map.height)));
    const int finest = std::min(k_finest, wanted);
    // Average subsamples if texels are coarser, so that no texel of the map is lost.
    const int subsamples = wanted > finest ? 2 * wanted / finest : 1;
    std::size_t start = 0;
    for (int side = finest; side >= 1; side /= 2) {
        // At the horizon's corners a texel is sqrt(3) times as long as at the zenith.
        levels_.push_back({side, start, static_cast<float>(2 * std::numbers::sqrt3 / side)});
        start += static_cast<std::size_t>(side + 2) * static_cast<std::size_t>(side + 2);
    }
    for (auto& plane : planes_) plane.assign(start, 0.0f);
    std::vector<double> weights = fill(levels_[0], goes_on, [&](int x, int y) {
        return sum_of_map(map, finest, subsamples, x, y);
    });
    for (std::size_t l = 1; l < levels_.size(); ++l) {
        const Level& finer = levels_[l - 1];
        weights = fill(levels_[l], goes_on, [&](int x, int y) {
            WeightedSum sum(0);
            for (int i = 0; i < 4; ++i) {
                const int fx = 2 * x + i % 2, fy = 2 * y + i / 2;
                const std::size_t at = finer.at(fx, fy);
                sum += weights[index_in(finer.side, fx, fy)] *
                       WeightedSum(planes_[0][at], planes_[1][at], planes_[2][at], 1);
            }
            return sum;
        });
    }
}

// Sets the texels to means; returns the weights of their sums.
template <class SumOf>
std::vector<double> EnvironmentPyramid::fill(const Level& level,
                                             const std::function<bool()>& goes_on,
                                             const SumOf& sum_of) {
    std::vector<double> weights(index_in(level.side, 0, level.side));
    tbb::parallel_for(0, level.side, [&](int y) {
        if (goes_on && !goes_on()) return;
        for (int x = 0; x < level.side; ++x) {
            const WeightedSum sum = sum_of(x, y);
            for (int c = 0; c < 3; ++c)
                planes_[c][level.at(x, y)] = static_cast<float>(sum[c] / sum.w);
            weights[index_in(level.side, x, y)] = sum.w;
        }
    });
    continue_over_edges(level);
    return weights;
}

// The border continues over the square's edges, which are folded at their middles.
void EnvironmentPyramid::continue_over_edges(const Level& level) {
    const int side = level.side;
    for (auto& plane : planes_) {
        for (int i = 0; i < side; ++i) {
            plane[level.at(i, -1)] = plane[level.at(side - 1 - i, 0)];
            plane[level.at(i, side)] = plane[level.at(side - 1 - i, side - 1)];
            plane[level.at(-1, i)] = plane[level.at(0, side - 1 - i)];
            plane[level.at(side, i)] = plane[level.at(side - 1, side - 1 - i)];
        }
        plane[level.at(-1, -1)] = plane[level.at(side - 1, side - 1)];
        plane[level.at(side, -1)] = plane[level.at(0, side - 1)];
        plane[level.at(-1, side)] = plane[level.at(side - 1, 0)];
        plane[level.at(side, side)] = plane[level.at(0, 0)];
    }
}

std::shared_ptr<const EnvironmentPyramid> pyramid_of(
    const std::shared_ptr<const EnvironmentMap>& map, const std::function<bool()>& goes_on) {
    static std::mutex mutex;
    static std::vector<
        std::pair<std::weak_ptr<const EnvironmentMap>, std::shared_ptr<const EnvironmentPyramid>>>
        made;
    {
        const std::lock_guard<std::mutex> lock(mutex);
        std::erase_if(made, [](const auto& of) { return of.first.expired(); });
        for (const auto& [of, pyramid] : made) {
            if (of.lock() == map) return pyramid;
        }
    }
    auto pyramid = std::make_shared<const EnvironmentPyramid>(*map, goes_on);
    const std::lock_guard<std::mutex> lock(mutex);
    if (!goes_on || goes_on()) made.emplace_back(map, pyramid);
    return pyramid;
}

}  // namespace culet
