#include "render/beams/environment_pyramid.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
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
    std::vector<double> finer_weights;
    for (std::size_t l = 0; l < levels_.size(); ++l) {
        const Level& level = levels_[l];
        const int side = level.side;
        const auto at = [](const Level& of, int x, int y) {
            return of.start +
                   static_cast<std::size_t>(y + 1) * static_cast<std::size_t>(of.side + 2) +
                   static_cast<std::size_t>(x + 1);
        };
        std::vector<double> weights(static_cast<std::size_t>(side) *
                                    static_cast<std::size_t>(side));
        tbb::parallel_for(0, side, [&](int y) {
            if (goes_on && !goes_on()) return;
            for (int x = 0; x < side; ++x) {
                double sum = 0;
                std::array<double, 3> rgb{};
                if (l == 0) {
                    const double step = 2.0 / (side * subsamples);
                    for (int i = 0; i < subsamples * subsamples; ++i) {
                        double weight = 0;
                        const Vec3 direction = direction_at(
                            -1 + step * (subsamples * x + i % subsamples + 0.5),
                            -1 + step * (subsamples * y + i / subsamples + 0.5), weight);
                        const Rgb seen = map.at(direction);
                        for (std::size_t c = 0; c < 3; ++c) rgb[c] += weight * seen[c];
                        sum += weight;
                    }
                } else {
                    const Level& finer = levels_[l - 1];
                    for (int i = 0; i < 4; ++i) {
                        const int fx = 2 * x + i % 2, fy = 2 * y + i / 2;
                        const double weight = finer_weights[static_cast<std::size_t>(fy) *
                                                                static_cast<std::size_t>(2 * side) +
                                                            static_cast<std::size_t>(fx)];
                        for (std::size_t c = 0; c < 3; ++c)
                            rgb[c] += weight * static_cast<double>(planes_[c][at(finer, fx, fy)]);
                        sum += weight;
                    }
                }
                for (std::size_t c = 0; c < 3; ++c)
                    planes_[c][at(level, x, y)] = static_cast<float>(rgb[c] / sum);
                weights[static_cast<std::size_t>(y) * static_cast<std::size_t>(side) +
                        static_cast<std::size_t>(x)] = sum;
            }
        });
        finer_weights = std::move(weights);
        // The border continues over the square's edges, which are folded at their middles.
        for (auto& plane : planes_) {
            for (int i = 0; i < side; ++i) {
                plane[at(level, i, -1)] = plane[at(level, side - 1 - i, 0)];
                plane[at(level, i, side)] = plane[at(level, side - 1 - i, side - 1)];
                plane[at(level, -1, i)] = plane[at(level, 0, side - 1 - i)];
                plane[at(level, side, i)] = plane[at(level, side - 1, side - 1 - i)];
            }
            plane[at(level, -1, -1)] = plane[at(level, side - 1, side - 1)];
            plane[at(level, side, -1)] = plane[at(level, 0, side - 1)];
            plane[at(level, -1, side)] = plane[at(level, side - 1, 0)];
            plane[at(level, side, side)] = plane[at(level, 0, 0)];
        }
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
