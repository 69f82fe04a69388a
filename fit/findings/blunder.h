#pragma once
// A wrong reading's name, what it should have been, and the slip that explains it. Private to the
// room.

#include <vector>

#include "fit/findings/result.h"

namespace culet {

/// By how much a reading and an estimate of it may well differ: in the reading's unit.
double slip_tolerance(const Reading& reading, double sigma_of_estimate);

/// Adds the slip that would turn the proposal's estimate into the reading, where one does.
void explain_by_slip(const Reading& reading, Proposal& proposal);

/// A reading that cannot belong to the others, and what they say that it should be.
struct Blunder {
    std::size_t reading = 0;
    double estimate = 0, sigma = 0;
};

/// Names them as suspects before all others, with what they should be and the slip that would
/// explain it. The status is `contradictory` at best. The result is of a fit that does without them
/// and lists them all the same.
void flag_blunders(const std::vector<Reading>& readings, const std::vector<Blunder>& blunders,
                   FitResult& result);

}  // namespace culet
