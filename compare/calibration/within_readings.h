#pragma once
// Whether a photograph is within what the readings of a stone leave open.

#include "compare/scores/compare.h"

namespace culet {

/// `compare`, and where the render has bands (Photo::bands) `Comparison::within`. The bands are
/// blurred as the photograph is, and widened by its noise and by the steps of its file; pixels that
/// the camera clipped are left out. What the registration is off by is not in them.
Comparison compare_with_bands(const Photo& photo, const Photo& render,
                              const CompareOptions& options = {}, const Progress& progress = {});

}  // namespace culet
