#pragma once
// A fit as it is asked for, and what one attempt at it came to. Private to the room.

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
    /// As far as one can tell before the fit, the readings leave nothing to a prior.
    bool read_in_full = true;
    bool mirrored = false;  ///< the mesh was mirrored to the azimuths
};

struct Attempt {
    FitResult result;
    double mesh_turn = 0;  ///< by how much the azimuths read are ahead of the mesh's; radians
    double work = 0;       ///< of all starts, about, in multiplications
};

/// Where what is wrong was found, the stone is soon found too: two starts, or one where those of
/// the first attempt were dear (a large stone, or readings of none).
Problem with_few_starts(Problem problem, const Attempt& first);

/// `left_out`: indices, sorted.
std::vector<Reading> without(const std::vector<Reading>& readings,
                             const std::vector<std::size_t>& left_out);

}  // namespace culet
