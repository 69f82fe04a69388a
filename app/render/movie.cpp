#include "app/render/movie.h"

#include <fmt/format.h>

#include <sstream>

#include "app/program/other_programs.h"
#include "stone/text/errors.h"
#include "stone/text/output_file.h"

namespace culet {

namespace {

namespace fs = std::filesystem;

}  // namespace

bool is_movie(const std::filesystem::path& out) {
    return out.extension() == ".mp4";
}

void require_ffmpeg(const fs::path& movie) {
    if (has_program("ffmpeg")) return;
    throw InputError(movie,
                     "needs the program ffmpeg, which is not installed: install it, or write "
                     "pictures, -o frame-####.png");
}

void write_movie(const fs::path& folder, const fs::path& movie) {
    OutputFile output(movie);
    const fs::path messages = folder / "ffmpeg.txt";
    // Players need even sides and chroma at half the resolution.
    const int status =
        run_program({"ffmpeg", "-y", "-loglevel", "error", "-framerate", "25", "-i",
                     (folder / "frame-%05d.png").string(), "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2",
                     "-pix_fmt", "yuv420p", "-movflags", "+faststart", output.path().string()},
                    messages);
    if (status != 0) {
        std::string last;
        std::istringstream lines(fs::exists(messages) ? read_text(messages) : "");
        for (std::string line; std::getline(lines, line);) {
            if (!line.empty()) last = line;
        }
        throw InputError(movie, fmt::format("ffmpeg failed{}{}", last.empty() ? "" : ": ", last));
    }
    output.commit();
}

}  // namespace culet
