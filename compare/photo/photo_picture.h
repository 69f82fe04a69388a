#pragma once
// A photo as it is written into an EXR.

#include "compare/photo/photo.h"
#include "render/image/picture.h"

namespace culet {

/// With `variance.R`, `variance.G`, `variance.B` (to 1.6 %) and `saturated` where they are known;
/// in half floats where their rounding is lost in the noise of every pixel. The photo's pixels go
/// over into the picture.
Picture picture_of(Photo photo);

}  // namespace culet
