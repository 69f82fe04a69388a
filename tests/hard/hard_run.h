#pragma once
// Runs a case: every invariant at every point of its sweep.

#include <filesystem>

#include "tests/hard/hard_kinds.h"

namespace culet::hard {

/// Fails the running test for whatever does not hold, and leaves the figures in `results` as
/// SECTION.NAME.json for the page. Ends the program when the case takes longer than it may.
void run_case(const HardCase& hard_case, const std::filesystem::path& results);

}  // namespace culet::hard
