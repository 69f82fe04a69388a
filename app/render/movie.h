#pragma once
// Makes films of pictures with the program ffmpeg, where it is installed.

#include <filesystem>
#include <string>

namespace culet {

bool is_movie(const std::filesystem::path& out);

void require_ffmpeg(const std::filesystem::path& movie);

/// Shows 25 pictures per second from `frame-#####.png` in `folder`, from 00001. The film appears
/// complete or not at all. Throws InputError with ffmpeg's last line.
void write_movie(const std::filesystem::path& folder, const std::filesystem::path& movie);

}  // namespace culet
