#pragma once
// What spreadsheets make of names of facets that look like numbers or dates. Private to the room.

#include <string>
#include <vector>

#include "fit/readings/measurement.h"

namespace culet {

/// What to do about a name that a spreadsheet made a date of (1-Feb, Mar-07, 2026-02-01); empty:
/// it is none.
std::string date_words(const std::string& name);

/// Throws InputError at the second row that reads a facet such as 1.1 where 1.10 is a facet too and
/// no row of the kind reads it: a spreadsheet drops the zero.
void refuse_lost_zeros(const std::vector<WrittenReading>& written, const Stone& stone);

}  // namespace culet
