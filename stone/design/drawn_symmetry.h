#pragma once
// The symmetry of a drawing about up, and by how much the drawing misses it.

#include <vector>

#include "stone/solid/axis_groups.h"
#include "stone/solid/solid.h"

namespace culet {

struct DrawnSymmetry {
    AxisGroup group;  ///< trivial where the drawing has none or is not closed
    AxisGroup near;   ///< the largest that it comes near to; one facet cut askew does not change it
    double scatter = 0;  ///< one sigma of a corner's coordinate against the symmetric form, in the
                         ///< solid's unit; at least what the last digit of designs leaves open

    /// One sigma of a facet's drawn inclination, radians: that of a plane through corners with
    /// errors of `scatter`.
    double tilt_sigma(const Solid& solid, int facet, const Vec3& up) const;
};

/// The largest group of turns about `up` and mirrorings through it that
/// - maps facets so that neighbours stay neighbours (stone/solid/automorphisms.h) and keeps facet
///   `table` (-1: none),
/// - moves corners near to corners: within 5 % of the half diameter, or within the corners'
///   distance from their own facets' planes,
/// - fits no worse than its subgroups: an F-test at the 0.01 % level (Bonferroni) of how far the
///   facets of its orbits differ beyond those of each subgroup. So an oval does not pass for a
///   round stone, whatever its facets' neighbours are.
DrawnSymmetry drawn_symmetry(const Solid& solid, const Vec3& up, int table);

}  // namespace culet
