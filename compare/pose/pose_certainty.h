#pragma once
// How sure a pose is, and whether it may be used.

#include "compare/pose/pose_candidates.h"

namespace culet {

/// Sigmas, and the facet errors that the edges show.
void describe_sigmas(const PoseTask& task, const Candidate& won, FoundPose& pose);

/// The photograph's edge at every point of the wireframe, and the medians of their distances.
void describe_marks(const Candidate& won, FoundPose& pose);

/// Says in `trouble` which of the limits is passed. `rival`: the lead over the next other view.
void judge(const PoseTask& task, const Candidate& won, double rival, FoundPose& pose);

}  // namespace culet
