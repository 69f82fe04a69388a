#pragma once
// Completes a stone of outlines with the table and the crown that no outline shows.

#include <optional>
#include <vector>

#include "stone/solid/solid.h"

namespace culet {

struct SweptFrame;

struct CrownedStone {
    Solid solid;                      ///< the table is named T, the crown's facets C1, C2, ...
    std::vector<double> tilt_sigmas;  ///< by facet
    std::vector<int> unseen;          ///< facets that neither outlines nor edges show
    /// Of the table between the two opposite sides nearest to x, as a part of the stone's width
    /// there; 0: no such pair shows it.
    double table_part = 0, table_part_sigma = 0;
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
