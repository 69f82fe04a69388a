#pragma once
// What the tracers of light paths share: limits, the way gone, and its end.

#include <array>
#include <cstdint>

#include "render/optics/band.h"
#include "render/optics/eye_coherency.h"

namespace culet {

/// What may stand between a stone that is not convex and itself.
class Obstacles {
public:
    Obstacles() = default;
    Obstacles(const Obstacles&) = delete;
    Obstacles& operator=(const Obstacles&) = delete;
    virtual ~Obstacles() = default;
    /// How far along the ray (unit direction) the nearest thing is that hides what lies behind it.
    /// Infinite when there is none.
    virtual double nearest_distance(const Vec3& origin, const Vec3& direction) const = 0;
};

struct PathLimits {
    const Obstacles* obstacles = nullptr;  ///< none: nothing
    int depth = 64;                        ///< depth d has d - 1 inner segments
    double cut_weight = 0;  ///< a path of less weight is not followed; its weight is counted as cut
    /// Trees that double (crystals): below this weight one branch is followed, chosen with the
    /// probability of its power, so that the sum stays unbiased (0: both always).
    double split_weight = 0;
    /// So many hits of one eye ray at most split in two; after them every path follows one branch
    /// as above. Without it a tree of depth d has 2^d paths.
    int most_splits = 1 << 14;
    /// Chosen branches below `cut_weight` play Russian roulette instead of being cut: the sum stays
    /// unbiased.
    bool roulette = false;
    std::uint64_t seed = 0;  ///< of those choices
    /// Every wavelength makes the same choices, so that pictures at different wavelengths differ by
    /// little else.
    bool alike = false;
    bool polarised = true;  ///< false: mean powers of s and p at every isotropic face
};

/// Variance of what is chosen at random. Every choice is estimated twice, independently and with
/// half the weight: the squared difference of the two is an unbiased estimate of the variance of
/// their sum. `seen`: the sum that is estimated, so far.
class PairedEstimates {
public:
    void begin(double seen) { start_ = seen; }
    void end(bool second, double seen) {
        const double brought = seen - start_;
        if (second) variance_ += (first_ - brought) * (first_ - brought);
        first_ = brought;
    }
    double variance() const { return variance_; }

private:
    double start_ = 0, first_ = 0, variance_ = 0;
};

/// What the eye ray met on the way, by facet; depth-first, so one array serves. Beyond `length` is
/// what was met before.
struct PathTrace {
    static constexpr int k_longest = 1024;
    std::array<int, k_longest> facets{};
    /// Of the segment behind each facet: 'i' isotropic; 'o', 'e', 's', 'f' a mode of a crystal; 'c'
    /// both modes, coherent; 'a' outside the stone, on the way to meet it again.
    std::array<char, k_longest> modes{};
    int length = 0;
};

/// A path that ends outside: light seen along `direction` from `at`, through two waves that vibrate
/// along `u` and `v`.
struct PathEnd {
    Vec3 at, direction, u, v;
    EyeCoherency coherency;
    NodeWeights transmitted{};  ///< by absorption, at each node
};

}  // namespace culet
