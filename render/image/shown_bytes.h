#pragma once
// A picture as 8-bit sRGB, as PNG files and pages show it.

#include <cstdint>
#include <vector>

#include "render/image/film_look.h"

namespace culet {

/// R, G and B of each pixel, or R, G, B and A where `with_alpha`: what `as_shown` gives, encoded
/// and rounded. Alpha is the stone's coverage where `look.alpha` asks for it and it is known, else
/// 255.
std::vector<std::uint8_t> shown_bytes(const Picture& picture, const PngLook& look, bool with_alpha);

}  // namespace culet
