#pragma once
// From a codec's samples to linear light, as the file says (codecs/sample_meaning.h).

#include <string>
#include <vector>

#include "render/image/codecs/codecs.h"
#include "render/image/image_io.h"

namespace culet {

/// A note when pixels are not square.
void note_pixel_aspect(double aspect, std::vector<std::string>& notes);

/// Linear light of samples. A profile that does not fit them is named in a note.
ReadPicture linear_picture(DecodedPixels pixels, const std::string& format);

}  // namespace culet
