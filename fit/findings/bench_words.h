#pragma once
// A reading that is yet to be taken, as one would say it at the bench.

#include <string>

#include "fit/findings/assessment.h"

namespace culet {

/// `read the inclination of P5`, `measure the width at 45 degrees`, `weigh the stone`.
std::string bench_words(const NextReading& reading);

}  // namespace culet
