#pragma once
// Changes that a problem needs before its fit, and that its result must undo. Private to the room.

#include <functional>
#include <vector>

#include "fit/hypotheses/problem.h"

namespace culet {

struct Prepared {
    Problem problem;
    /// To be applied in this order; gives the result of the problem as given.
    std::vector<std::function<void(FitResult&)>> restored;
};

/// Leaves out azimuths of level facets, and takes the size from the mesh if no length was read.
Prepared prepared(Problem problem);

}  // namespace culet
