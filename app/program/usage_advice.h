#pragma once
// Advice on mistakes in the command line, one line each.

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace culet {

/// For an unknown option the command's nearest one; for a number with additions, what to write.
std::string usage_advice(const CLI::App& program, const std::vector<std::string>& words,
                         const CLI::ParseError& error);

/// For `culet` without arguments.
std::string first_commands();

}  // namespace culet
