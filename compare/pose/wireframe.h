#pragma once
// The edges between facets and air that a camera sees of a convex stone: its outline, and the edges
// between two visible facets.

#include <vector>

#include "compare/pose/stone_view.h"
#include "stone/solid/half_edges.h"

namespace culet {

/// A convex solid, prepared for projections.
struct WireSolid {
    explicit WireSolid(const Solid& solid_);
    Solid solid;
    std::vector<Edge> edges;
    std::vector<Vec3> facet_middles;  ///< centroids of the facets' areas
    Vec3 middle{0};
    double diameter = 0;
};

/// 1 for each facet that faces the eye, else 0.
std::vector<char> facets_seen(const WireSolid& wire, const StoneView& view);

struct WireEdge {
    int edge = -1;  ///< of WireSolid::edges
    PicturePoint from, to;
    bool outline = false;  ///< one of its facets is a back-face
};

std::vector<WireEdge> visible_edges(const WireSolid& wire, const StoneView& view);

struct WirePoint {
    int edge = -1;
    bool outline = false;
    Vec3 on_stone{0};
    PicturePoint at;
    double normal_x = 0, normal_y = 0;  ///< unit; on the outline: away from the stone
    /// Sigma of the edge's place here from expected facet errors, pixels.
    double facet_sigma = 0;
    /// Distance along the normal to the next wireframe edge, at most the search's reach. Edges this
    /// near look like one.
    double gap = 0;
};

struct WireSpacing {
    double step = 2;                ///< between points of an edge, pixels
    double trim = 2.5;              ///< cut off at an edge's ends, where other edges begin, pixels
    double facet_error = 0;         ///< expected, angle to the true facet
    double facet_offset = 0;        ///< expected, distance of its plane from the facet's middle
    double most_facet_sigma = 1e9;  ///< points with a larger facet_sigma are left out, pixels
    double reach = 6;               ///< range in which `gap` is searched, pixels
};

std::vector<WirePoint> points_along(const WireSolid& wire, const StoneView& view,
                                    const WireSpacing& spacing);

/// Initial prior of the facets' offsets, from their tilts: facets tilted about some point of the
/// stone move at their middles by the tilt times about a sixth of the diameter.
double expected_offset(const WireSolid& wire, double facet_error);

}  // namespace culet
