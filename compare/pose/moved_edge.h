#pragma once
// How a point of an edge moves when its two facets change a little.

#include <array>

#include "compare/pose/wireframe.h"

namespace culet {

/// {a, b, c}. The facet's plane n . x = d about its middle m gets the normal n + a u + b v, with u,
/// v unit and normal to n, and is raised by c at m; a and b are small angles.
using FacetChange = std::array<double, 3>;

/// A facet's plane and the axes of its FacetChange.
struct FacetFrame {
    Vec3 normal, across, along;
    Vec3 middle;
};
FacetFrame frame_of(const WireSolid& wire, int facet);

/// The point on both changed planes nearest to `x`, a point on both unchanged planes.
struct MovedEdge {
    Vec3 at;
    std::array<Vec3, 6> slopes;  ///< derivatives by the left facet's changes, then the right one's
};
MovedEdge moved_edge(const FacetFrame& left, const FacetFrame& right, const Vec3& x,
                     const double* left_change, const double* right_change);

}  // namespace culet
