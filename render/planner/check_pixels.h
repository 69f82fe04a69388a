#pragma once
// Chooses the pixels at which a picture is compared with the reference.

#include <utility>
#include <vector>

#include "render/image/picture.h"
#include "render/planner/pilot_picture.h"

namespace culet {

class FrameRenderer;

/// Local contrast of a picture at the stone's pixels.
struct Contrast {
    struct Pixel {
        int x = 0, y = 0;
        double root = 0;  ///< of the largest difference from the four neighbours
        double radiance = 0;
    };
    std::vector<Pixel> pixels;  ///< pixels at least half filled by the stone
    double sum = 0;             ///< of the roots
    double radiance = 0;        ///< sum over the pixels
};

/// Takes every pixel of the stone, or if it fills many (about `filled`), one in each square, so
/// that about 65 000 remain: larger pictures have larger details. Differences are mean absolute
/// ones of R, G and B (colour_error.h); non-finite ones count as 0. `windows` side by side show the
/// same: only the first is used. Empty without coverage.
Contrast contrast_of(const Picture& picture, int windows, double filled);

struct CheckPixels {
    StonePixels pixels;           ///< in drawing order
    std::vector<double> weights;  ///< of each, 1 on average (Hansen & Hurwitz 1943)
    bool all = false;             ///< every pixel of the stone, once
    std::size_t first = 0;        ///< number of pixels in the first look
    bool bright = false;          ///< some light is k_bright times as bright as the picture
    bool sun = false;             ///< some light is a hundred times brighter still
};

/// Prefers pixels next to which the picture changes, and pixels that may see a bright light at
/// another wavelength. `scene`: one window, or two that show the same. `some`: stone pixels, used
/// if the picture's coverage shows none. `frames`: as in light_edge_scan.h. Throws Interrupted.
CheckPixels choose_check_pixels(const Scene& scene, const Picture& picture, const StonePixels& some,
                                const Progress& progress, FrameRenderer* frames);

/// Pixels at least half filled by the stone that hold more than `share` of the picture's light and
/// 30 times the mean. Returns the brightest `most` in row order, of the first window only.
std::vector<std::pair<int, int>> bright_outliers(const Picture& picture, int windows, double share,
                                                 std::size_t most);

}  // namespace culet
