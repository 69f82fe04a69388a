#pragma once
// Restores readings that the fit left out to its result, with the value that they should have and
// the slip that explains them. Private to the room.

#include <vector>

#include "fit/findings/result.h"

namespace culet {

/// What a reading should have been. Adds the slip of the pen that would explain the value written,
/// if one does within the sigmas, and if these are at most `part_missed` of the error that it
/// explains.
Proposal proposal_for(const Reading& reading, double estimate, double sigma,
                      double part_missed = 1);

/// A reading as it was taken, without anything from the fit.
FittedReading as_taken(const Reading& reading);

/// Restores the azimuths of level facets to the result of a fit without them, marked as left out.
void put_left_out(const std::vector<Reading>& readings, const std::vector<std::size_t>& left_out,
                  FitResult& result);

/// A reading that was left out, with its proposal.
FittedReading left_out(const Reading& reading, const Proposal& proposal, const char* why);

/// Makes these the first suspects. The status becomes `contradictory` at best, and the message
/// begins with `told`.
void accuse(const std::vector<Proposal>& proposals, const std::string& told, FitResult& result);

/// Accuses a reading that the others contradict, with the value that they suggest. `result` comes
/// from a fit without it; the reading is listed all the same.
void flag_blunder(const Reading& wrong, double estimate, double sigma, FitResult& result);

}  // namespace culet
