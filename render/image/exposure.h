#pragma once
// Automatic exposure for pictures of stones.

#include "render/image/film_look.h"
#include "render/image/picture.h"

namespace culet {

/// Factor on linear light at which a share of the stone's pixels exceeds white in some colour, so
/// that it is neither dull nor burnt out (PngLook::share_over_white). Only the stone's pixels count
/// (by `coverage`; without it, all that are not black). 1 for a picture without light.
double exposure_for_stone(const Picture& picture,
                          double share_over_white = PngLook{}.share_over_white);

}  // namespace culet
