#pragma once
// Edges and facets that the readings contradict or leave open. Private to the room.

#include <string>
#include <vector>

#include "fit/findings/result.h"
#include "fit/solve/active_set.h"
#include "fit/solve/free_meets.h"
#include "fit/uncertainty/covariance.h"
#include "fit/uncertainty/diagnostics.h"

namespace culet {

/// Vanishing edges come from corners held below a neighbour facet, by their multipliers
/// (meet_tests.h); open ones from lengths and areas below twice their sigma. `holding` is the
/// covariance with held corners as hard equations. `result` has the chi-square that keeping the
/// edges costs, and receives their names.
std::vector<ShapeFinding> find_open_shape(const FitModel& model, const Finished& finished,
                                          const std::vector<ActiveCorner>& held,
                                          const Diagnosis& diagnosis, const Covariance& holding,
                                          FitResult& result);

/// True if chi-square, one degree of freedom for each kept edge, rejects that they have a length.
bool are_edges_denied(const FitResult& result);

}  // namespace culet
