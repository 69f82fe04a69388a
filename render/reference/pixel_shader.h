#pragma once
// One pixel of the reference renderer: eye rays, their light paths, and the sums over them.

#include <array>
#include <functional>
#include <vector>

#include "render/geometry/stone_body.h"
#include "render/reference/prepared_scene.h"
#include "render/reference/sampling.h"

namespace culet {

/// What is known of a pixel beside its light. Weights are means over its samples and wavelengths.
struct PixelSums {
    double hit = 0;  ///< share of samples that meet the stone
    /// Share of samples that the means below are about: those, or where things stand around the
    /// stone, all.
    double counted = 0;
    double luminance = 0;  ///< that these bring, as a share of the pixel
    double remainder = 0, absorbed = 0, cut = 0;
    double variance = 0;  ///< of the luminance, from paths chosen at random
    double radiance = 0;  ///< of the pixel where the stone is in it, mean of R, G and B
    /// Half the difference of R, G and B in the mean between every other ray and the rest: about as
    /// large as what the mean of all is off by for being of so few rays.
    double halves_apart = 0;
    double worst_imbalance = 0;
    int deepest = 0;  ///< faces on the longest path that brought light
    long long rays = 0, sampled = 0;
    long long events = 0;  ///< faces that light met on its ways

    PixelSums& operator+=(const PixelSums& more);
};

/// What one thread keeps from pixel to pixel: room, and what the last ray met.
struct PixelMemory {
    std::vector<double> stone, behind;
    EntryGuess entry;
    PathTrace trace;
    /// Asked before each ray, since a pixel may take seconds; false: the rest is left out.
    std::function<bool()> goes_on = {};
};

class PixelShader {
public:
    /// `prepared` must outlive it, and stay as it is; but for its limits, which are copied.
    PixelShader(const Scene& scene, const PreparedScene& prepared, int samples);

    /// Stokes parameters in `stokes`: 1 (S0 only) or, when the plan asks for them, 4.
    int planes() const { return setup_.stokes ? 4 : 1; }

    /// Means over the pixel whose corner is (x, y) and whose side is `size` pixels, to
    /// `stokes[plane * nodes + node]`. `pixel`: its number, for the seed.
    /// `memory`: of this shader or new; it changes no result.
    PixelSums shade(double x, double y, double size, std::uint64_t pixel, double* stokes,
                    PixelMemory& memory) const;

private:
    void take_turns(int turns);
    void background(const EyeRay& ray, double* stokes) const;

    bool has_objects_, has_stone_, covers_objects_;
    StoneBody body_;
    EyeRays eyes_;
    const OpticalSetup& setup_;
    const Surroundings& surroundings_;
    PathLimits limits_;
    std::vector<SamplePoint> pattern_;
    std::vector<std::size_t> half_;               // of the samples, 0 or 1
    bool halved_ = false;                         // every band is in both
    std::array<std::vector<double>, 2> of_half_;  // weight of a ray in the half's mean, by value
    std::array<double, 2> behind_half_{};
    int nodes_;
    std::vector<Rgb> rgb_;           // of S[plane] at each node, as seen behind the eye's optics
    std::vector<double> luminance_;  // likewise
    // Rays and bands take turns: ray i carries band b where turn_[i] = b mod turns_. A band's few
    // rays count `band_factor_` times.
    int turns_ = 1;
    std::vector<int> turn_;
    std::vector<double> band_factor_;
    std::vector<double> factor_, stone_luminance_;  // of each value of the Stokes parameters
    std::vector<double> usual_;                     // mean radiance of the lights at each node
};

}  // namespace culet
