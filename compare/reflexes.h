#pragma once
// The bright reflexes of a stone as things: how many of the photo's are in the render, and where.

#include <optional>

#include "compare/metrics.h"

namespace culet {

struct ReflexMatch {
    int in_photo = 0, in_render = 0, matched = 0;
    double f1 = 0;       ///< 2 matched / (in_photo + in_render)
    double area_f1 = 0;  ///< the same, each reflex counting with its area
    /// Median distance between the middles of matched reflexes, in diameters; nothing matched:
    /// none.
    std::optional<double> displacement;
};

/// A reflex is a connected region brighter than nine tenths of the photo's compared pixels, of at
/// least (0.7 % of the diameter) squared. Two match when their middles lie within 2 % of the
/// diameter and their areas within a factor of three; nearest pairs first, each reflex once. The
/// level is the photo's for both pictures, so that a render with too little light has too few
/// reflexes. Nothing when the photo has none.
std::optional<ReflexMatch> match_reflexes(const MatchedPictures& pictures);

}  // namespace culet
