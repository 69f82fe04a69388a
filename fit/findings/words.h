#pragma once
// How findings are said: names, readings and slips in sentences. Private to the room.

#include <string>
#include <vector>

#include "fit/findings/result.h"

namespace culet {

/// `C1, C2 and 5 more`: of a longer list, the first `most` are named.
std::string name_list(const std::vector<std::string>& names, std::size_t most = 8);

/// ` of C1/C2`; nothing where there is none.
std::string of_words(const std::vector<std::string>& of);

/// What a value of this kind is multiplied by to stand as in files: there, angles are degrees.
double file_unit(ReadingKind kind);

/// `; 33.8? (two digits swapped)`; nothing where no slip explains the reading.
std::string slip_words(const Proposal& proposal);

/// Micrometres where it is small and the unit is known to be larger.
std::string length_words(double value, LengthUnit unit);

/// Begins with a capital and ends with a stop.
std::string sentence_of(std::string text);

/// `read the inclination of P5`, `measure the width at 45 degrees`, `weigh the stone`.
std::string bench_words(const NextReading& reading);

/// `readings.csv line 12`; of a reading from no file, `reading r8`.
std::string place_words(const Reading& reading);

/// Of a reading that was taken, where it stands and what it is: nobody numbers his rows.
/// `readings.csv line 12 (inclination of C5, r8)`.
std::string told_reading(const std::vector<Reading>& readings, const std::string& id);

}  // namespace culet
