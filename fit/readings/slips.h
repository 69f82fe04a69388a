#pragma once
// Slips of pen and keyboard: which mistake turns one number into another.

#include <optional>
#include <string>
#include <vector>

#include "fit/readings/measurement.h"

namespace culet {

struct Slip {
    std::string what;      ///< `two digits swapped`, `decimal point moved`, `inches for mm`, ...
    double corrected = 0;  ///< the value without the slip
    double weight = 0;     ///< how likely it is, to be compared with others of the same number
    /// Few values can be explained so. A digit that is wrong, lost or too many explains nearly any.
    bool telling = true;
};

/// What a number is: each has slips of its own.
enum class Measured { angle, length, weight };
Measured measured_by(ReadingKind kind);

/// What a number was meant to be, as others say.
struct Meant {
    double value = 0, sigma = 0;
    double within = 0;  ///< what is further off `value` explains nothing
};

/// The slips that turn a value near the one meant into `written`, the likeliest first: the decimal
/// point moved, digits swapped (also where one is a zero that a spreadsheet drops in front),
/// inches taken for millimetres, grams for carats, an angle from the other side (90 - a, 180 - a, a
/// +- 180), one digit wrong, lost or doubled. Likelihood: how often people slip so, over the
/// number of slips of that kind, times the normal density of what it leads to. Nothing when none
/// fits, or when `written` itself is within reach.
std::vector<Slip> find_slips(double written, const Meant& meant, Measured measured);

/// The likeliest of them.
std::optional<Slip> find_slip(double written, const Meant& meant, Measured measured);

}  // namespace culet
