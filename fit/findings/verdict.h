#pragma once
// The first sentence of a fit: whether its readings agree.

#include <string>

#include "fit/findings/result.h"

namespace culet {

std::string fit_verdict(const FitResult& result);

}  // namespace culet
