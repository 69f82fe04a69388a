#pragma once
// The colour of a material in a stone of a given size, and its name.
//
// The body colour is that of D65 after one path of `light_path_mm` through the stone, for the CIE
// 1931 observer; white is the same light without the stone. It averages exp(-K L) over the
// principal rays: transmittances, not absorptions, add up for unpolarised light from all directions
// (Z. Sun et al., How to Calculate Color from Spectra of Uniaxial Gemstones, Gems & Gemology 57(1),
// 2021). Surface reflections, which a spectrophotometer with a sphere includes, and fluorescence
// are left out.

#include <array>
#include <string>

#include "render/colour/colour.h"
#include "render/colour/colour_difference.h"
#include "stone/material/material.h"

namespace culet {

/// Default width: a round brilliant of one carat in diamond.
constexpr double k_usual_width_mm = 6.5;

/// By convention 2.2 times a brilliant's depth of 0.61 widths: down and up again, slightly oblique.
/// Longer paths (13 to 19 mm in the mean without absorption, at 6.5 mm) bring little light in
/// coloured stones, and this length is near a face-up picture's mean (bench/stone_colours.cpp).
double light_path_mm(double width_mm);

struct StoneColour {
    Rgb rgb{1, 1, 1};  ///< linear sRGB; deep colours lie outside 0..1
    Lab lab{100, 0, 0};
    std::string name;  ///< ISCC-NBS, or "colourless"
};

StoneColour body_colour(const Material& material, double width_mm = k_usual_width_mm);

/// The nearest of the 267 ISCC-NBS names by CIEDE2000 to its centroid.
std::string colour_name(const Lab& colour);

/// Displayable colour, 0..255, clipped.
std::array<int, 3> display_colour(const Rgb& linear);
/// As `#rrggbb`.
std::string display_hex(const Rgb& linear);

}  // namespace culet
