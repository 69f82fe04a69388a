#pragma once
// The symmetry about up that a drawing has, and by how much it misses it: a drawing by hand has its
// symmetry only about as exactly as its lines are drawn.

#include <vector>

#include "stone/solid/axis_groups.h"
#include "stone/solid/solid.h"

namespace culet {

struct DrawnSymmetry {
    AxisGroup group;  ///< trivial where the drawing has none, or is not closed
    AxisGroup near;   ///< the largest that it comes near to: one facet cut askew leaves it
    double scatter =
        0;  ///< of a corner beside where the symmetric form has it, each coordinate, in
            ///< the solid's unit; at least what the last digit of designs leaves open

    /// Standard deviation of a facet's drawn inclination about that of its orbit, radians: of a
    /// plane through corners that are off by `scatter`.
    double tilt_sigma(const Solid& solid, int facet, const Vec3& up) const;
};

/// The largest group of turns about `up` and mirrorings through it
/// - which exchanges the facets as they meet (stone/solid/automorphisms.h) and leaves facet `table`
/// (-1:
///   none) in its place,
/// - which the corners come near to: within 5 % of the half diameter, or as near as they come to
///   their own facets' planes,
/// - and which loses nothing against its subgroups: an F-test of what the facets of its orbits
///   differ by, beyond those of each subgroup's, at the 0.01 % level (Bonferroni). So an oval is
///   not taken for a round stone, however alike its facets meet.
DrawnSymmetry drawn_symmetry(const Solid& solid, const Vec3& up, int table);

}  // namespace culet
