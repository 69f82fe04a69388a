#pragma once
// The early stages: graded least squares (Levenberg 1944, Marquardt 1963) from a rough start.
// Incidences, exact readings and the readings themselves begin soft and are tightened stage by
// stage, so that a bad start can still change its mind; hinges keep the stone convex on the way.

#include "fit/relaxation.h"
#include "fit/starts.h"
#include "stone/progress.h"

namespace culet {

struct Graded {
    Shape shape;
    bool convex = false;  ///< no corner stands above a neighbour facet
    int steps = 0;
};

/// Throws Interrupted when progress says so.
Graded graded_fit(Relaxation& relaxation, const Start& start, const Progress& progress = {});

}  // namespace culet
