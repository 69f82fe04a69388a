#pragma once
// Writes files so that they appear complete under their name, or not at all.

#include <filesystem>
#include <string>
#include <string_view>

namespace culet {

/// A temporary file beside `target`. `commit()` moves it into place; otherwise it is removed.
/// Throws InputError when the folder is missing or not writable, or the target is a folder.
class OutputFile {
public:
    explicit OutputFile(std::filesystem::path target);
    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    /// Where to write; has the target's extension, for libraries that choose the format by it.
    const std::filesystem::path& path() const { return temporary_; }
    void commit();

private:
    std::filesystem::path target_, temporary_;
    bool committed_ = false;
};

/// Throws InputError when `target` could not be written; does nothing for an empty name or `-`.
/// Call it before long work and before the first of several outputs.
void require_writable(const std::filesystem::path& target);

/// Writes completely or not at all; `-` is stdout.
void write_text(const std::filesystem::path& target, std::string_view text);

/// Throws InputError when the file is missing, or no regular file. Call it before complaining about
/// what a name says.
void require_file(const std::filesystem::path& file);

/// Throws InputError when the file is missing, a folder, not readable, or larger than
/// `limit_bytes`.
std::string read_text(const std::filesystem::path& file, std::size_t limit_bytes = 256u << 20);

/// Returns `foreign_kind` (text_decoding.h) of the file's first bytes; empty if unreadable.
std::string foreign_kind_of(const std::filesystem::path& file);

}  // namespace culet
