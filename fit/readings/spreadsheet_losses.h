#pragma once
// Facet names that spreadsheets take for numbers or dates. Private to the room.

#include <string>
#include <vector>

#include "fit/readings/measurement.h"

namespace culet {

/// Advice on a name that a spreadsheet made into a date (1-Feb, Mar-07, 2026-02-01); else empty.
std::string date_words(const std::string& name);

/// Spreadsheets turn 1.10 into 1.1. Throws InputError at the second row of 1.1 if 1.10 is a facet
/// too and no row of that kind reads it.
void refuse_lost_zeros(const std::vector<WrittenReading>& written, const Stone& stone);

}  // namespace culet
