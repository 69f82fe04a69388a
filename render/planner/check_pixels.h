#pragma once
// Of which pixels a picture is held against the truth.

#include <utility>
#include <vector>

#include "render/image/picture.h"
#include "render/planner/pilot_picture.h"

namespace culet {

class FrameRenderer;

/// How much a picture changes beside the stone's pixels.
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

struct CheckPixels {
    StonePixels pixels;          ///< in the order in which they are drawn
    std::vector<double> counts;  ///< of each, 1 in the mean (Hansen & Hurwitz 1943)
    bool all = false;            ///< each pixel of the stone once
    std::size_t first = 0;       ///< that are looked at first
    bool bright = false;         ///< a light is many times as bright as the picture
    bool sun = false;            ///< some thousand times
};

/// `scene`: one window, or two that see the same; `some`: pixels of the stone, taken where the
/// picture tells of none. More often where the picture changes beside a pixel, and where a bright
/// light may be seen at another wavelength. `frames`: that drew it, if any (light_edge_scan.h).
/// Throws Interrupted.
CheckPixels choose_check_pixels(const Scene& scene, const Picture& picture, const StonePixels& some,
                                const Progress& progress, FrameRenderer* frames);

/// Those that the stone fills by half at least and that have more than this share of the picture's
/// light each, and many times as much as the mean; the brightest `most`, in the order of rows. Of
/// windows side by side, the first.
std::vector<std::pair<int, int>> outstanding_pixels(const Picture& picture, int windows,
                                                    double share, std::size_t most);

}  // namespace culet
