#pragma once
// The unknowns of a fit: every facet's plane, every meet as a point of its own, and a few numbers
// of symmetry readings. Planes and points are tied by the bilinear incidence normal . x = offset,
// which is far better conditioned than corners computed from planes alone. Inside the fit the stone
// is upright (up is +z), centred at the origin, and its half diameter is 1.

#include <array>
#include <vector>

#include "stone/solid/solid.h"

namespace culet {

/// One state of the unknowns.
struct Shape {
    std::vector<Vec3> normals;  ///< unit
    std::vector<double> offsets;
    std::vector<Vec3> points;
    std::vector<double> extras;  ///< centres of rotations, mirror planes, common parts of tiers
};

/// Index of each unknown in the vector of small steps: two tilts and a shift for each facet, three
/// coordinates for each point, then the extras.
struct Layout {
    int facets = 0, points = 0, extras = 0;

    int tilt(int facet) const { return 3 * facet; }
    int offset(int facet) const { return 3 * facet + 2; }
    int point(int p) const { return 3 * facets + 3 * p; }
    int extra(int e) const { return 3 * facets + 3 * points + e; }
    int size() const { return 3 * facets + 3 * points + extras; }
};

Layout layout_of(const Shape& shape);

/// Two unit directions that span the plane normal to `n`; smooth except at n.z = 0.
std::array<Vec3, 2> tangents(const Vec3& n);

}  // namespace culet
