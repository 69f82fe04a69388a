#pragma once
// Camera raw files (DNG, CR2, NEF, ARW, ...), read by LibRaw.

#include <filesystem>
#include <string>
#include <string_view>

#include "compare/photo/photo.h"

namespace culet {

/// By the name's extension; a raw file's first bytes are often those of a TIFF.
bool has_raw_extension(const std::filesystem::path& file);

/// Linear light in sRGB primaries: black level off, the camera's own white balance (a grey card
/// does better: white_balance.h), no tone curve, no automatic brightness, turned upright. 1 is
/// where green clips; other channels may go beyond. `saturated` marks pixels whose own or
/// neighbouring sensor samples reach the white level: it is found before anything is interpolated.
/// Throws InputError.
Photo read_raw(const std::filesystem::path& file);

/// What the camera noted, without the picture. Throws InputError.
ShotData read_raw_shot_data(const std::filesystem::path& file);

}  // namespace culet
