#pragma once
// Runs the built program as a user would.

#include <filesystem>
#include <string>
#include <vector>

namespace culet::test {

struct ProgramRun {
    int exit_code = -1;  ///< -1: ended by a signal
    std::string out, err;
};

/// `culet` with these arguments, no shell in between.
ProgramRun run_culet(const std::vector<std::string>& arguments);

}  // namespace culet::test
