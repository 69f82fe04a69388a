#pragma once
// Readings held against what needs no fit: the other readings of their tier, the mesh, and what a
// stone can have at all. A slip of the pen is found so with no redundancy at all, before it bends
// the fit. docs/fitting.md, "Findings", has the method.

#include <string>
#include <vector>

#include "fit/findings/result.h"

namespace culet {

/// A reading that is far off what its like say.
struct Doubt {
    std::size_t reading = 0;  ///< index
    double expected = 0;      ///< in the reading's unit (radians, length, mm3, carat)
    double sigma = 0;         ///< of what was expected: how far honest readings are off
    double strength = 0;      ///< by how many of these sigmas the reading is off
    std::string slip;         ///< that explains it, or empty
    double corrected = 0;     ///< with a slip: the value without it
    bool of_tier = false;     ///< with all of its tier
    std::string what;         ///< one line for people, file and line first; without the slip
};

/// The readings that cannot be right, the surest first. Readings of one row of a file stand or fall
/// together. `is_design`: the mesh has the proportions that the stone was cut after; else it was
/// drawn by hand, and is trusted for less.
std::vector<Doubt> first_check(const Stone& stone, const std::vector<Reading>& readings,
                               bool is_design);

/// Lists the doubted readings in a result of a fit without them, as its first suspects; the status
/// is `contradictory` at best. What an inclination should be, and by which slip it became what was
/// written, is what the fit says.
void restore_doubted(const std::vector<Reading>& readings, std::vector<Doubt> doubts,
                     FitResult& result);

}  // namespace culet
