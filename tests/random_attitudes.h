#pragma once
// Random directions, frames and numbers from a fixed seed.

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

#include "stone/solid/solid.h"

namespace culet {

class RandomAttitudes {
public:
    explicit RandomAttitudes(unsigned seed) : engine_(seed) {}
    double between(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(engine_);
    }
    int one_of(int count) { return std::uniform_int_distribution<int>(0, count - 1)(engine_); }
    Vec3 direction() {
        const double z = between(-1, 1), azimuth = between(0, 2 * std::numbers::pi);
        const double r = std::sqrt(1 - z * z);
        return {r * std::cos(azimuth), r * std::sin(azimuth), z};
    }
    std::array<Vec3, 3> frame() {
        const Vec3 a = direction(), b = across(a, 1);
        return {a, b, glm::cross(a, b)};
    }
    /// A vector of the given length normal to the unit vector n. Redraws near n, where the cross
    /// product loses digits: an error of 1e-14 in the right angle moves a wave by as much.
    Vec3 across(const Vec3& n, double length) {
        Vec3 v = glm::cross(n, direction());
        while (glm::length(v) < 0.1) v = glm::cross(n, direction());
        return length * glm::normalize(v);
    }

private:
    std::mt19937_64 engine_;
};

}  // namespace culet
