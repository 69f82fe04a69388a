#pragma once
// Where a point of an edge goes when the two facets that meet there change a little.

#include <array>

#include "compare/pose/wireframe.h"

namespace culet {

/// A facet's plane is n . x = d about its middle m: n + a u + b v with u, v unit and normal to n,
/// lifted by c at m. {a, b, c}; a and b are small angles.
using FacetChange = std::array<double, 3>;

/// A facet's plane and the directions that its change is told in.
struct FacetFrame {
    Vec3 normal, across, along;
    Vec3 middle;
};
FacetFrame frame_of(const WireSolid& wire, int facet);

/// The point of both changed planes that is nearest to `x`, which is on both as they were.
struct MovedEdge {
    Vec3 at;
    std::array<Vec3, 6> slopes;  ///< by the changes of the left facet, then of the right one
};
MovedEdge moved_edge(const FacetFrame& left, const FacetFrame& right, const Vec3& x,
                     const double* left_change, const double* right_change);

}  // namespace culet
