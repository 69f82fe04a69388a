#pragma once
// Describes a fit in a few sentences for the person who took the readings.

#include <string>
#include <vector>

#include "fit/findings/result.h"

namespace culet {

/// Plain sentences, the most important first: the verdict, how certain facets are, readings to
/// check and what the others say of them, undetermined parameters, meets that miss, the reading to
/// take next. Leaves out what does not apply.
std::vector<std::string> fit_summary(const FitResult& result);

}  // namespace culet
