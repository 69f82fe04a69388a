#pragma once
// How bright a picture is shown, for whom it is about the stone.

#include "render/image/picture.h"

namespace culet {

/// The factor on linear light with which the stone is neither dull nor burnt out: of the stone's
/// pixels (`coverage`; without it all that are not black) one in fifty is over white in some
/// colour, and what lies about it does not count. A picture without light: 1.
double exposure_for_stone(const Picture& picture);

}  // namespace culet
