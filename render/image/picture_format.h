#pragma once
// Recognises picture formats by a file's first bytes.

#include <string>
#include <string_view>

namespace culet {

/// PNG, JPEG, TIFF, EXR, HDR or PFM; empty: none of them.
std::string picture_format(std::string_view bytes);

/// Name of a format that is not read: "HEIC", "WebP", ...; empty: unknown.
std::string other_picture_format(std::string_view bytes);

}  // namespace culet
