#pragma once
// An uneven sky: GemRay's showcase light, with random numbers of our own (its own are those of the
// C library, and differ from machine to machine).

#include <array>
#include <cstdint>
#include <vector>

#include "stone/solid/solid.h"

namespace culet {

/// 17 x 17 patches over the x and y of a direction, from 0.2 up, interpolated bilinearly, brighter
/// for higher indices; and 20 round spots of 2.56 degrees' radius, 15 bright. Nothing straight up,
/// where the viewer is, and nothing from below.
class RandomSky {
public:
    RandomSky(std::uint64_t seed, double n);
    /// `direction`: unit; z to the eye, x to its right, y up.
    double radiance(const Vec3& direction) const;

private:
    static constexpr int k_patches = 17, k_spots = 20;
    std::array<std::array<double, k_patches>, k_patches> patches_{};
    std::vector<Vec3> spots_;
};

}  // namespace culet
