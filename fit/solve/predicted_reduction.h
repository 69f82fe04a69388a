#pragma once
// What a step is to leave of a linearisation's sum of squares, by the equations as they were
// linearised. Where the shape that it leads to leaves as much, the equations are as straight as
// they were taken for, and next to nothing is left for another step. Private to the room.

#include "fit/solve/kkt_solver.h"
#include "fit/solve/relaxation.h"

namespace culet {

/// `step`: solved from the linearisation. `bends`: the curvature that it was factored with.
double predicted_merit(const StepLinearisation& linearisation, const KktSolver::Solution& step,
                       const std::vector<SymmetricEntry>& bends = {});

}  // namespace culet
