#pragma once
// Facet names that spreadsheets change because they look like numbers or dates. Private to the
// room.

#include <string>
#include <vector>

#include "fit/readings/measurement.h"

namespace culet {

/// What to do about a name that a spreadsheet made into a date (1-Feb, Mar-07, 2026-02-01); empty
/// if it is none.
std::string date_words(const std::string& name);

/// A spreadsheet turns 1.10 into 1.1. Throws InputError at the second row that reads a facet such
/// as 1.1, if 1.10 is a facet too and no row of that kind reads it.
void refuse_lost_zeros(const std::vector<WrittenReading>& written, const Stone& stone);

}  // namespace culet
