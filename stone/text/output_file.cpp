#include "stone/text/output_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <string>
#include <system_error>

#include "stone/text/errors.h"
#include "stone/text/text_decoding.h"

namespace culet {

namespace fs = std::filesystem;

OutputFile::OutputFile(fs::path target) : target_(std::move(target)) {
    std::error_code error;
    if (target_.empty()) throw InputError("no output file named: give one with -o FILE");
    if (fs::is_directory(target_, error)) {
        throw InputError(target_, "is a folder: give the name of a file to write");
    }
    const fs::path folder = target_.has_parent_path() ? target_.parent_path() : fs::path(".");
    if (!fs::is_directory(folder, error)) {
        throw InputError(target_,
                         fmt::format("cannot be written: there is no folder {}", folder.string()));
    }
    // Exclusive creation: programs that write the same target never share a temporary file.
    for (int attempt = 0; attempt < 100; ++attempt) {
        temporary_ = folder / fmt::format(".{}.{}.{}{}", target_.stem().string(), ::getpid(),
                                          attempt, target_.extension().string());
        const int descriptor = ::open(temporary_.c_str(), O_CREAT | O_EXCL | O_WRONLY, 0666);
        if (descriptor >= 0) {
            ::close(descriptor);
            // An existing target without write permission is not replaced.
            if (fs::exists(target_, error) && ::access(target_.c_str(), W_OK) != 0) {
                fs::remove(temporary_, error);
                throw InputError(target_, "cannot be overwritten: no permission");
            }
            return;
        }
        if (errno != EEXIST) break;
    }
    throw InputError(target_, fmt::format("cannot be written: {}", std::strerror(errno)));
}

OutputFile::~OutputFile() {
    std::error_code ignored;
    if (!committed_) fs::remove(temporary_, ignored);
}

void OutputFile::commit() {
    std::error_code error;
    fs::rename(temporary_, target_, error);
    if (error) throw InputError(target_, fmt::format("cannot be written: {}", error.message()));
    committed_ = true;
}

void require_writable(const fs::path& target) {
    if (!target.empty() && target != "-") OutputFile attempt(target);
}

void write_text(const fs::path& target, std::string_view text) {
    if (target == "-") {
        if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() ||
            std::fflush(stdout) != 0) {
            throw InputError("the results could not be written to stdout");
        }
        return;
    }
    OutputFile file(target);
    std::FILE* stream = std::fopen(file.path().c_str(), "wb");
    if (stream == nullptr) {
        throw InputError(target, fmt::format("cannot be written: {}", std::strerror(errno)));
    }
    const bool written = std::fwrite(text.data(), 1, text.size(), stream) == text.size();
    const bool closed = std::fclose(stream) == 0;
    if (!written || !closed) throw InputError(target, "cannot be written: is the disk full?");
    file.commit();
}

void require_file(const fs::path& file) {
    std::error_code error;
    if (!fs::exists(file, error)) throw InputError(file, "no such file");
    if (fs::is_directory(file, error)) throw InputError(file, "is a folder, not a file");
    if (!fs::is_regular_file(file, error)) throw InputError(file, "is not a regular file");
}

std::string read_text(const fs::path& file, std::size_t limit_bytes) {
    require_file(file);
    std::error_code error;
    const auto size = fs::file_size(file, error);
    if (error) throw InputError(file, fmt::format("cannot be read: {}", error.message()));
    if (size > limit_bytes) {
        throw InputError(file, fmt::format("is {} MB; files over {} MB are not read here",
                                           size >> 20, limit_bytes >> 20));
    }
    std::FILE* stream = std::fopen(file.c_str(), "rb");
    if (stream == nullptr) {
        throw InputError(file, fmt::format("cannot be read: {}", std::strerror(errno)));
    }
    std::string text(size, '\0');
    const std::size_t got = std::fread(text.data(), 1, size, stream);
    std::fclose(stream);
    text.resize(got);
    return text;
}

std::string foreign_kind_of(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::string bytes(64, '\0');
    stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    bytes.resize(static_cast<std::size_t>(std::max<std::streamsize>(stream.gcount(), 0)));
    return foreign_kind(bytes);
}

}  // namespace culet
