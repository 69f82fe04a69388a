#pragma once
// Which kind of file a name names.

#include <filesystem>
#include <string>
#include <vector>

namespace culet {

enum class FileKind { solid, stone, scene, job, material, picture, table, unknown };

/// By extension; TOML files by their tables. A TOML file that cannot be read throws InputError.
FileKind kind_of(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});

/// What a file of this kind is, in words that follow "is": "a scene", "a job", ...
const char* words_for(FileKind kind);

}  // namespace culet
