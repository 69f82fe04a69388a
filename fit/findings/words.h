#pragma once
// Words for findings: names, readings and slips in sentences.

#include <string>
#include <vector>

#include "fit/findings/result.h"

namespace culet {

/// `C1, C2 and 5 more`; longer lists show the first `most` names.
std::string name_list(const std::vector<std::string>& names, std::size_t most = 8);

/// ` of C1/C2`; empty if there are none.
std::string of_words(const std::vector<std::string>& of);

/// Factor from a value of this kind to its unit in files, where angles are degrees.
double file_unit(ReadingKind kind);

/// `; 33.8? (two digits swapped)`; empty if no slip explains the reading.
std::string slip_words(const Proposal& proposal);

/// `4 ± 6 µm`: in micrometres below a millimetre, else in `unit`.
std::string length_words(double value, double sigma, LengthUnit unit);

/// Adds a capital at the beginning and a full stop at the end.
std::string sentence_of(std::string text);

/// `read the inclination of P5`, `measure the width at 45 degrees`, `weigh the stone`.
std::string bench_words(const NextReading& reading);

/// `readings.csv line 12`; without a file, `reading r8`.
std::string place_words(const Reading& reading);

/// A reading's place and quantity, since people do not number their rows: `readings.csv line 12
/// (inclination of C5, r8)`.
std::string told_reading(const std::vector<Reading>& readings, const std::string& id);

}  // namespace culet
