#pragma once
// A fit as it is asked for, and one attempt at it. Private to the room.

#include <cstddef>
#include <vector>

#include "fit/findings/result.h"
#include "fit/model/options.h"
#include "fit/readings/measurement.h"
#include "stone/stone.h"

namespace culet {

struct Problem {
    Stone stone;
    std::vector<Reading> readings;
    FitOptions options;
    /// Before the fit, the readings seem to leave nothing to a prior.
    bool read_in_full = true;
    bool mirrored = false;  ///< the mesh was mirrored to match the azimuths
};

struct Attempt {
    FitResult result;
    double mesh_turn = 0;  ///< how far the azimuths read are ahead of the mesh's; radians
    double work = 0;       ///< of all starts, roughly, in multiplications
};

/// A corrected problem needs few starts: two, or one if those of the first attempt were costly (a
/// large stone, or readings that fit none).
Problem with_few_starts(Problem problem, const Attempt& first);

/// `left_out`: indices, sorted.
std::vector<Reading> without(const std::vector<Reading>& readings,
                             const std::vector<std::size_t>& left_out);

}  // namespace culet
