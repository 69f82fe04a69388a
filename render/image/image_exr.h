#pragma once
// OpenEXR files.

#include <array>
#include <filesystem>
#include <string>

#include "render/image/image_io.h"

namespace culet {

/// Planes of a Picture with the variance of R, G and B.
inline constexpr std::array k_variance_channels{"variance.R", "variance.G", "variance.B"};

/// Colours (exr_channels.h), A and spectral planes of the file's bytes; 16-bit, 32-bit float and
/// integer channels. The `chromaticities` and `adoptedNeutral` attributes are followed; the picture
/// is the display window, 0 where the data window has no pixels. Memory is taken only for what the
/// file can hold. Throws InputError naming `file`.
ReadPicture read_exr(const std::string& bytes, const std::filesystem::path& file);

/// Channels R, G, B, A when coverage is known, S0.589,300nm for spectral planes and S1 to S3 for
/// their polarisation (Fichet et al. 2021), standard_error.Y where paths were chosen at random, and
/// further planes by their names. R, G, B, A as the picture's samples are held, others as floats.
void write_exr(const Picture& picture, const std::filesystem::path& file,
               const std::vector<std::pair<std::string, std::string>>& text);

/// The library's message, for an error's line.
std::string one_line(const char* what);

}  // namespace culet
