#pragma once
// The common page of several photographs of one stone.

#include <string>
#include <vector>

#include "compare/calibration/several.h"

namespace culet {

/// A table with links to each photograph's own report.
std::string several_page(const SeveralPhotographs& several, const std::vector<PhotographRow>& rows,
                         const std::string& title, const std::string& version,
                         const std::string& command);

}  // namespace culet
