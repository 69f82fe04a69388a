#pragma once
// Random numbers that, unlike those of the standard's distributions, are the same on every machine.

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <random>

#include "stone/solid/solid.h"

namespace culet {

class Chance {
public:
    explicit Chance(std::uint64_t seed) : bits_(seed) {}
    /// 0 <= u < 1, 53 bits.
    double uniform() { return static_cast<double>(bits_() >> 11) * 0x1.0p-53; }
    double uniform(double low, double high) { return low + (high - low) * uniform(); }
    /// Mean 0, standard deviation 1 (Box and Muller 1958).
    double normal();
    Vec3 direction();

private:
    std::mt19937_64 bits_;
};

/// Unrelated seeds for many draws (splitmix64, Steele et al. 2014).
std::uint64_t seed_of(std::uint64_t seed, std::uint64_t group, std::uint64_t draw);

/// By `angle` (radians) about a unit axis, counter-clockwise when it points to the viewer.
glm::dmat3 rotation_about(const Vec3& axis, double angle);

}  // namespace culet
