#pragma once
// How sure a pose is, and whether it may be used.

#include "compare/pose/pose_candidates.h"

namespace culet {

/// Sigmas, and the facet errors that the edges show.
void describe_sigmas(const PoseTask& task, const Candidate& won, FoundPose& pose);

/// The photograph's edge at every point of the wireframe, and the medians of their distances.
void describe_marks(const Candidate& won, FoundPose& pose);

/// Sets `doubt`, and says in `trouble` which of the limits is passed and in `remedy` what to do
/// about it. `rival`: the lead over the next other view (infinite: there is none), `rival_turn`:
/// where it is, radians from this one.
void judge(const PoseTask& task, const Candidate& won, double rival, double rival_turn,
           FoundPose& pose);

}  // namespace culet
