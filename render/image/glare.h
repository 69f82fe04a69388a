#pragma once
// Scattering of light in the eye: the photopic point spread function of Spencer, Shirley, Zimmerman
// & Greenberg 1995, "Physically-based glare effects for digital images".

#include <vector>

namespace culet {

struct PictureSize {
    int width = 0, height = 0;
};

/// Scattered part of a point's light per steradian, `degrees` from it: 0.478 f1 + 0.138 f2 of the
/// paper, without the sharp image.
double scattered_by_the_eye(double degrees);

/// Adds `strength` times the mean eye's scattering. `rgb`: 3 values per pixel, linear. Light stays
/// within the picture: the sum is kept, and uniform pictures do not change.
void add_glare(std::vector<float>& rgb, const PictureSize& size, double strength,
               double degrees_per_pixel);

}  // namespace culet
