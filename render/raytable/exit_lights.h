#pragma once
// The light of a scene at exit events of a ray table, in single precision, many at once.

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "render/beams/beam_lights.h"
#include "render/optics/band.h"
#include "render/raytable/ray_table.h"

namespace culet {

/// Unpolarised lights of any type, at the nodes of one band. Points are relative to `middle`.
struct ExitLights {
    ExitLights(const Lights& lights, const WavelengthSet& colours, const Band& band,
               const Vec3& middle);
    /// Whether there are too many near lights for this; exit events are then shaded one by one.
    static bool too_many(const Lights& lights);

    /// A disc or ring in the sky, or half the sky. Edges are tested by the chord to the axis, which
    /// keeps its digits in single precision where the cosine of a small angle has none.
    struct Cap {
        float axis[3];
        /// Squared chords; light lies within `outer` and not within `inner`. Below 0: contains no
        /// direction; above 4: all.
        float outer, inner;
        std::vector<float> radiance;
    };
    ShadedLights others;  ///< lights that are neither caps nor the environment
    std::vector<Cap> caps;
    std::shared_ptr<const EnvironmentMap> environment;
    std::vector<float> red, blue;  ///< per node: what red and blue of a texel add to green
    int nodes = 1;
    bool any_near = false;
};

/// Consecutive exit events of a table; `weight` may differ from the table's.
struct ExitRun {
    const float* weight = nullptr;
    std::array<const std::int32_t*, 2> direction{};
    std::array<const std::uint16_t*, 2> point{};
    const std::uint16_t* facet = nullptr;
    std::array<const std::uint16_t*, 3> length{};  ///< null: nothing is absorbed
    int count = 0;
};
/// Frames of a table's facets: nine planes of `facets` numbers each.
struct ExitFrames {
    std::vector<float> numbers;
    int facets = 0;
};
/// Absorption per step of path length: [length][node].
using ExitAbsorption = std::array<std::vector<float>, 3>;

/// Writes the radiance that exit events bring, after absorption, to `radiance[node * stride +
/// exit]`. Returns the sum of their weights after absorption, averaged over nodes.
double shade_exits(const ExitLights& lights, const ExitFrames& frames, const ExitRun& run,
                   const ExitAbsorption& absorption, float* radiance, int stride);

/// Rays through the air, as planes: origins relative to the middle, unit directions.
struct AirRays {
    std::array<std::vector<float>, 3> origin, direction;
    int count = 0;
};
/// Distance to the nearest near light along each ray; a huge number if there is none.
void nearest_lights(const ExitLights& lights, const AirRays& rays, float* distance);
/// Writes the radiance along rays to `radiance[node * stride + ray]`.
void shade_rays(const ExitLights& lights, const AirRays& rays, float* radiance, int stride);

}  // namespace culet
