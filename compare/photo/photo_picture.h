#pragma once
// Converts a photo to a picture for an EXR file.

#include <string>

#include "compare/photo/photo.h"
#include "render/image/picture.h"

namespace culet {

/// With `variance.R`, `variance.G`, `variance.B` (to 1.6 %) and `saturated` where known. Uses half
/// floats if every pixel's noise exceeds their rounding. Moves the photo's pixels.
Picture picture_of(Photo photo);

/// Bytes of a PNG, sRGB; 1 is white.
std::string png_of(const Photo& photo);

}  // namespace culet
