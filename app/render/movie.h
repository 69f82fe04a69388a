#pragma once
// Makes films of pictures with the program ffmpeg, where it is installed.

#include <filesystem>
#include <string>

namespace culet {

/// True for the extension .mp4.
bool is_movie(const std::filesystem::path& out);

/// Throws InputError if ffmpeg is not installed.
void require_ffmpeg(const std::filesystem::path& movie);

/// Makes a film with 25 pictures per second from `frame-#####.png` in `folder`, numbered from
/// 00001. It appears complete or not at all. Throws InputError with the last line of ffmpeg's
/// output if that fails.
void write_movie(const std::filesystem::path& folder, const std::filesystem::path& movie);

}  // namespace culet
