#pragma once
// The pixels and outline of one light in a mirror ball.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "compare/light_probe/mirror_ball.h"
#include "compare/photo/photo.h"
#include "render/colour/colour.h"

namespace culet {

struct Reflex {
    std::vector<std::uint8_t> inside;   ///< of each pixel: 1 in the light and its dark bars
    std::vector<std::uint8_t> touched;  ///< 1 also where the picture's blur carries its light
    /// Where the luminance between two neighbouring pixels passes half way between the light and
    /// its surroundings. Accurate to 0.1 pixels for a box-filtered straight edge.
    std::vector<PixelPlace> outline;
    Rgb radiance{};                 ///< mean of inside pixels with inside neighbours
    double within = 0, around = 0;  ///< luminance: median of the light, and of its surroundings
    double over = 0;                ///< share of the inside pixels that are over-exposed
    int pixels = 0;
};

enum class NoReflex : std::uint8_t { beside_the_ball, not_brighter, at_the_rim, too_small };

struct ReflexSearch {
    std::optional<Reflex> found;
    NoReflex why = NoReflex::not_brighter;
};

/// The light at a pixel of the ball: the connected pixels brighter than half way between light and
/// surroundings, holes filled. It must be at least twice as bright as its surroundings, have nine
/// pixels, and end before the ball's compressed rim.
ReflexSearch reflex_at(const Photo& picture, const BallCircle& ball, const PixelPlace& seed);

}  // namespace culet
