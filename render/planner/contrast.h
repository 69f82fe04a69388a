#pragma once
// How much a picture changes beside the stone's pixels.

#include <vector>

#include "render/image/picture.h"

namespace culet {

struct Contrast {
    struct Pixel {
        int x = 0, y = 0;
        double root = 0;  ///< of the largest difference to the four about it
        double radiance = 0;
    };
    std::vector<Pixel> pixels;  ///< that the stone fills by half at least
    double sum = 0;             ///< of the roots
    double radiance = 0;        ///< sum over the pixels
};

/// Of every pixel of the stone, or where it fills many (`filled`, about) of one in each square of
/// so many that some tens of thousands are left: what is seen in a larger picture is larger, too.
/// Differences are mean absolute ones of R, G and B (colour_error.h); those of no finite number
/// count as none. `windows`: side by side that show the same, of which the first is taken. Empty
/// where the picture does not tell what the stone fills.
Contrast contrast_of(const Picture& picture, int windows, double filled);

}  // namespace culet
