#pragma once
// Matches a stone's bright reflexes: how many of the photo's are in the render, and how near.

#include <opencv2/core/types.hpp>
#include <optional>
#include <vector>

#include "compare/scores/metrics.h"

namespace culet {

struct MatchedReflex {
    cv::Point2d middle;
    double area = 0;   ///< pixels
    int partner = -1;  ///< index in the other picture's list; -1: none
};

struct ReflexMatch {
    std::vector<MatchedReflex> photo, render;
    int in_photo = 0, in_render = 0, matched = 0;
    double f1 = 0;       ///< 2 matched / (in_photo + in_render)
    double area_f1 = 0;  ///< the same, weighted by the reflexes' areas
    /// Median, in diameters.
    std::optional<double> displacement;
    /// `coloured`: matched reflexes with a CIELAB chroma over 10 in the photo. `same_hue`: those
    /// with a hue within 30 degrees in the render and a chroma of at least 10. `hue_agreement`:
    /// their share, nothing when none is coloured. It shows dispersion, which hardly moves other
    /// scores. The limits are proposals.
    int coloured = 0, same_hue = 0;
    std::optional<double> hue_agreement;
};

/// Light is clipped at white and blurred by 0.3 % of the diameter. A reflex is a connected region
/// brighter than 90 % of the photo's compared pixels, of at least (0.7 % of the diameter) squared.
/// Reflexes match when their middles are within 2 % of the diameter and their areas within a factor
/// of three; nearest pairs first, each once. The photo's level is used for both, so a render with
/// too little light has too few. Nothing when the photo has none.
std::optional<ReflexMatch> match_reflexes(const MatchedPictures& pictures);

}  // namespace culet
