#pragma once
// An uneven sky: GemRay's showcase light, with reproducible random numbers (GemRay's are those of
// the C library, which differ between machines).

#include <array>
#include <cstdint>
#include <vector>

#include "stone/solid/solid.h"

namespace culet {

/// 17 x 17 patches over the x and y of a direction, from 0.2 up, bilinear, brighter for higher
/// indices; and 20 round spots of radius 2.56 degrees and radiance 15. Dark straight up, where the
/// viewer is, and below.
class RandomSky {
public:
    RandomSky(std::uint64_t seed, double n);
    /// `direction`: unit; z towards the eye, x to its right, y up.
    double radiance(const Vec3& direction) const;

private:
    static constexpr int k_patches = 17, k_spots = 20;
    std::array<std::array<double, k_patches>, k_patches> patches_{};
    std::vector<Vec3> spots_;
};

}  // namespace culet
