#pragma once
// Automatic exposure for pictures of stones.

#include "render/image/picture.h"

namespace culet {

/// Returns the factor on linear light at which 2 % of the stone's pixels exceed white in some
/// colour, so that the stone is neither dull nor burnt out. Pixels beside the stone do not count
/// (by `coverage`; without it, black pixels). Returns 1 for a picture without light.
double exposure_for_stone(const Picture& picture);

}  // namespace culet
