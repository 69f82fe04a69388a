#pragma once
// The verdict of an uncalibrated comparison: the deciding score against the rotated render.

#include "compare/scores/compare.h"

namespace culet {

/// Sets verdict and reason from the scores and their nulls.
void judge_by_rotations(Comparison& comparison);

}  // namespace culet
