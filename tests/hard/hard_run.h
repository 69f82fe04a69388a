#pragma once
// Runs a case: every invariant at every point of its sweep.

#include <filesystem>

#include "tests/hard/hard_kinds.h"

namespace culet::hard {

/// Fails the running test for every invariant that does not hold. Writes the figures for the page
/// to `results` as SECTION.NAME.json. Ends the program when the case exceeds its time limit.
void run_case(const HardCase& hard_case, const std::filesystem::path& results);

}  // namespace culet::hard
