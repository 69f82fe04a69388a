#pragma once
// What the tracers of light paths share: wavelengths that go together, limits, and the way gone.

#include <array>
#include <cstdint>

#include "render/crystal.h"

namespace culet {

/// Most wavelengths that share one band; longer sets are split.
constexpr int k_band_nodes = 32;
using NodeWeights = std::array<double, k_band_nodes>;

/// Wavelength nodes that share one geometry, and the optics of the stone for them.
struct Band {
    int first = 0, count = 1;  ///< of the wavelength set
    double n = 1.5;            ///< of an isotropic stone, or the mean where the split is left out
    bool two_waves = false;    ///< the stone splits light: `crystal`
    Crystal crystal;
    double n_outside = 1;
    bool absorbs = false;
    /// Per unit of length, by principal axis of the crystal. All equal for isotropic absorption.
    std::array<NodeWeights, 3> absorption{};
    /// Vacuum wavelength in the stone's unit of length.
    double wavelength = 589.3e-6;
    /// Retardation, in the stone's unit of length, from which the two waves of a crystal are
    /// followed apart: wavelength^2 / bandwidth. 0: always; infinite: monochromatic light.
    double coherence_length = 0;
};

struct PathLimits {
    int depth = 64;         ///< depth d has d - 1 inner segments
    double cut_weight = 0;  ///< a path of less weight is not followed; its weight is counted as cut
    /// Trees that double (crystals): below this weight one branch is followed, chosen with the
    /// probability of its power, so that the sum stays unbiased (0: both always).
    double split_weight = 0;
    /// So many hits of one eye ray at most split in two; after them every path follows one branch
    /// as above. Without it a tree of depth d has 2^d paths.
    int most_splits = 1 << 14;
    /// Chosen branches below `cut_weight` play Russian roulette instead of being cut: the sum stays
    /// unbiased, and `cut` then counts the difference, of mean 0.
    bool roulette = false;
    std::uint64_t seed = 0;  ///< of those choices
    bool polarised = true;   ///< false: mean powers of s and p at every isotropic face
};

/// What the eye ray met on the way, by facet; depth-first, so one array serves.
struct PathTrace {
    static constexpr int k_longest = 1024;
    std::array<short, k_longest> facets{};
    /// Of the segment behind each facet: 'i' isotropic; 'o', 'e', 's', 'f' a mode of a crystal; 'c'
    /// both modes, coherent; 'a' outside the stone, on the way to meet it again.
    std::array<char, k_longest> modes{};
    int length = 0;
};

}  // namespace culet
