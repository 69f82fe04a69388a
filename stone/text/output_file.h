#pragma once
// Writing without leaving halves: a file appears whole under its name, or not at all.

#include <filesystem>
#include <string>
#include <string_view>

namespace culet {

/// A temporary neighbour of `target`, moved into place by `commit()`; removed if it never is.
/// Throws InputError when the folder is missing, cannot be written, or the target is a folder.
class OutputFile {
public:
    explicit OutputFile(std::filesystem::path target);
    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    /// Where to write. Has the target's extension, so that format-by-name libraries work.
    const std::filesystem::path& path() const { return temporary_; }
    void commit();

private:
    std::filesystem::path target_, temporary_;
    bool committed_ = false;
};

/// Throws InputError when `target` could not be written; nothing for an empty name or `-`. Asked
/// before long work, and before the first of several outputs, so that a failure leaves none of
/// them.
void require_writable(const std::filesystem::path& target);

/// Writes `text` to `target` whole or not at all; `-` is stdout.
void write_text(const std::filesystem::path& target, std::string_view text);

/// The whole file. Throws InputError when it is missing, a folder, not readable, or larger than
/// `limit_bytes`.
std::string read_text(const std::filesystem::path& file, std::size_t limit_bytes = 256u << 20);

/// What a file's first bytes say that it is (foreign_kind, text_decoding.h); empty where it cannot
/// be read.
std::string foreign_kind_of(const std::filesystem::path& file);

}  // namespace culet
