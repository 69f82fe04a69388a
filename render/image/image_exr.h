#pragma once
// Reads and writes OpenEXR files.

#include <array>
#include <filesystem>
#include <string>

#include "render/image/image_io.h"

namespace culet {

/// Planes of a Picture with the variances of R, G and B.
inline constexpr std::array k_variance_channels{"variance.R", "variance.G", "variance.B"};

/// Reads colours (exr_channels.h), A and spectral planes, as 16- or 32-bit floats or integers.
/// Applies the attributes `chromaticities` and `adoptedNeutral`. The picture is the display window,
/// 0 outside the data window. Allocates only what the file can hold. Throws InputError naming
/// `file`.
ReadPicture read_exr(const std::string& bytes, const std::filesystem::path& file);

/// Writes R, G, B, A (if coverage is known), S0.589,300nm for spectral planes and S1 to S3 for
/// their polarisation (Fichet et al. 2021), standard_error.Y if there is one, and further planes by
/// name. R, G, B, A are held as Picture::samples says, others as floats.
void write_exr(const Picture& picture, const std::filesystem::path& file,
               const std::vector<std::pair<std::string, std::string>>& text);

/// Shortens OpenEXR's message to one line.
std::string one_line(const char* what);

}  // namespace culet
