#pragma once
// How far a stone of a spin series is from the one that was drawn.

#include "tests/refine/spin_frames.h"

namespace culet::bench {

struct SpinError {
    int facets = 0, found = 0;             ///< of 1 mm2 and more, if the stone is 7 mm wide
    int within = 0;                        ///< of those found: error below the result's own sigma
    double tilt_rms = 0, tilt_median = 0;  ///< of those found, radians
    double table = -1;                     ///< of the table's normal, radians; below 0: no table
    double table_part = 0, true_table_part = 0;
    double turn_rms = 0;  ///< radians, the mean taken off
};

/// A found facet, not `unseen`, is the partner of at most one true one, within 3 degrees, the
/// nearest first.
SpinError error_of(const SpinResult& found, const synthetic::SpinTruth& truth);

}  // namespace culet::bench
