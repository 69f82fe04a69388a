#include "app/movie.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <sstream>
#include <vector>

#include "stone/errors.h"
#include "stone/output_file.h"

extern char** environ;

namespace culet {

namespace {

namespace fs = std::filesystem;

// Runs the program with its messages in a file; its exit status, or -1.
int run(std::vector<std::string> words, const fs::path& messages) {
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&files, STDERR_FILENO, messages.c_str(),
                                     O_WRONLY | O_CREAT | O_TRUNC, 0600);
    posix_spawn_file_actions_adddup2(&files, STDERR_FILENO, STDOUT_FILENO);
    pid_t child = 0;
    const int problem =
        posix_spawnp(&child, arguments[0], &files, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&files);
    int status = 0;
    if (problem != 0 || waitpid(child, &status, 0) != child || !WIFEXITED(status)) return -1;
    return WEXITSTATUS(status);
}

}  // namespace

void require_ffmpeg(const fs::path& movie) {
    const char* const path = std::getenv("PATH");
    std::istringstream folders(path == nullptr ? "" : path);
    for (std::string folder; std::getline(folders, folder, ':');) {
        if (access((fs::path(folder) / "ffmpeg").c_str(), X_OK) == 0) return;
    }
    throw InputError(movie,
                     "needs the program ffmpeg, which is not installed: install it, or write "
                     "pictures, -o frame-####.png");
}

void write_movie(const fs::path& folder, const fs::path& movie) {
    OutputFile output(movie);
    const fs::path messages = folder / "ffmpeg.txt";
    // Players want sides of even length, and colours at half the resolution.
    const int status =
        run({"ffmpeg", "-y", "-loglevel", "error", "-framerate", "25", "-i",
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
