#pragma once
// The stone of a spin series: upright, and completed by what outlines do not show.

#include <optional>
#include <string>
#include <vector>

#include "compare/turntable/edge_points.h"
#include "fit/silhouettes/turning_fit.h"
#include "refine/spin/crowned_stone.h"
#include "refine/spin/stone_attitude.h"

namespace culet {

/// The facet that lies on the ground, and how well its tilt is known: as halves of a real series
/// differ.
inline constexpr const char* k_ground_name = "G";
inline constexpr double k_ground_tilt = 9e-4;
inline constexpr const char* k_table_name = "T";

/// An edge of the surface, in the turntable's frame.
struct PlacedEdge {
    Vec3 place{0, 0, 0}, along{1, 0, 0};
    std::vector<std::string> facets;  ///< one or two that it bounds
};

struct StandingStone {
    Solid solid;
    std::vector<double> tilt_sigmas;  ///< by facet, radians
    std::vector<bool> seen;           ///< by facet: its tilt is better known than a guess
    std::vector<bool> is_copy;        ///< by facet: taken from where the cut repeats it
    StoneAttitude at;                 ///< its axes in the turntable's frame
    /// Edges of the surface that tell table and crown; 0: none, outlines alone tell the stone.
    int edges = 0;
    double edge_sigma = 0;  ///< pixels
    std::vector<PlacedEdge> placed_edges;

    Vec3 on_turntable(const Vec3& v) const { return v.x * at.x + v.y * at.y + v.z * at.z; }
};

/// By facet: its tilt is better known than a guess.
std::vector<bool> seen_facets(const TurningFit& fit);

/// The ground bounds the stone, since it lies on it: a plane `depth` below the frame's origin.
/// Facets there that nothing shows are the ground's.
void lay_on_ground(TurningFit& fit, double depth);

/// `pictures`: of the fit's turns.
StandingStone standing_stone(const TurningFit& fit,
                             const std::vector<const LevelPicture*>& pictures);

}  // namespace culet
