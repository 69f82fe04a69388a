#pragma once
// Stones that are hard on geometry, from a few numbers; and the same stone moved, turned, scaled.

#include <vector>

#include "stone/solid/solid.h"
#include "stone/text/toml_file.h"

namespace culet::hard {

/// A [stone] table: `shape` and its own parameters, then `scale`, `shift` and `turn` (a seed).
/// Shapes:
///   twins      a cube whose top is two facets that differ by `angle_deg`
///   nick       a cube with an edge and a corner cut off, leaving facets of `size` of the diameter
///   culet      a cone of `facets` that meet in one point, those of `parted` moved in by `miss` of
///              the diameter, below a girdle of height `girdle`; `culet` is the width of the facet
///              that takes the point away, 0: it just touches
///   sphere     `facets` planes round a sphere, evenly spread
///   box        edges 1, 1, `aspect`
///   bipyramid  two cones of `facets`, base to base, `girdle` apart
///   random     `facets` random planes round a sphere, from `seed`
///   cut        of the catalogue: `cut` by name, in mm; `tilt_deg` turns one facet, `facet`
std::vector<NamedPlane> hard_planes(const TomlTable& stone);
/// The solid of these planes. `contract`: joins near meets, as a fraction of the diameter.
Solid hard_solid(const TomlTable& stone);

/// A random rotation by a quaternion, or a mirror image.
struct Turn {
    Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
    Vec3 operator()(const Vec3& v) const { return v.x * x + v.y * y + v.z * z; }
};
Turn random_turn(unsigned seed);
Plane turned(const Plane& plane, const Turn& turn);
Solid turned(Solid solid, const Turn& turn);
Solid scaled(Solid solid, double factor);

/// Changes the value by one unit in the last place up, down or not at all; 0 stays.
double nudged(double value, unsigned& state);
Vec3 nudged(const Vec3& value, unsigned& state);

}  // namespace culet::hard
