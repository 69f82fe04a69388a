#pragma once
// Types that the tracers of light paths share: limits, the path, and its exit.

#include <array>
#include <cstdint>

#include "render/optics/band.h"
#include "render/optics/eye_coherency.h"

namespace culet {

/// Objects that may stand between parts of a non-convex stone.
class Obstacles {
public:
    Obstacles() = default;
    Obstacles(const Obstacles&) = delete;
    Obstacles& operator=(const Obstacles&) = delete;
    virtual ~Obstacles() = default;
    /// Distance along the ray (unit direction) to the nearest object that hides what is behind it;
    /// infinite if there is none.
    virtual double nearest_distance(const Vec3& origin, const Vec3& direction) const = 0;
};

struct PathLimits {
    const Obstacles* obstacles = nullptr;  ///< null: none
    int depth = 64;                        ///< depth d has d - 1 inner segments
    double cut_weight = 0;  ///< paths below it are not followed; their weight counts as cut
    /// Crystals: below this weight one branch of a tree is followed, chosen by power, so the sum
    /// stays unbiased. 0: always both.
    double split_weight = 0;
    /// Most hits of one eye ray that split in two; later ones follow one branch as above. Without a
    /// limit a tree of depth d has 2^d paths.
    int most_splits = 1 << 14;
    /// Chosen branches below `cut_weight` play Russian roulette instead of being cut; unbiased.
    bool roulette = false;
    std::uint64_t seed = 0;  ///< of the random choices
    /// All wavelengths make the same choices, so that their pictures differ little otherwise.
    bool alike = false;
    bool polarised = true;  ///< false: every isotropic face uses the mean power of s and p
};

/// Variance of random choices. Each is estimated twice, independently and with half the weight; the
/// squared difference is an unbiased estimate of the variance of the sum. `seen`: the sum so far.
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

/// Facets hit by the eye ray. Tracing is depth-first, so one array serves; beyond `length` is an
/// earlier path.
struct PathTrace {
    static constexpr int k_longest = 1024;
    std::array<int, k_longest> facets{};
    /// Kind of the segment after each facet: 'i' isotropic; 'o', 'e', 's', 'f' a mode of a crystal;
    /// 'c' both modes, coherent; 'a' outside the stone, on the way to meet it again.
    std::array<char, k_longest> modes{};
    int length = 0;
};

/// An exit: light seen from `at` along `direction`, through two waves that vibrate along `u` and
/// `v`.
struct PathEnd {
    Vec3 at, direction, u, v;
    EyeCoherency coherency;
    NodeWeights transmitted{};  ///< after absorption, at each node
};

}  // namespace culet
