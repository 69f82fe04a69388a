#pragma once
// Fire: how far the colours of what a stone returns are apart.
//
// After gemstone-optimizer (J. Rembold, docs/SCIENCE.md): light of 450, 550 and 650 nm goes in
// together; of each sequence of facets that all three take and that returns all three to the
// viewer, the least of the three energies counts. Areas are the intersections of the three beams'
// regions.

#include <array>
#include <vector>

#include "render/grade/eye_light.h"

namespace culet {

/// Wavelengths of fire, nm: blue, green, red.
inline constexpr std::array<double, 3> k_fire_nm{450, 550, 650};
/// Red and blue count as seen apart from so much on, degrees.
inline constexpr double k_fire_apart_deg = 0.25;
/// A pupil of 3 mm seen from a stone 400 mm away, degrees.
inline constexpr double k_pupil_deg = 0.43;

/// Shares of the light that meets the stone.
struct Fire {
    double separated = 0;  ///< with at least `k_fire_apart_deg` between red and blue
    double matched = 0;    ///< of all sequences that the three colours take together
    /// Mean angle between red and blue over `matched`, radians.
    double spread = 0;
    /// Our own measure, without a threshold: each share times the part of its fan of colours, from
    /// red to blue, that a pupil leaves out: max(0, 1 - pupil / fan). 0: all is seen white.
    double spectral = 0;

    void add(const Fire& other, double factor);
};

/// Blue, green and red light of one view, with regions. `axis`: unit; `view_cone`: radians from
/// it. `crown`: by facet.
Fire fire_of(const std::array<EyeLight, 3>& colours, const std::vector<bool>& crown,
             const Vec3& axis, double view_cone);

}  // namespace culet
