#pragma once
// Readings as one would say them at the bench.

#include <string>
#include <vector>

#include "fit/findings/assessment.h"
#include "fit/readings/measurement.h"

namespace culet {

/// `read the inclination of P5`, `measure the width at 45 degrees`, `weigh the stone`.
std::string bench_words(const NextReading& reading);

/// Of a reading that was taken, where it stands and what it is: nobody numbers his rows.
/// `readings.csv line 12 (inclination of C5, r8)`.
std::string told_reading(const std::vector<Reading>& readings, const std::string& id);

}  // namespace culet
