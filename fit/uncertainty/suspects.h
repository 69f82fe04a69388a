#pragma once
// Which readings of a fit look wrong. Private to the room: shows Eigen.

#include "fit/uncertainty/diagnostics.h"

namespace culet {

/// Baarda's data snooping (snooping.h), and where chi-square fails an irreducible set of readings
/// that disagrees. Fills `suspects`, `suspicions` and `disagreeing` of a diagnosis
/// that holds its covariance, chi-square and limit.
void find_suspects(const FitModel& model, double significance, Diagnosis& diagnosis);

}  // namespace culet
