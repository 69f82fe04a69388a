#pragma once
// Runs programs that may be installed beside culet.

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

namespace culet {

bool has_program(const std::string& name);

/// Messages go to a file. Returns the exit status, or -1. A program that takes longer than
/// `most_time` is killed.
int run_program(std::vector<std::string> words, const std::filesystem::path& messages,
                std::chrono::seconds most_time = std::chrono::hours(24));

}  // namespace culet
