#pragma once
// Rows of a readings file that were copied, not read anew. Private to the room.

#include <vector>

#include "fit/readings/measurement.h"

namespace culet {

/// Marks the rows that repeat an earlier one (the same quantity, value and sigma), where so many
/// repetitions to the last digit cannot be chance: two readings with the standard deviation sigma
/// fall into one step h of the scale with the probability erf(h / (2 sqrt(2) sigma)) at most, and
/// of all rows that repeat a quantity so many would be alike less often than once in a thousand
/// times (Hoeffding 1963, theorem 1). h: `rounding`, or the last digit that rows of this kind
/// show, and at most the step whose own sigma is as large (step / sqrt(12)).
std::vector<bool> copied_rows(const std::vector<WrittenReading>& written);

}  // namespace culet
