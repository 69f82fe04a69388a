#pragma once
// The size that a picture file says it has, before anything is allocated for it.

#include <cstdint>
#include <string>
#include <string_view>

namespace culet {

struct PictureHeader {
    std::string format;                   ///< PNG, JPEG, TIFF, EXR, HDR or PFM; empty: none of them
    std::uint64_t width = 0, height = 0;  ///< 0 where the header does not say
};

/// Reads the first fields of each format; never throws and never reads past the end.
PictureHeader picture_header(std::string_view bytes);

}  // namespace culet
