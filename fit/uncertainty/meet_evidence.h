#pragma once
// Whether the planes of a stone meet, and by how much they miss, where a prior fills in what few
// readings leave open. Private to the room.

#include <optional>

#include "fit/model/fit_model.h"
#include "fit/model/options.h"
#include "fit/solve/free_meets.h"

namespace culet {

struct MeetEvidence {
    bool exact = false;  ///< the readings are likelier of a stone whose planes meet
    Finished finished;   ///< else the fit of the model, whose group sigmas are set
};

/// `model` has soft meets and a prior; `at` is an end of the same fit with exact meets. One sigma
/// of all meets is taken: the largest that the readings allow, by their likelihood in the linear
/// model (marginal likelihood; the nuisance parameters integrated out, Patterson & Thompson 1971).
/// Nothing where the equations tell nothing.
std::optional<MeetEvidence> weigh_meets(FitModel& model, const Finished& at,
                                        const FitOptions& options);

}  // namespace culet
