#pragma once
// The edges between facets and air that a camera sees of a convex stone: its outline, and the edges
// between two facets that it sees.

#include <vector>

#include "compare/pose/stone_view.h"
#include "stone/solid/half_edges.h"

namespace culet {

/// A convex solid made ready for being looked at many times.
struct WireSolid {
    explicit WireSolid(const Solid& solid_);
    Solid solid;
    std::vector<Edge> edges;
    std::vector<Vec3> facet_middles;  ///< of the facets' areas
    Vec3 middle{0};
    double diameter = 0;
};

/// 1 for each facet that is turned to the eye, else 0.
std::vector<char> facets_seen(const WireSolid& wire, const StoneView& view);

struct WireEdge {
    int edge = -1;  ///< of WireSolid::edges
    PicturePoint from, to;
    bool outline = false;  ///< one of its facets is turned away
};

std::vector<WireEdge> visible_edges(const WireSolid& wire, const StoneView& view);

/// A point of a visible edge.
struct WirePoint {
    int edge = -1;
    bool outline = false;
    Vec3 on_stone{0};
    PicturePoint at;
    double normal_x = 0, normal_y = 0;  ///< unit; of the outline: away from the stone
    /// What facets that are off by the expected error move the edge here: one sigma, pixels.
    double facet_sigma = 0;
    /// Distance along the normal to the next edge of the wireframe; the search's reach when there
    /// is none within it. Two edges this near are seen as one.
    double gap = 0;
};

struct WireSpacing {
    double step = 2;                ///< between points of an edge, pixels
    double trim = 2.5;              ///< of an edge's ends: there other edges begin
    double facet_error = 0;         ///< expected, angle to the true facet
    double facet_offset = 0;        ///< and distance of its plane from the facet's middle
    double most_facet_sigma = 1e9;  ///< points of edges less certain are left out, pixels
    double reach = 6;               ///< how far `gap` looks
};

std::vector<WirePoint> points_along(const WireSolid& wire, const StoneView& view,
                                    const WireSpacing& spacing);

/// What is expected of facets' offsets at first, when only their tilts are known: facets that are
/// tilted about some point of the stone move at their middles by the tilt times some sixth of the
/// diameter.
double expected_offset(const WireSolid& wire, double facet_error);

}  // namespace culet
