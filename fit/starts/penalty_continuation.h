#pragma once
// The early stages: penalty continuation by least squares (Levenberg 1944, Marquardt 1963) from a
// rough start. Incidences, exact readings and the readings themselves begin soft and are tightened
// stage by stage, so that a bad start can still change its mind; hinges keep the stone convex on
// the way.

#include <string>
#include <vector>

#include "fit/solve/relaxation.h"
#include "fit/starts/starts.h"
#include "stone/progress/progress.h"

namespace culet {

/// After the first stages, which tell good starts from hopeless ones at a part of the cost.
struct Screened {
    std::string start;  ///< its name
    Shape shape;
    std::vector<int> sides;     ///< of the start
    std::size_t stages = 0;     ///< that it has gone through
    double misfit = 0;          ///< what is left of the latest stage's merit, but for its priors
    bool is_plausible = false;  ///< no more than the true stone would leave
    int steps = 0;
    double work = 0;  ///< multiplications of its factorisations, about
};
/// Throws Interrupted when progress says so.
Screened screen(Relaxation& relaxation, const Start& start, const Progress& progress = {});

struct Continued {
    Shape shape;
    int steps = 0;    ///< of the screening, too
    double work = 0;  ///< multiplications of its own factorisations, about
};

/// The stages that follow. Throws Interrupted when progress says so.
Continued continue_penalties(Relaxation& relaxation, const Screened& rough,
                             const Progress& progress = {});

}  // namespace culet
