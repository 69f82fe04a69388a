#pragma once
// The early stages: penalty continuation by least squares (Levenberg 1944, Marquardt 1963) from a
// rough start. Incidences, exact readings and other readings begin soft and are tightened stage by
// stage, so that a bad start can be corrected. Hinges keep the stone convex on the way.

#include <string>
#include <vector>

#include "fit/solve/relaxation.h"
#include "fit/starts/starts.h"
#include "stone/progress/progress.h"

namespace culet {

/// A start after the first stages, which separate good starts from hopeless ones at part of the
/// cost.
struct Screened {
    std::string start;
    Shape shape;
    std::vector<int> sides;
    std::size_t stages = 0;     ///< completed
    double misfit = 0;          ///< the latest stage's merit without its priors
    bool is_plausible = false;  ///< the misfit is no larger than the true stone's
    int steps = 0;
    double work = 0;  ///< of its factorisations, in multiplications (estimate)
};
/// Throws Interrupted when progress says so.
Screened screen(Relaxation& relaxation, const Start& start, const Progress& progress = {});

struct Continued {
    Shape shape;
    int steps = 0;    ///< including the screening's
    double work = 0;  ///< of its own factorisations, in multiplications (estimate)
};

/// Runs the remaining stages. Throws Interrupted when progress says so.
Continued continue_penalties(Relaxation& relaxation, const Screened& rough,
                             const Progress& progress = {});

}  // namespace culet
