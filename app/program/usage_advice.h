#pragma once
// Answers to slips of the command line, one line each.

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace culet {

/// What to say when the words of the command line cannot be parsed: an unknown option is answered
/// with the nearest one of the command, a number with something about it with what to write.
std::string usage_advice(const CLI::App& program, const std::vector<std::string>& words,
                         const CLI::ParseError& error);

/// `culet` alone: what it is and which commands to begin with.
std::string first_commands();

}  // namespace culet
