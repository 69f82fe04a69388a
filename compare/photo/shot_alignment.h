#pragma once
// The camera's shift between two shots, and the ratio of their light. Private to the folder.

#include "compare/photo/bracket.h"
#include "compare/photo/photo.h"

namespace culet {

/// Means of `factor` x `factor` pixels for the alignment, `saturated` if one of them is
/// over-exposed.
Photo reduced(const Photo& photo, int factor);

/// Every `step`-th pixel and row, with the photo's other data.
Photo thinned(const Photo& photo, int step);

/// The factor that leaves at most about `pixels`; 1 for a small photo.
int factor_to(const Photo& photo, double pixels);

/// Shift of `b` against `a`: ECC (Evangelidis & Psarakis 2008) on log-luminance where both are well
/// exposed, coarse to fine. Zero where they share too little.
FrameShift shift_between(const Photo& a, double exposure_a, const Photo& b, double exposure_b);

/// Moves the shot's content back by `shift`; over-exposure spreads in resampling.
void move_back(Photo& photo, const FrameShift& shift);

/// Light of `a` over that of `b`: the median where both are well exposed. 0: too few pixels.
double light_ratio(const Photo& a, const Photo& b);

}  // namespace culet
