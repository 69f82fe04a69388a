#pragma once
// A stone's facets by inclination, azimuth and distance from its middle, which can be changed
// apart. Inclinations and azimuths are about +z.

#include <optional>
#include <vector>

#include "stone/solid/solid.h"

namespace culet {

/// Below this sine of its inclination a facet is level and has no azimuth: rounding decides it.
constexpr double k_level_sine = 1e-9;

struct FacetAttitude {
    double inclination = 0,
           azimuth = 0;  ///< radians; inclination from +z, or from -z if `side` is -1
    double side = 1;     ///< -1: looks down
    double offset = 0;   ///< distance from the middle
};

/// Mean of the corners, which offsets count from.
Vec3 mean_corner(const Solid& solid);

/// In the solid's order.
std::vector<FacetAttitude> attitudes_of(const Solid& solid, const Vec3& middle);

/// The stone that facets of these attitudes bound, with the names of `named`; nothing where they
/// bound none. A facet that the others leave no room is not there.
std::optional<Solid> stone_of(const Solid& named, const std::vector<FacetAttitude>& attitudes,
                              const Vec3& middle);

}  // namespace culet
