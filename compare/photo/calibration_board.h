#pragma once
// A printable board of squares and markers (ChArUco: Garrido-Jurado et al. 2014, in OpenCV), and
// lens calibration from its photographs.

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "compare/photo/lens.h"
#include "stone/progress/progress.h"

namespace culet {

struct BoardShape {
    int columns = 8, rows = 6;  ///< squares
    double square_mm = 25;
};

/// An SVG in true size, black on white, with a line of description.
std::string board_svg(const BoardShape& shape);

struct BoardPicture {
    std::string name;
    int corners = 0;         ///< number found
    double residual_px = 0;  ///< root mean square; 0: left out
};

struct LensCalibration {
    Lens lens;
    double focal_sigma_px = 0, principal_sigma_px = 0;
    std::vector<BoardPicture> pictures;
    std::vector<std::string> notes;
    std::string doubt;  ///< empty: can be trusted
};

/// Throws InputError for unreadable pictures, different sizes, or fewer than three pictures with at
/// least eight corners. Sets `doubt` above one pixel, or when the board was never tilted.
LensCalibration calibrate_lens(const std::vector<std::filesystem::path>& pictures,
                               const BoardShape& shape, const Progress& progress = {});

}  // namespace culet
