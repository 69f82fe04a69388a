#pragma once
// Runs the built program like a user.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "tests/folder_test.h"

namespace culet::test {

struct ProgramRun {
    int exit_code = -1;  ///< -1: ended by a signal
    std::string out, err;
    double cpu_after_stop = 0;  ///< seconds of processor time
};

/// Runs `culet` with these arguments, without a shell. `stop_at`: seconds of processor time after
/// which it gets SIGTERM; 0: never.
ProgramRun run_culet(const std::vector<std::string>& arguments, double stop_at = 0);

class ProgramTest : public FolderTest {
protected:
    /// Checks that the program refuses: exit code 2, nothing on stdout, one line `culet: error:
    /// ...`, which is returned.
    static std::string refusal(const std::vector<std::string>& arguments);
    static std::string refusal_of(const ProgramRun& run);
    void cut(const std::string& kind, const std::string& name) const;
    nlohmann::json json(const std::string& name) const;
};

}  // namespace culet::test
