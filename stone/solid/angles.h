#pragma once
// The direction in which a facet faces.

#include "stone/solid/solid.h"

namespace culet {

/// Inclination of a facet against an up direction, radians: 0 (table or culet) .. pi/2 (girdle).
double inclination(const Vec3& normal, const Vec3& up);

/// Azimuth of a normal about +z, radians in [0, 2 pi), counter-clockwise from +x seen from above.
double azimuth(const Vec3& normal);

}  // namespace culet
