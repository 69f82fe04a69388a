#pragma once
// Fire: the separation of colours in the light that a stone returns.
//
// After gemstone-optimizer (J. Rembold, docs/SCIENCE.md): light of 450, 550 and 650 nm enters
// together. For each sequence of facets along which all three return to the viewer, the least of
// the three energies counts. Areas are the intersections of the three beams' regions.

#include <array>
#include <vector>

#include "render/grade/eye_light.h"

namespace culet {

/// Wavelengths of fire, nm: blue, green, red.
inline constexpr std::array<double, 3> k_fire_nm{450, 550, 650};
/// Angle between red and blue from which they count as separated, degrees.
inline constexpr double k_fire_apart_deg = 0.25;
/// Angle of a 3 mm pupil seen from a stone 400 mm away, degrees.
inline constexpr double k_pupil_deg = 0.43;

/// Parts of the light that hits the stone.
struct Fire {
    double separated = 0;  ///< with at least `k_fire_apart_deg` between red and blue
    double matched = 0;    ///< of all sequences that the three colours share
    /// Mean angle between red and blue over `matched`, radians.
    double spread = 0;
    /// culet's own measure, without a threshold: each part times the fraction of its fan of
    /// colours, red to blue, outside a pupil: max(0, 1 - pupil / fan). 0: all light looks white.
    double spectral = 0;

    void add(const Fire& other, double factor);
};

/// `colours`: blue, green and red light of one view, with regions. `axis`: unit; `view_cone`:
/// radians from it. `crown`: per facet.
Fire fire_of(const std::array<EyeLight, 3>& colours, const std::vector<bool>& crown,
             const Vec3& axis, double view_cone);

}  // namespace culet
