#pragma once
// Scores of an aligned pair. Private to the folder, because it exposes OpenCV.

#include <optional>

#include "compare/scores/aligned_pair.h"
#include "compare/scores/compare.h"
#include "compare/scores/score_list.h"
#include "stone/progress/progress.h"

namespace culet {

/// For a calibrated comparison, whose render is as soft as the photograph.
struct CalibratedScoring {
    double render_blur_px = 0;              ///< blur of the pair's render
    std::optional<double> facet_error_deg;  ///< estimated from the facets' tilts
};

/// The measures of the part of a pair that scores see.
struct MeasuredPair {
    /// `calibrated`: null, or the calibration's input.
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
