#pragma once
// A camera's geometry: focal length, principal point, distortion; found from pictures of a board,
// kept in a file, taken out of photographs.

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "compare/photo/photo.h"

namespace culet {

/// Pixels, the centre of the first one at (0, 0). Distortion as OpenCV has it (Brown 1971): radial
/// k1, k2, tangential p1, p2, radial k3.
struct Lens {
    int width = 0, height = 0;
    double focal_x = 0, focal_y = 0;
    double principal_x = 0, principal_y = 0;
    std::array<double, 5> distortion{};
    double residual_px = 0;  ///< root mean square over the board's corners
    int pictures = 0;        ///< it was found from
};

/// A file with the table `[lens]`. Throws InputError.
Lens read_lens(const std::filesystem::path& file);
std::string lens_toml(const Lens& lens, const std::string& camera);

/// The lens for pictures of another size of the same shape (a smaller export). Throws InputError
/// naming `file` when the shape differs: such a picture was cut.
Lens lens_for(const Lens& lens, int width, int height, const std::filesystem::path& file);

/// The picture as a lens without distortion would show it, with the same focal lengths and
/// principal point; variance and over-exposure go along.
void undistort(Photo& photo, const Lens& lens);

}  // namespace culet
