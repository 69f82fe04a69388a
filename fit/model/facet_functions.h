#pragma once
// A facet's inclination, azimuth and distance from the middle, linearised in the unknowns. Private
// to the room: shows Eigen.

#include <array>

#include "fit/model/linear.h"
#include "fit/model/shape.h"

namespace culet {

/// Inclination and azimuth in radians, offset in half diameters from `middle`. The azimuth of a
/// level facet is undefined: its row is zero.
std::array<FunctionRow, 3> facet_functions(const Shape& shape, int f, const Layout& layout,
                                           const Vec3& middle);

/// The mean of the points.
Vec3 middle_of(const Shape& shape);

}  // namespace culet
