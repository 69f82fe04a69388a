#pragma once
// What a fit's numbers say beyond facets and readings.

#include <string>
#include <vector>

#include "fit/readings/measurement.h"

namespace culet {

/// A proportion of the cut (see cut_quantities.h for the definitions).
struct FittedProportion {
    std::string name, unit;  ///< unit: %, deg, mm3, ct, the stone's length unit, or empty
    double value = 0, sigma = 0;
};

/// A reading that was not made and would help.
struct NextReading {
    ReadingKind kind = ReadingKind::inclination;
    std::vector<std::string> of;
    double sigma =
        0;  ///< that is supposed: as of the other readings of its kind; radians or length
    double reduces = 0;   ///< part of the total variance of all facets that it would take away
    bool closes = false;  ///< it would determine a freedom that nothing determines
};

/// What a suspect reading should have been.
struct Proposal {
    std::string id;
    bool in_radians = false;
    double estimate = 0, sigma = 0;  ///< from the other readings, in the reading's unit
    std::string slip;                ///< the slip of pen or key that would explain it, or empty
    double corrected = 0;            ///< with a slip: the value without it
    std::vector<std::string> alternatives;  ///< ids that would explain the misfit as well
};

}  // namespace culet
