#pragma once
// A stone between two changes of its topology. Private to the room.

#include <string>
#include <vector>

#include "fit/readings/measurement.h"
#include "stone/stone.h"

namespace culet {

struct TopologyStage {
    Stone stone;
    std::vector<Reading> readings;
    std::vector<int> origin;  ///< index among the original readings; -1: added later
};

/// Replaces the stage's solid, unless it cannot be fitted (returns false). Keeps the readings that
/// still apply, and adds to `changes` what is gone.
bool change_solid(TopologyStage& stage, Solid solid, std::vector<std::string>& changes);

/// A reading that releases the meet of these facets.
Reading released_meet(const TopologyStage& stage, const std::vector<std::string>& names,
                      int number);

/// All facets round the corner that these facets share.
std::vector<std::string> corner_of(const Solid& solid, const std::vector<std::string>& names);

}  // namespace culet
