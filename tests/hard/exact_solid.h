#pragma once
// Checks the solid of planes given in doubles, in 100 digits.

#include <span>

#include "stone/solid/solid.h"

namespace culet::hard {

struct ExactJudgement {
    /// Exact meets of the facets at a corner that lie outside some half-space, or do not exist. A
    /// closed surface without any is the boundary of the half-spaces' intersection.
    int misplaced = 0;
    double vertex_error = 0;  ///< largest distance of a corner from its exact meet, a length
    double volume = 0;        ///< exact, rounded
    double volume_error = 0;  ///< of culet::volume, relative
    /// Relative change of the volume per relative change of the planes' numbers: surface times
    /// distance from the origin over volume.
    double volume_condition = 0;
};
/// `planes`: all given planes. The solid's facets must carry their planes.
ExactJudgement judge_solid(std::span<const NamedPlane> planes, const Solid& solid);

}  // namespace culet::hard
