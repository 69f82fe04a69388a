#pragma once
// Which kind of file a name names, and what to say to somebody who gave the wrong kind.

#include <filesystem>
#include <string>
#include <vector>

namespace culet {

enum class FileKind { solid, stone, scene, job, material, picture, table, unknown };

/// By extension; TOML files by their tables. A TOML file that cannot be read throws InputError.
FileKind kind_of(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});

/// Throws InputError when `file` is of a kind that `command` (fit) does not take: it says what the
/// file is, what the command takes, and which command takes the file. Kinds that cannot be told
/// pass: the reader of the file says what is wrong with it.
void require_kind(const std::filesystem::path& file, const std::vector<FileKind>& taken,
                  const std::string& command, const std::vector<std::string>& overrides = {});

/// Throws InputError unless `pictures` are photographs and, last, a render or a scene: a scene
/// stands before the last, or the first was rendered by culet and the last was not (and is not
/// said to be a simulated photograph).
void require_photographs_first(const std::vector<std::string>& pictures, bool simulated,
                               const std::vector<std::string>& overrides);

}  // namespace culet
