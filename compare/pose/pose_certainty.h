#pragma once
// A pose's certainty, and whether it may be used.

#include "compare/pose/pose_candidates.h"

namespace culet {

void describe_sigmas(const PoseTask& task, const Candidate& won, FoundPose& pose);

/// Sets the edge marks, and their median distances.
void describe_marks(const Candidate& won, FoundPose& pose);

/// Sets `error_probability`; says in `trouble` which limit is exceeded and in `remedy` what to do.
/// `rival`: the lead over the next other view (infinite: there is none); `rival_turn`: the angle to
/// it, radians.
void assess(const PoseTask& task, const Candidate& won, double rival, double rival_turn,
            FoundPose& pose);

}  // namespace culet
