#pragma once
// A camera's geometry (focal length, principal point, distortion): calibrated with pictures of a
// board, stored in a file, and used to undistort photographs.

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "compare/photo/photo.h"

namespace culet {

/// Pixels, the centre of the first one at (0, 0). Distortion as in OpenCV (Brown 1971): radial k1,
/// k2, tangential p1, p2, radial k3.
struct Lens {
    int width = 0, height = 0;
    double focal_x = 0, focal_y = 0;
    double principal_x = 0, principal_y = 0;
    std::array<double, 5> distortion{};
    double residual_px = 0;  ///< root mean square over the board's corners
    int pictures = 0;        ///< number that it was found from
};

/// Reads a file's `[lens]` table. Throws InputError.
Lens read_lens(const std::filesystem::path& file);
std::string lens_toml(const Lens& lens, const std::string& camera);

/// The lens for pictures of another size and the same shape (a smaller export). Throws InputError
/// naming `file` when the shape differs, because such a picture was cropped.
Lens lens_for(const Lens& lens, int width, int height, const std::filesystem::path& file);

/// Removes distortion; focal lengths and principal point stay. Also resamples variance and
/// over-exposure.
void undistort(Photo& photo, const Lens& lens);

}  // namespace culet
