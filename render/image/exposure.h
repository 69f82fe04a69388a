#pragma once
// Automatic exposure for pictures of stones.

#include "render/image/picture.h"

namespace culet {

/// Factor on linear light at which 2 % of the stone's pixels exceed white in some colour, so that
/// it is neither dull nor burnt out. Only the stone's pixels count (by `coverage`; without it, all
/// that are not black). 1 for a picture without light.
double exposure_for_stone(const Picture& picture);

}  // namespace culet
