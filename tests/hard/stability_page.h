#pragma once
// docs/stability.html: every hard case, what is hard about it, and how far it is from breaking.

#include <string>
#include <vector>

#include "tests/hard/hard_case.h"

namespace culet::hard {

/// The page from the results that `run_case` left, one JSON text a case in the corpus's order;
/// empty: not run.
std::string stability_page(const std::vector<HardCase>& corpus,
                           const std::vector<std::string>& results);

/// One line an invariant and point, `section.case x invariant holds|fails`: what must be the same
/// of every compiler, flag and processor.
std::string verdicts(const std::vector<std::string>& results);

}  // namespace culet::hard
