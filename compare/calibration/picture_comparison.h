#pragma once
// A photograph against a render; pictures in, plain data out.

#include "compare/scores/compare.h"
#include "stone/progress/progress.h"

namespace culet {

/// Registers by the outlines, solves one gain for each channel, scores, and draws the null. For a
/// render with bands (Photo::bands) also finds how much of the photograph is within them. Bad
/// pictures do not throw: they are `refused` or get scores without a value. Throws Interrupted.
Comparison compare(const Photo& photo, const Photo& render, const CompareOptions& options = {},
                   const Progress& progress = {});

}  // namespace culet
