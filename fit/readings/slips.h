#pragma once
// Slips of pen and keyboard: which mistake turns one number into another.

#include <optional>
#include <string>

#include "fit/readings/measurement.h"

namespace culet {

struct Slip {
    std::string what;      ///< `two digits swapped`, `decimal point moved`, `inches for mm`, ...
    double corrected = 0;  ///< the value without the slip
};

/// What a number is: each has slips of its own.
enum class Measured { angle, length, weight };
Measured measured_by(ReadingKind kind);

/// The likeliest slip that turns a value near `wanted` (within `tolerance`) into `written`: the
/// decimal point moved, digits swapped, inches taken for millimetres, grams for carats, an angle
/// from the other side (90 - a, 180 - a, a +- 180), one digit wrong, lost or doubled. Nothing when
/// none fits, or when `written` itself is within the tolerance.
std::optional<Slip> find_slip(double written, double wanted, double tolerance, Measured measured);

}  // namespace culet
