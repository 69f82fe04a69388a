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

/// What the others say of a suspect reading: its quantity, value, estimate and slip, on one line.
std::string suspect_words(const FitResult& result, const std::string& id);

/// The one thing to do next: look again at what contradicts the others, or take the reading that
/// helps most. Empty if nothing is worth the work.
std::string next_step(const FitResult& result);

}  // namespace culet
