#pragma once
// What is wrong with a spin series as a whole, in words.

#include <string>
#include <vector>

#include "compare/turntable/tangency.h"
#include "refine/spin/spin.h"

namespace culet {

struct SeriesFaults {
    std::vector<std::string> notes;  ///< what is odd, but has been allowed for
    /// Why a stone of the series should not be trusted, and what to do; empty: it can.
    std::string trouble, remedy;
};

/// Steps that are missing, doubled or of another size; a stone that slipped.
/// `names`, `outlines`: of the pictures, in their order; `step`: from one to the next, radians.
SeriesFaults faults_of_series(const Tangency& found, const TangencyOptions& options, double step,
                              const std::vector<std::string>& names,
                              const std::vector<CoarseOutline>& outlines);

/// A ground that a program made one colour in most frames.
SeriesFaults cut_out(const std::vector<SpinFrame>& frames,
                     const std::vector<CoarseOutline>& outlines);

}  // namespace culet
