#pragma once
// Finds rows of a readings file that were copied instead of read anew. Private to the room.

#include <vector>

#include "fit/readings/measurement.h"

namespace culet {

/// Marks the rows that repeat an earlier one (same quantity, value and sigma), if so many exact
/// repetitions cannot be chance. Two readings with the standard deviation sigma fall into one step
/// h of the scale with a probability of at most erf(h / (2 sqrt(2) sigma)); rows are marked if,
/// among all rows that repeat a quantity, so many equal ones have a probability below one in a
/// thousand (Hoeffding 1963, theorem 1). h is `rounding`, or the last digit of rows of this kind,
/// but at most the step whose own sigma is as large (step / sqrt(12)).
std::vector<bool> copied_rows(const std::vector<WrittenReading>& written);

}  // namespace culet
