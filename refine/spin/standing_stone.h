#pragma once
// The stone of a spin series: upright, and completed by what outlines do not show.

#include <optional>
#include <vector>

#include "compare/turntable/edge_points.h"
#include "fit/silhouettes/turning_fit.h"
#include "refine/spin/crowned_stone.h"
#include "refine/spin/half_turn.h"
#include "refine/spin/stone_attitude.h"

namespace culet {

struct StandingStone {
    Solid solid;
    std::vector<double> tilt_sigmas;  ///< by facet, radians
    std::vector<bool> seen;           ///< by facet: its tilt is better known than a guess
    /// The same stone, what no frame shows taken from half a turn about z away.
    std::optional<HalfTurned> completed;
    StoneAttitude at;  ///< its axes in the turntable's frame
    /// What edges of the surface told; without them, outlines alone tell the stone.
    std::optional<CrownedStone> crowned;

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
