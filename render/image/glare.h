#pragma once
// Light that the eye scatters: Spencer, Shirley, Zimmerman & Greenberg 1995, "Physically-based
// glare effects for digital images", the photopic point spread.

#include <vector>

namespace culet {

struct PictureSize {
    int width = 0, height = 0;
};

/// Of the light of a point, what is seen `degrees` beside it, per steradian and without its sharp
/// image: 0.478 f1 + 0.138 f2 of the paper.
double scattered_by_the_eye(double degrees);

/// Scatters `strength` times what the mean eye does. `rgb`: 3 a pixel, linear. Light stays within
/// the picture: its sum is kept, and an even picture is unchanged.
void add_glare(std::vector<float>& rgb, const PictureSize& size, double strength,
               double degrees_per_pixel);

}  // namespace culet
