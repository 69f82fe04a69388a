#pragma once
// Pictures as a film, by the program ffmpeg where it is installed.

#include <filesystem>
#include <string>

namespace culet {

/// By its ending, .mp4.
bool is_movie(const std::filesystem::path& out);

/// Throws InputError where ffmpeg is not installed.
void require_ffmpeg(const std::filesystem::path& movie);

/// A file of 25 pictures a second, `frame-#####.png` from 00001 on in `folder`. Whole or not at
/// all. Throws InputError with ffmpeg's last line where it fails.
void write_movie(const std::filesystem::path& folder, const std::filesystem::path& movie);

}  // namespace culet
