#pragma once
// A picture as 8-bit sRGB for PNG files and web pages.

#include <cstdint>
#include <vector>

#include "render/image/film_look.h"

namespace culet {

/// `as_shown`, encoded and rounded: R, G and B of each pixel, then A if `with_alpha`: the stone's
/// coverage if known and `look.alpha` is set, else 255.
std::vector<std::uint8_t> shown_bytes(const Picture& picture, const PngLook& look, bool with_alpha);

}  // namespace culet
