#pragma once
// Advice on mistakes in the command line, one line each.

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace culet {

/// The message for a command line that cannot be parsed. For an unknown option it suggests the
/// command's nearest one; for a number with additions, what to write.
std::string usage_advice(const CLI::App& program, const std::vector<std::string>& words,
                         const CLI::ParseError& error);

/// Text for `culet` without arguments: what it is and which commands to begin with.
std::string first_commands();

}  // namespace culet
