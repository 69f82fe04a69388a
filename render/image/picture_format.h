#pragma once
// The format of a picture file, by its first bytes.

#include <string>
#include <string_view>

namespace culet {

/// PNG, JPEG, TIFF, EXR, HDR or PFM; empty: none of them.
std::string picture_format(std::string_view bytes);

/// Of a picture that is not read here: "HEIC", "WebP", ...; empty: none that is known.
std::string other_picture_format(std::string_view bytes);

}  // namespace culet
