#pragma once
// Checks readings before the fit: against their tier, the mesh, and what any stone can have. Finds
// slips of the pen without redundancy, before they bend the fit (docs/fitting.md, "Findings").

#include <string>
#include <vector>

#include "fit/findings/result.h"

namespace culet {

/// A reading that is far from similar ones.
struct Doubt {
    std::size_t reading = 0;  ///< index
    double expected = 0;      ///< in the reading's unit (radians, length, mm3, carat)
    double sigma = 0;         ///< of `expected`: how far correct readings may be off
    double strength = 0;      ///< how many of these sigmas the reading is off
    std::string slip;         ///< the slip that explains it, or empty
    double corrected = 0;     ///< with a slip: the value without it
    bool of_tier = false;     ///< all of its tier is doubted
    std::string what;  ///< one line for people, beginning with file and line; without the slip
};

/// Returns doubtful readings, the most certain first; those of one row of a file together.
/// `is_design`: the mesh has the design's proportions; one drawn by hand is trusted less.
std::vector<Doubt> first_check(const Stone& stone, const std::vector<Reading>& readings,
                               bool is_design);

/// Lists doubted readings as first suspects in the result of a fit without them. The status becomes
/// `contradictory` at best. Expected inclinations and their slips come from the fit.
void restore_doubted(const std::vector<Reading>& readings, std::vector<Doubt> doubts,
                     FitResult& result);

}  // namespace culet
