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

/// A reading that takes no part and should have been what the proposal says.
FittedReading left_out(const Reading& reading, const Proposal& proposal, const char* why);

/// Makes them the first suspects: the status is `contradictory` at best, and `told` begins the
/// message.
void accuse(const std::vector<Proposal>& proposals, const std::string& told, FitResult& result);

/// A reading that cannot belong to the others, and what they say that it should be.
struct Blunder {
    std::size_t reading = 0;
    double estimate = 0, sigma = 0;
};

/// Accuses them. The result is of a fit that does without them and lists them all the same.
void flag_blunders(const std::vector<Reading>& readings, const std::vector<Blunder>& blunders,
                   FitResult& result);

}  // namespace culet
