#pragma once
// Edges and facets that the readings deny or leave open. Private to the room.

#include <string>
#include <vector>

#include "fit/findings/result.h"
#include "fit/solve/active_set.h"
#include "fit/solve/free_meets.h"
#include "fit/uncertainty/covariance.h"
#include "fit/uncertainty/diagnostics.h"

namespace culet {

/// `holding`: with the held corners as hard equations. Vanishing edges come from corners held below
/// a neighbour facet, by the force with which the readings pull at them (as in `meet_tests.h`);
/// open ones from lengths and areas less than twice their standard uncertainty. `result` holds what
/// keeping the edges costs, and gets their names.
std::vector<ShapeFinding> find_open_shape(const FitModel& model, const Finished& finished,
                                          const std::vector<ActiveCorner>& held,
                                          const Diagnosis& diagnosis, const Covariance& holding,
                                          FitResult& result);

/// The readings deny that the edges that are kept have a length at all: chi-square, with one
/// freedom for each.
bool are_edges_denied(const FitResult& result);

}  // namespace culet
