#pragma once
// Which colours a stone shows, wherever they are: a matter of material and white balance, not
// geometry.

#include "compare/scores/metrics.h"

namespace culet {

struct ColourDistributions {
    /// CIEDE2000 between the mean CIELAB colours under the mask.
    double body_difference = 0;
    /// Earth mover's distance (Rubner, Tomasi, Guibas 2000) between the CIELAB distributions, in
    /// CIELAB units: how far a pixel's colour must move on average. Colours are grouped into at
    /// most 96 cells of 8 units or more, so distances below about 2 mean nothing.
    double emd = 0;
    /// Mean luminance under the mask; 1 is the white level.
    double photo_light = 0, render_light = 0;
};

ColourDistributions colour_distributions(const MatchedPictures& pictures);

}  // namespace culet
