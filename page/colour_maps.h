#pragma once
// Numbers as colours. Except in `difference`, lightness is monotonic: readable without seeing hues,
// and in print.

#include <array>
#include <cstdint>
#include <string>

namespace culet {

enum class ColourMap {
    difference,  ///< blue, white, red (ColorBrewer RdBu, Brewer 2003): signed, 0 in the middle
    error,       ///< black, purple, orange, yellow (inferno, Smith and van der Walt 2015)
    likeness,    ///< inferno reversed: what agrees is dark
    residual,    ///< pale yellow, orange, dark red (YlOrRd, Brewer 2003): how far a reading is off
    uncertainty  ///< pale yellow, green, dark blue (YlGnBu, Brewer 2003): how uncertain a facet is
};

/// The colour at 0..1 (clamped; NaN counts as 0): red, green, blue in sRGB.
std::array<std::uint8_t, 3> colour_at(ColourMap map, double share);

/// `#rrggbb`
std::string css_colour(ColourMap map, double share);

/// From 0 to 1, left to right.
std::string css_gradient(ColourMap map);

}  // namespace culet
