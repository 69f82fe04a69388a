#pragma once
// Advice on mistakes in the command line, one line each.

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace culet {

/// Suggests the command's nearest option for an unknown one, and what to write instead of a number
/// with additions.
std::string usage_advice(const CLI::App& program, const std::vector<std::string>& words,
                         const CLI::ParseError& error);

/// The text that `culet` prints without arguments.
std::string first_commands();

}  // namespace culet
