#pragma once
// A stone between two changes of its topology. Private to the room.

#include <string>
#include <vector>

#include "fit/readings/measurement.h"
#include "stone/stone.h"

namespace culet {

/// The stone as it is now, and the original readings that still apply.
struct TopologyStage {
    Stone stone;
    std::vector<Reading> readings;
    std::vector<int> origin;  ///< index among the original readings; -1: added later
};

/// Replaces the stage's solid if the changed one may be fitted; keeps the readings that still
/// apply, and adds to `changes` what is gone. Returns whether it did.
bool change_solid(TopologyStage& stage, Solid solid, std::vector<std::string>& changes);

/// A reading that releases the meet of these facets.
Reading released_meet(const TopologyStage& stage, const std::vector<std::string>& names,
                      int number);

/// All facets round the corner that these facets share.
std::vector<std::string> corner_of(const Solid& solid, const std::vector<std::string>& names);

/// The names, separated by commas.
std::string list_of(const std::vector<std::string>& names);

}  // namespace culet
