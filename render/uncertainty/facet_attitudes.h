#pragma once
// A stone's facets as inclination, azimuth and distance from its middle, which can be changed
// separately. Inclinations and azimuths are about +z.

#include <optional>
#include <vector>

#include "stone/solid/solid.h"

namespace culet {

/// Sine of the inclination below which a facet is level: rounding would determine its azimuth.
constexpr double k_level_sine = 1e-9;

struct FacetAttitude {
    double inclination = 0,
           azimuth = 0;  ///< radians; inclination from +z, or from -z if `side` is -1
    double side = 1;     ///< -1: faces down
    double offset = 0;   ///< distance from the middle
};

/// Mean of the corners, the origin of offsets.
Vec3 mean_corner(const Solid& solid);

/// In the solid's order.
std::vector<FacetAttitude> attitudes_of(const Solid& solid, const Vec3& middle);

/// The stone that the facets bound, named as in `named`; nothing if they bound none. Redundant
/// facets are left out.
std::optional<Solid> stone_of(const Solid& named, const std::vector<FacetAttitude>& attitudes,
                              const Vec3& middle);

}  // namespace culet
