#pragma once
// Computes how certain a pose is, and whether it may be used.

#include "compare/pose/pose_candidates.h"

namespace culet {

/// Sets the sigmas, and the facet errors that the edges show.
void describe_sigmas(const PoseTask& task, const Candidate& won, FoundPose& pose);

/// Sets the photograph's edge at every wireframe point, and the medians of their distances.
void describe_marks(const Candidate& won, FoundPose& pose);

/// Sets `doubt`; says in `trouble` which limit is exceeded and in `remedy` what to do. `rival`: the
/// lead over the next other view (infinite: there is none); `rival_turn`: the angle to it, radians.
void judge(const PoseTask& task, const Candidate& won, double rival, double rival_turn,
           FoundPose& pose);

}  // namespace culet
