#pragma once
// Camera raw files (DNG, CR2, NEF, ARW, ...), read by LibRaw.

#include <filesystem>
#include <string>
#include <string_view>

#include "compare/photo/photo.h"

namespace culet {

/// By extension, because raw files often start like TIFFs.
bool has_raw_extension(const std::filesystem::path& file);

/// Linear light in sRGB primaries: black level subtracted, the camera's white balance (a grey card
/// is better: white_balance.h), no tone curve, no automatic brightness, turned upright. Green clips
/// at 1; other channels may go beyond. `saturated` marks pixels whose own or neighbouring sensor
/// samples reach the white level. Throws InputError.
Photo read_raw(const std::filesystem::path& file);

/// Without the picture. Throws InputError.
ShotData read_raw_shot_data(const std::filesystem::path& file);

}  // namespace culet
