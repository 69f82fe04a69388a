#pragma once
// What to say to somebody who gave a command the wrong kind of file.

#include <filesystem>
#include <string>
#include <vector>

#include "stone/file_kind.h"

namespace culet {

/// Throws InputError when `file` is of a kind that `command` (fit) does not take: it says what the
/// file is, what the command takes, and which command takes the file. Kinds that cannot be told
/// pass: the reader of the file says what is wrong with it.
void require_kind(const std::filesystem::path& file, const std::vector<FileKind>& taken,
                  const std::string& command, const std::vector<std::string>& overrides = {});

/// A name of a standard cut, where no file is called so.
bool is_cut_name(const std::string& input);

/// Throws InputError unless `pictures` are photographs and, last, a render or a scene: a scene
/// stands before the last, or the first was rendered by culet and the last was not (and is not
/// said to be a simulated photograph).
void require_photographs_first(const std::vector<std::string>& pictures, bool simulated,
                               const std::vector<std::string>& overrides);

}  // namespace culet
