#pragma once
// The kind of file that a name stands for.

#include <filesystem>
#include <string>
#include <vector>

namespace culet {

enum class FileKind { solid, stone, scene, job, material, picture, table, unknown };

/// Goes by the extension, for TOML files by their tables. Throws InputError for an unreadable TOML
/// file.
FileKind kind_of(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});

/// The kind in words that follow "is": "a scene", "a job", ...
const char* words_for(FileKind kind);

}  // namespace culet
