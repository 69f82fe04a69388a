#pragma once
// One pixel of the reference renderer: eye rays, their light paths, and sums over them.

#include <array>
#include <functional>
#include <vector>

#include "render/geometry/stone_body.h"
#include "render/reference/prepared_scene.h"
#include "render/reference/sampling.h"

namespace culet {

/// A pixel's statistics. Weights are means over its samples and wavelengths.
struct PixelSums {
    double hit = 0;  ///< part of the samples that hit the stone
    /// Part of the samples in the means below: those that hit the stone, or with objects, all.
    double counted = 0;
    double luminance = 0;  ///< from these samples, relative to the whole pixel
    double remainder = 0, absorbed = 0, cut = 0;
    double variance = 0;  ///< of the luminance, from paths chosen at random
    double radiance = 0;  ///< of pixels that contain the stone, mean of R, G and B
    /// Half the difference of R, G and B between the means of two halves of the rays; estimates the
    /// error from having few rays.
    double halves_apart = 0;
    double worst_imbalance = 0;
    int deepest = 0;  ///< faces on the longest path that exits
    long long rays = 0, sampled = 0;
    long long events = 0;  ///< faces hit by light

    PixelSums& operator+=(const PixelSums& more);
};

/// A thread's buffers and guesses from the last ray, kept from pixel to pixel.
struct PixelMemory {
    std::vector<double> stone, behind;
    EntryGuess entry;
    PathTrace trace;
    /// Asked before each ray, because a pixel may take seconds. False: skip the rest.
    std::function<bool()> goes_on = {};
};

class PixelShader {
public:
    /// Keeps a reference to `prepared`, which must not change; its limits are copied.
    PixelShader(const Scene& scene, const PreparedScene& prepared, int samples);

    /// Planes in `stokes`: 1 (S0 only), or 4 if the setup needs all Stokes parameters.
    int planes() const { return setup_.stokes ? 4 : 1; }

    /// Writes means over the square of side `size` pixels with corner (x, y) to `stokes[plane *
    /// nodes + node]`. `pixel`: its number, for the seed. `memory`: new or from this shader; it
    /// changes no result.
    PixelSums shade(double x, double y, double size, std::uint64_t pixel, double* stokes,
                    PixelMemory& memory) const;

private:
    void assign_bands_to_rays(int turns);
    void background(const EyeRay& ray, double* stokes) const;
    // Adds light through the stone to `seen`, per value: in one band, and in all of sample `i`.
    void trace_band(const Band& band, const EyeRay& ray, const BodyHit& entry,
                    const PathLimits& limits, double part, double* seen, PixelSums& sums,
                    PixelMemory& memory) const;
    void trace_sample(std::size_t i, const EyeRay& ray, const BodyHit& entry, std::uint64_t pixel,
                      double* seen, PixelSums& sums, PixelMemory& memory) const;
    // Means over the samples, from the sums of both halves.
    void add_up(const PixelMemory& memory, PixelSums& sums, double* stokes) const;

    bool has_objects_, has_stone_, covers_objects_;
    StoneBody body_;
    EyeRays eyes_;
    const OpticalSetup& setup_;
    const Surroundings& surroundings_;
    PathLimits limits_;
    std::vector<SamplePoint> pattern_;
    double share_;                                // of a sample in the pixel
    std::vector<std::size_t> half_;               // of each sample: 0 or 1
    bool halved_ = false;                         // every band is in both halves
    std::array<std::vector<double>, 2> of_half_;  // weight of a ray in its half's mean, per value
    std::array<double, 2> behind_half_{};
    int nodes_;
    std::vector<Rgb> rgb_;           // colour of S[plane] at each node, behind the eye's optics
    std::vector<double> luminance_;  // the same, as luminance
    // Bands take turns: ray i carries band b if turn_[i] = b mod turns_. A band's few rays get the
    // weight `band_factor_`.
    int turns_ = 1;
    std::vector<int> turn_;
    std::vector<double> band_factor_;
    std::vector<double> factor_, stone_luminance_;  // per value of the Stokes parameters
    std::vector<double> usual_;                     // mean radiance of the surroundings at each
                                                    // node
};

}  // namespace culet
