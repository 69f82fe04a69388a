#pragma once
// The colour of a material in a stone of a given size, and its name.
//
// The body colour is that of daylight D65 after one way through the stone, for the CIE 1931
// observer, white being the same light without the stone: the mean over the principal rays of
// exp(-K L), for unpolarised light from no particular direction adds up transmittances, not
// absorptions (Z. Sun et al., How to Calculate Color from Spectra of Uniaxial Gemstones, Gems &
// Gemology 57(1), 2021). L is `light_path_mm`. Reflexes of the surface, which a spectrophotometer
// with a sphere measures along, and fluorescence are left out.

#include <array>
#include <string>

#include "render/colour/colour.h"
#include "render/colour/colour_difference.h"
#include "stone/material/material.h"

namespace culet {

/// The usual stone: a round brilliant of one carat's size in diamond.
constexpr double k_usual_width_mm = 6.5;

/// Down through a brilliant of that width and up again, a little aslant: 2.2 times its depth of
/// 0.61 widths. A convention: there are longer ways as well (13 to 19 mm in the mean where nothing
/// absorbs, at 6.5 mm), but in coloured stones they bring little light, and one way of this length
/// is near the mean of a picture face up (bench/stone_colours.cpp).
double light_path_mm(double width_mm);

struct StoneColour {
    Rgb rgb{1, 1, 1};  ///< linear sRGB; deep colours lie outside 0..1
    Lab lab{100, 0, 0};
    std::string name;  ///< ISCC-NBS, or "colourless"
};

StoneColour body_colour(const Material& material, double width_mm = k_usual_width_mm);

/// The ISCC-NBS name (267 of them) whose middle is nearest by CIEDE2000.
std::string colour_name(const Lab& colour);

/// Nearest colour that a display shows, 0..255 of each primary, by clipping.
std::array<int, 3> display_colour(const Rgb& linear);
/// The same as `#rrggbb`.
std::string display_hex(const Rgb& linear);

}  // namespace culet
