#pragma once
// docs/stability.html: every hard case, why it is hard, and its margin.

#include <string>
#include <vector>

#include "tests/hard/hard_case.h"

namespace culet::hard {

/// The page from the results of `run_case`, one JSON text per case in the corpus's order; empty:
/// not run.
std::string stability_page(const std::vector<HardCase>& corpus,
                           const std::vector<std::string>& results);

/// One line per invariant and point, `section.case x invariant holds|fails`: it must be the same
/// for every compiler, flag and processor.
std::string verdicts(const std::vector<std::string>& results);

}  // namespace culet::hard
