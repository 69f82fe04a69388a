#pragma once
// The bright reflexes of a stone as things: how many of the photo's are in the render, and where.

#include <opencv2/core/types.hpp>
#include <optional>
#include <vector>

#include "compare/scores/metrics.h"

namespace culet {

struct Reflex {
    cv::Point2d middle;
    double area = 0;   ///< pixels
    int partner = -1;  ///< index among the other picture's reflexes; -1: none there
};

struct ReflexMatch {
    std::vector<Reflex> photo, render;
    int in_photo = 0, in_render = 0, matched = 0;
    double f1 = 0;       ///< 2 matched / (in_photo + in_render)
    double area_f1 = 0;  ///< the same, each reflex counting with its area
    /// Median distance between the middles of matched reflexes, in diameters; nothing matched:
    /// none.
    std::optional<double> displacement;
    /// Matched reflexes whose mean colour in the photo has a CIELAB chroma over 10, how many of
    /// them have a hue within 30 degrees of it in the render (where a chroma below 10 is none), and
    /// the share of these. Nothing where none is coloured. Sees dispersion, which hardly moves any
    /// other score; the limits are proposals.
    int coloured = 0, same_hue = 0;
    std::optional<double> hue_agreement;
};

/// Light is clipped at white and blurred by 0.3 % of the diameter first.
/// A reflex is a connected region brighter than nine tenths of the photo's compared pixels, of at
/// least (0.7 % of the diameter) squared. Two match when their middles lie within 2 % of the
/// diameter and their areas within a factor of three; nearest pairs first, each reflex once. The
/// level is the photo's for both pictures, so that a render with too little light has too few
/// reflexes. Nothing when the photo has none.
std::optional<ReflexMatch> match_reflexes(const MatchedPictures& pictures);

}  // namespace culet
