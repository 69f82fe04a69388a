#pragma once
// Restores left-out readings to a result, with their estimated values and slips. Private to the
// room.

#include <vector>

#include "fit/findings/result.h"

namespace culet {

/// What a reading should have been, and the slip that explains the value written, if one does
/// within 3.5 sigmas and these are less than `part_missed` of the error.
Proposal proposal_for(const Reading& reading, double estimate, double sigma,
                      double part_missed = 1);

/// A reading as it was taken, without anything from the fit.
FittedReading as_taken(const Reading& reading);

/// Restores azimuths of level facets, marked as left out, to the result of a fit without them.
void mark_left_out(const std::vector<Reading>& readings, const std::vector<std::size_t>& left_out,
                   FitResult& result);

FittedReading left_out(const Reading& reading, const Proposal& proposal, const char* why);

/// Makes these the first suspects. The status becomes `contradictory` at best; the message begins
/// with `told`.
void accuse(const std::vector<Proposal>& proposals, const std::string& told, FitResult& result);

/// Accuses a reading that the others contradict, in the result of a fit without its weight.
void flag_blunder(const Reading& wrong, double estimate, double sigma, FitResult& result);

}  // namespace culet
