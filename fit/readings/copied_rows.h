#pragma once
// Finds copied rows in a readings file. Private to the room.

#include <vector>

#include "fit/readings/measurement.h"

namespace culet {

/// Marks rows that repeat an earlier one (same quantity, value and sigma), if so many cannot be
/// chance: two readings of standard deviation sigma fall into one step h of the scale with
/// probability erf(h / (2 sqrt(2) sigma)) at most, and the number of equal rows among all that
/// repeat a quantity has a probability below one in a thousand (Hoeffding 1963, theorem 1). h is
/// `rounding`, or the last digit of rows of this kind, but at most the step whose own sigma is as
/// large (step / sqrt(12)).
std::vector<bool> copied_rows(const std::vector<WrittenReading>& written);

}  // namespace culet
