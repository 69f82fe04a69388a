#pragma once
// A stone on its way to another topology. Private to the room.

#include <string>
#include <vector>

#include "fit/readings/measurement.h"
#include "stone/stone.h"

namespace culet {

/// The stone as it is now, and which of the first readings still apply.
struct TopologyStage {
    Stone stone;
    std::vector<Reading> readings;
    std::vector<int> origin;  ///< index among the first readings; -1: added on the way
};

/// Whether the changed solid may be fitted; then it becomes the stage's, with the readings that
/// still apply, and `changes` says what went.
bool change_solid(TopologyStage& stage, Solid solid, std::vector<std::string>& changes);

/// A reading by which the meet of these facets comes apart.
Reading released_meet(const TopologyStage& stage, const std::vector<std::string>& names,
                      int number);

/// All facets round the corner that these share.
std::vector<std::string> corner_of(const Solid& solid, const std::vector<std::string>& names);

/// The names, with commas.
std::string list_of(const std::vector<std::string>& names);

}  // namespace culet
