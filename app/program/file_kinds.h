#pragma once
// Messages for users who gave a command the wrong kind of file.

#include <filesystem>
#include <string>
#include <vector>

#include "stone/file_kind.h"

namespace culet {

/// Throws InputError when `command` (fit) does not take files of this kind, saying what the file
/// is, what the command takes, and which command takes the file. Files of unknown kind pass: their
/// reader reports what is wrong.
void require_kind(const std::filesystem::path& file, const std::vector<FileKind>& taken,
                  const std::string& command, const std::vector<std::string>& overrides = {});

/// False if a file has that name.
bool is_cut_name(const std::string& input);

/// Throws InputError unless `pictures` are photographs followed by a render or a scene. It refuses
/// a scene before the last one, and a first picture that culet rendered with a last that it did not
/// (unless the photographs are `simulated`).
void require_photographs_first(const std::vector<std::string>& pictures, bool simulated,
                               const std::vector<std::string>& overrides);

}  // namespace culet
