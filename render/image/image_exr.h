#pragma once
// OpenEXR files.

#include <array>
#include <filesystem>
#include <string>

#include "render/image/picture.h"

namespace culet {

/// Planes of a Picture with the variance of R, G and B.
inline constexpr std::array k_variance_channels{"variance.R", "variance.G", "variance.B"};

/// R, G, B (or Y), A and spectral planes of the file's bytes; 16-bit, 32-bit float and integer
/// channels. Memory is taken only for what the file can hold. Throws InputError naming `file`.
Picture read_exr(const std::string& bytes, const std::filesystem::path& file, bool& had_alpha);

/// Channels R, G, B, A when coverage is known, S0.589,300nm for spectral planes and S1 to S3 for
/// their polarisation (Fichet et al. 2021), standard_error.Y where paths were chosen at random, and
/// further planes by their names. R, G, B, A as the picture's samples are held, others as floats.
void write_exr(const Picture& picture, const std::filesystem::path& file,
               const std::vector<std::pair<std::string, std::string>>& text);

/// The library's message, for an error's line.
std::string one_line(const char* what);

}  // namespace culet
