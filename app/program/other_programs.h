#pragma once
// Runs programs that may be installed beside culet.

#include <filesystem>
#include <string>
#include <vector>

namespace culet {

/// True if a program of that name is on the PATH.
bool has_program(const std::string& name);

/// Runs a program and writes its messages to a file. Returns its exit status, or -1.
int run_program(std::vector<std::string> words, const std::filesystem::path& messages);

}  // namespace culet
