#pragma once
// Slips of pen and keyboard: the mistakes that turn one number into another.

#include <optional>
#include <string>
#include <vector>

#include "fit/readings/measurement.h"

namespace culet {

struct Slip {
    std::string what;      ///< `two digits swapped`, `decimal point moved`, `inches for mm`, ...
    double corrected = 0;  ///< the value without the slip
    double weight = 0;     ///< likelihood, to compare with that of other slips of the same number
    /// True if few values can be explained so. A wrong, lost or extra digit explains nearly any.
    bool telling = true;
};

enum class Measured { angle, length, weight };
Measured measured_by(ReadingKind kind);

/// The value probably meant, from other readings.
struct Meant {
    double value = 0, sigma = 0;
    double within = 0;  ///< corrected values further off explain nothing
};

/// Slips that turn a value near the one meant into `written`, the likeliest first: a moved decimal
/// point, swapped digits (also with a leading zero that a spreadsheet drops), inches for
/// millimetres, grams for carats, an angle from the other side (90 - a, 180 - a, a +- 180), one
/// digit wrong, lost or doubled. The likelihood is the frequency of the kind, over the number of
/// slips of that kind, times the normal density of the corrected value. Empty if none fits, or if
/// `written` itself is near.
std::vector<Slip> find_slips(double written, const Meant& meant, Measured measured);

std::optional<Slip> find_slip(double written, const Meant& meant, Measured measured);

}  // namespace culet
