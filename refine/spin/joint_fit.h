#pragma once
// All that is known of a stone in one least squares: outlines, edges of its surface, the ground,
// and how alike the facets are that its cut repeats.

#include <optional>
#include <vector>

#include "refine/spin/repeated_facets.h"
#include "refine/spin/standing_stone.h"

namespace culet {

/// What tells the stone of a series, or of half of its frames.
struct SeriesEvidence {
    std::vector<const LevelPicture*> pictures;
    std::vector<PicturePoints> outlines;  ///< by picture
    ExpectedSeries expected;
    /// By how much errors of whole sides make the sigmas of the outlines' points larger.
    double sigmas_times = 1;
    /// Below the turntable's origin: the ground on which the stone lies.
    std::optional<double> ground_depth;
    CutSymmetry symmetry;
};

/// How the stone repeats its facets; only for stones that do.
struct FoundSymmetry {
    int pairs = 0;  ///< as in RepeatedFacets
    double tilt_sigma = 0, offset_sigma = 0;
};

struct JointStone {
    StandingStone stone;
    /// The same stone as it lies on the turntable, with camera and turns.
    TurningFit fit;
    /// Not if too few facets repeat, or if the outlines then contradict the stone more.
    std::optional<FoundSymmetry> symmetry;
};

/// `fit`: of the outlines alone.
JointStone joint_stone(TurningFit fit, const SeriesEvidence& evidence);

}  // namespace culet
