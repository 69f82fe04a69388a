#include "compare/calibration/picture_comparison.h"

#include "compare/calibration/within_readings.h"
#include "compare/scores/scored_pair.h"
#include "stone/text/errors.h"

namespace culet {

Comparison compare(const Photo& photo, const Photo& render, const CompareOptions& options,
                   const Progress& progress) {
    const AlignedPair pair = aligned(photo, render);
    if (progress && !progress(0.1)) throw Interrupted();
    Comparison result = scored(pair, photo, render, options, progress);
    result.within = within_readings(pair, photo, render);
    return result;
}

}  // namespace culet
