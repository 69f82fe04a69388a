#pragma once
// The scores of a pair that is aligned already. Private to the room: shows OpenCV.

#include <optional>

#include "compare/scores/aligned_pair.h"
#include "compare/scores/compare.h"

namespace culet {

/// For a calibration, whose render is as soft as the photograph.
struct CalibratedScoring {
    double render_blur_px = 0;              ///< that the pair's render was given
    std::optional<double> facet_error_deg;  ///< read from the facets' tilts
};

/// As `compare` (compare.h), of what it aligned.
Comparison scored(const AlignedPair& pair, const Photo& photo, const Photo& render,
                  const CompareOptions& options, const Progress& progress,
                  const CalibratedScoring* calibrated = nullptr);

}  // namespace culet
