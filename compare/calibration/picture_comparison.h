#pragma once
// A photograph against a render: pictures in, plain data out.

#include "compare/scores/compare.h"
#include "stone/progress/progress.h"

namespace culet {

/// Registers by the outlines, solves one gain for each channel, scores, and draws the null; and
/// where the render has bands (Photo::bands) says how much of the photograph is within them.
/// Bad pictures are no exception: they end as `refused` or as scores without a value. Throws
/// Interrupted when `progress` says so.
Comparison compare(const Photo& photo, const Photo& render, const CompareOptions& options = {},
                   const Progress& progress = {});

}  // namespace culet
