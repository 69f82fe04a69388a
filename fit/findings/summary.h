#pragma once
// A fit in a few sentences for the person who took the readings.

#include <string>
#include <vector>

#include "fit/findings/result.h"

namespace culet {

/// Plain sentences, the most important first, each ready to be printed as a line: does it hold, how
/// sure are the facets, which readings to look at again and what the others say of them, what is
/// left open, which meets do not meet, which reading to take next. Only what there is to say.
std::vector<std::string> fit_summary(const FitResult& result);

}  // namespace culet
