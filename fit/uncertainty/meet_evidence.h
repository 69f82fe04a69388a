#pragma once
// Estimates whether planes meet, and how far they miss, when a prior fills in for few readings.
// Private to the room.

#include <optional>

#include "fit/model/fit_model.h"
#include "fit/model/options.h"
#include "fit/solve/free_meets.h"

namespace culet {

struct MeetEvidence {
    bool exact = false;  ///< the readings are likelier for a stone whose planes meet
    Finished finished;   ///< if not exact: the fit with the model's new group sigmas
};

/// `model` has soft meets and a prior; `at` is a local minimum with exact meets. All meets get one
/// sigma: the largest that the readings allow, by their marginal likelihood in the linear model
/// (Patterson & Thompson 1971). Nothing if the equations do not determine it.
std::optional<MeetEvidence> weigh_meets(FitModel& model, const Finished& at,
                                        const FitOptions& options);

}  // namespace culet
