#pragma once
// Which colours a stone shows, wherever they are: its material and the white balance, not its
// geometry.

#include "compare/scores/metrics.h"

namespace culet {

struct ColourDistributions {
    /// CIEDE2000 between the mean CIELAB colours under the mask.
    double body_difference = 0;
    /// Earth mover's distance (Rubner, Tomasi, Guibas 2000) between the distributions of CIELAB
    /// colours, in units of CIELAB: how far, on average, a pixel's colour must be moved for the one
    /// picture to have as much of every colour as the other. Colours are gathered in cells of 8
    /// units or coarser, so that no more than 96 are left: distances below some 2 units say
    /// nothing.
    double emd = 0;
    /// Mean luminance under the mask, 1 being the white level.
    double photo_light = 0, render_light = 0;
};

ColourDistributions colour_distributions(const MatchedPictures& pictures);

}  // namespace culet
