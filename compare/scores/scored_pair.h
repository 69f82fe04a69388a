#pragma once
// The scores of a pair that is aligned already. Private to the room: shows OpenCV.

#include <optional>

#include "compare/scores/aligned_pair.h"
#include "compare/scores/compare.h"
#include "compare/scores/score_list.h"
#include "stone/progress/progress.h"

namespace culet {

/// For a calibration, whose render is as soft as the photograph.
struct CalibratedScoring {
    double render_blur_px = 0;              ///< that the pair's render was given
    std::optional<double> facet_error_deg;  ///< read from the facets' tilts
};

/// What the scores of a pair are read from: the part of it that they see.
struct MeasuredPair {
    /// `calibrated`: null, or what a calibration gives beside the pair.
    MeasuredPair(const AlignedPair& pair, const CalibratedScoring* calibrated);
    MeasuredPair(const MeasuredPair&) = delete;  // the measures point to the wavelets
    MeasuredPair& operator=(const MeasuredPair&) = delete;

    cv::Rect part;
    MatchedPictures pictures;
    WaveletBank wavelets;
    Measures measures;
};

/// Scores the pair, draws the null and judges. Throws Interrupted.
Comparison scored(const AlignedPair& pair, const Photo& photo, const Photo& render,
                  const CompareOptions& options, const Progress& progress,
                  const CalibratedScoring* calibrated = nullptr);

}  // namespace culet
