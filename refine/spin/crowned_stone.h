#pragma once
// Completes a stone of outlines with the table and the crown that no outline shows.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "refine/spin/surface_edge.h"
#include "stone/solid/solid.h"

namespace culet {

struct SweptFrame;

struct CrownedStone {
    Solid solid;                      ///< the table is named T, the crown's facets C1, C2, ...
    std::vector<double> tilt_sigmas;  ///< by facet
    std::vector<int> unseen;          ///< facets that neither outlines nor edges show
    std::map<std::string, std::vector<SurfaceEdge>> edges_of;  ///< by facet: edges that bound it
    double table_tilt = 0;  ///< of the table's normal from z, radians
    double edge_sigma = 0;  ///< of an edge's radius and height, as halves of the frames differ
    int edges = 0;          ///< that were used
};

/// `solid`: upright, its facets of which outlines tell the tilt are `seen`. Nothing if no table is
/// found.
std::optional<CrownedStone> crowned(const Solid& solid, const std::vector<bool>& seen,
                                    const std::vector<double>& tilt_sigmas,
                                    const std::vector<SweptFrame>& frames);

}  // namespace culet
