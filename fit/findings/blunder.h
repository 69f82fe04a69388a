#pragma once
// Readings that the fit does without: listed all the same, with what they should have been and the
// slip that explains them. Private to the room.

#include <vector>

#include "fit/findings/result.h"

namespace culet {

/// What a reading should have been, and the slip that would turn that into what was written, where
/// one does to within the sigmas, and these are no more than `part_missed` of what it explains.
Proposal proposal_for(const Reading& reading, double estimate, double sigma,
                      double part_missed = 1);

/// A reading as it was taken; what the fit makes of it is still open.
FittedReading as_taken(const Reading& reading);

/// The result of a fit without azimuths of level facets, with these in their places again, marked
/// as left out.
void put_left_out(const std::vector<Reading>& readings, const std::vector<std::size_t>& left_out,
                  FitResult& result);

/// A reading that takes no part and should have been what the proposal says.
FittedReading left_out(const Reading& reading, const Proposal& proposal, const char* why);

/// Makes them the first suspects: the status is `contradictory` at best, and `told` begins the
/// message.
void accuse(const std::vector<Proposal>& proposals, const std::string& told, FitResult& result);

/// Accuses one that cannot belong to the others, who say what it should be. The result is of a fit
/// that does without it and lists it all the same.
void flag_blunder(const Reading& wrong, double estimate, double sigma, FitResult& result);

}  // namespace culet
