#pragma once
// What leaves of a ray table see of a scene's lights, in single precision and many at once.

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "render/beams/beam_lights.h"
#include "render/optics/band.h"
#include "render/raytable/ray_table.h"

namespace culet {

/// Lights of any type, none polarised, at the nodes of one band. Points are about `middle`.
struct ExitLights {
    ExitLights(const Lights& lights, const WavelengthSet& colours, const Band& band,
               const Vec3& middle);
    /// Whether these are too many for it: the surroundings are then asked leaf by leaf.
    static bool too_many(const Lights& lights);

    /// A disc or ring in the sky, or half of it: edges are found from the chord to the axis, which
    /// keeps its digits in single precision where the cosine of a small angle has none.
    struct Cap {
        float axis[3];
        /// Squared chords, of what is within the outer and not within the inner: below 0: nothing
        /// is within it; above 4: all directions are.
        float outer, inner;
        std::vector<float> radiance;
    };
    ShadedLights others;  ///< all but caps and the environment
    std::vector<Cap> caps;
    std::shared_ptr<const EnvironmentMap> environment;
    std::vector<float> red, blue;  ///< of each node: what red and blue of a texel add to green
    int nodes = 1;
    bool any_near = false;
};

/// Leaves that follow each other in a table; `weight` may be another than the table's.
struct ExitRun {
    const float* weight = nullptr;
    std::array<const std::int32_t*, 2> direction{};
    std::array<const std::uint16_t*, 2> point{};
    const std::uint16_t* facet = nullptr;
    std::array<const std::uint16_t*, 3> length{};  ///< none: nothing is absorbed
    int count = 0;
};
/// Frames of a table's facets: nine planes of as many numbers as there are facets.
struct ExitFrames {
    std::vector<float> numbers;
    int facets = 0;
};
/// Absorption per step of a leaf's lengths: [length][node].
using ExitAbsorption = std::array<std::vector<float>, 3>;

/// Radiance that leaves bring, to `radiance[node * stride + leaf]`; what is absorbed on the way is
/// left out. Returns the sum over leaves of their weight after absorption, mean over nodes.
double shade_leaves(const ExitLights& lights, const ExitFrames& frames, const ExitRun& run,
                    const ExitAbsorption& absorption, float* radiance, int stride);

/// Rays through the air: origins about the middle, unit directions, as planes.
struct AirRays {
    std::array<std::vector<float>, 3> origin, direction;
    int count = 0;
};
/// How far along them the nearest near light is; beyond all lengths where there is none.
void nearest_lights(const ExitLights& lights, const AirRays& rays, float* distance);
/// Radiance along them, to `radiance[node * stride + ray]`.
void shade_rays(const ExitLights& lights, const AirRays& rays, float* radiance, int stride);

}  // namespace culet
