#pragma once
// What the tests of a stone's symmetry come to. Private to the room.

#include "fit/findings/findings.h"

namespace culet {

/// Sets `proposed`, `message` and `readings` by the tests of groups and tiers. `level`: of one
/// tier.
void conclude(SymmetryReport& report, double level);

}  // namespace culet
