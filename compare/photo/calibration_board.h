#pragma once
// A board of squares and markers (ChArUco: Garrido-Jurado et al. 2014, in OpenCV) to print, and the
// lens that photographs of it tell.

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

/// The board as an SVG of its true size, black on white, with a line that says what it is.
std::string board_svg(const BoardShape& shape);

struct BoardPicture {
    std::string name;
    int corners = 0;         ///< found
    double residual_px = 0;  ///< root mean square; 0 where it was left out
};

struct LensCalibration {
    Lens lens;
    double focal_sigma_px = 0, principal_sigma_px = 0;
    std::vector<BoardPicture> pictures;
    std::vector<std::string> notes;
    std::string doubt;  ///< empty: to be trusted
};

/// Throws InputError: unreadable pictures, pictures of several sizes, fewer than three with at
/// least eight corners. Doubtful above one pixel, or when the board was never tilted.
LensCalibration calibrate_lens(const std::vector<std::filesystem::path>& pictures,
                               const BoardShape& shape, const Progress& progress = {});

}  // namespace culet
