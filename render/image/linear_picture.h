#pragma once
// Converts a codec's samples to linear light by their meaning (codecs/sample_meaning.h).

#include <string>
#include <vector>

#include "render/image/codecs/codecs.h"
#include "render/image/image_io.h"

namespace culet {

/// Adds a note if pixels are not square.
void note_pixel_aspect(double aspect, std::vector<std::string>& notes);

/// Notes a profile that does not fit the samples.
ReadPicture linear_picture(DecodedPixels pixels, const std::string& format);

}  // namespace culet
