#pragma once
// How far the camera moved between two shots, and by how much their light differs. Inside this room
// only.

#include "compare/photo/bracket.h"
#include "compare/photo/photo.h"

namespace culet {

/// What is needed of a shot to align it: means of `factor` x `factor` pixels; a mean with a pixel
/// in it that is over-exposed is marked as `saturated`.
Photo reduced(const Photo& photo, int factor);

/// Every `step`-th pixel of every `step`-th row, and what is known of the photo.
Photo thinned(const Photo& photo, int step);

/// The factor that leaves at most about `pixels`; 1 for a small photo.
int factor_to(const Photo& photo, double pixels);

/// Shift of `b` against `a`; ECC (Evangelidis & Psarakis 2008) on log-luminance over what both
/// expose well, from coarse to fine. None where they share too little.
FrameShift shift_between(const Photo& a, double exposure_a, const Photo& b, double exposure_b);

/// The shot's content moved back by `shift`; over-exposure spreads with it.
void move_back(Photo& photo, const FrameShift& shift);

/// Ratio of the light in `a` to that in `b`: the median over what both expose well. 0: too few.
double light_ratio(const Photo& a, const Photo& b);

}  // namespace culet
