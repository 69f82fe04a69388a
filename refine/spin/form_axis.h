#pragma once
// The axis about which a stone's facets repeat. Private to the folder.

#include <vector>

#include "refine/spin/repeated_facets.h"

namespace culet {

/// A turn about the axis, after a mirroring of azimuth a to 2 `mirror` - a.
struct FormMotion {
    double turn = 0;
    bool mirrored = false;
};
/// Of the symmetry, the identity first.
std::vector<FormMotion> motions_of(const CutSymmetry& symmetry);

struct FormAxis {
    double tilt_x = 0, tilt_y = 0;  ///< its direction is that of (tilt_x, tilt_y, 1)
    double x = 0, y = 0;            ///< where it crosses z = 0
    double mirror = 0;              ///< azimuth of a mirror, radians
};

/// Where the motion takes the plane.
Plane moved(const FormAxis& axis, const FormMotion& motion, const Plane& plane);

/// The shown plane nearest to a direction, -1: none within `within` (radians).
int plane_towards(const std::vector<Plane>& planes, const Vec3& normal, double within);

/// That most planes agree on: least squares of pairs with Cauchy's loss. `areas`: by plane.
/// `width`: of the stone.
FormAxis axis_of(const std::vector<Plane>& planes, const std::vector<double>& areas,
                 const CutSymmetry& symmetry, const Vec3& middle, double width);

}  // namespace culet
