#pragma once
// A picture as 8-bit sRGB for PNG files and web pages.

#include <cstdint>
#include <vector>

#include "render/image/film_look.h"

namespace culet {

/// R, G and B of each pixel, or R, G, B and A if `with_alpha`: `as_shown`, encoded and rounded.
/// Alpha is the stone's coverage if known and `look.alpha` is set, else 255.
std::vector<std::uint8_t> shown_bytes(const Picture& picture, const PngLook& look, bool with_alpha);

}  // namespace culet
