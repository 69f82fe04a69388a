#pragma once
// The verdict of a comparison that is not calibrated: its deciding score beside the same render
// rotated.

#include "compare/scores/compare.h"

namespace culet {

/// Sets verdict and reason from the scores and their nulls.
void judge_by_rotations(Comparison& comparison);

}  // namespace culet
