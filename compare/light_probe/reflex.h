#pragma once
// What one light looks like in a mirror ball: which pixels, and where its edge runs.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "compare/light_probe/mirror_ball.h"
#include "compare/photo/photo.h"
#include "render/colour/colour.h"

namespace culet {

struct Reflex {
    std::vector<std::uint8_t> inside;   ///< a pixel of the picture: 1 in the light, dark bars too
    std::vector<std::uint8_t> touched;  ///< 1 also where the picture's blur carries its light
    /// Where the luminance between two neighbouring pixels passes half way from what lies around
    /// the light to the light: the edge of a box-filtered straight line to a tenth of a pixel.
    std::vector<PixelPlace> outline;
    Rgb radiance{};                 ///< mean of the pixels inside whose neighbours are inside, too
    double within = 0, around = 0;  ///< luminance: median of the light, and of what lies around it
    double over = 0;                ///< share of the pixels inside that are over-exposed
    int pixels = 0;
};

/// Why there is no light to be told apart at a pixel.
enum class NoReflex : std::uint8_t { beside_the_ball, not_brighter, at_the_rim, too_small };

struct ReflexSearch {
    std::optional<Reflex> found;
    NoReflex why = NoReflex::not_brighter;
};

/// The light at a pixel of the ball: all that hangs together and is brighter than half way between
/// the light and what lies around it, holes filled. It must be at least twice as bright as what
/// lies around it, at least nine pixels, and end before the ball's rim, where the picture is
/// pressed flat.
ReflexSearch reflex_at(const Photo& picture, const BallCircle& ball, const PixelPlace& seed);

}  // namespace culet
