#pragma once
// Table and crown of an upright stone by the edges of its surface.

#include <optional>
#include <vector>

#include "refine/spin/surface_edges.h"

namespace culet {

struct CrownFacet {
    Plane plane;
    double tilt_sigma = 0;           ///< radians
    std::vector<SurfaceEdge> edges;  ///< that bound it, and are across its azimuth
};

struct Crown {
    /// Its edge on each side that shows one, away from the axis.
    CrownFacet table;
    std::vector<CrownFacet> facets;      ///< further down, on each side from the table outwards
    std::vector<SurfaceEdge> outermost;  ///< the last edge of each such side
};

/// The sides of the stone to look at: directions in which its seen facets lie.
std::vector<SweptSide> sides_of(const Solid& upright, const std::vector<bool>& seen);

/// `edges`: of each side, the strongest first. `edge_sigma`: of an edge's radius and height.
/// Nothing if no four sides that surround the axis have an edge in one plane that is level within 6
/// degrees.
std::optional<Crown> crown_of(const std::vector<std::vector<SurfaceEdge>>& edges, double width,
                              double edge_sigma);

}  // namespace culet
