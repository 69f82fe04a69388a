#pragma once
// Runs programs that may be installed beside culet.

#include <filesystem>
#include <string>
#include <vector>

namespace culet {

bool has_program(const std::string& name);

/// Messages go to a file. Returns the exit status, or -1.
int run_program(std::vector<std::string> words, const std::filesystem::path& messages);

}  // namespace culet
