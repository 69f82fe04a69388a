#pragma once
// What has to be done to a problem before it can be fitted, and taken back in its result. Private
// to the room.

#include <functional>
#include <vector>

#include "fit/hypotheses/problem.h"

namespace culet {

struct Prepared {
    Problem problem;
    /// Applied to a result in this order: the result of the problem as it was given.
    std::vector<std::function<void(FitResult&)>> restored;
};

/// Leaves out azimuths of level facets, which mean nothing, and gives the stone the mesh's size
/// when no length was read.
Prepared prepared(Problem problem);

}  // namespace culet
