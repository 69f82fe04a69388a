#pragma once
// Finds the readings of a fit that look wrong. Private to the room: shows Eigen.

#include "fit/uncertainty/diagnostics.h"

namespace culet {

/// Data snooping (snooping.h), and an irreducible inconsistent set if chi-square fails. Fills in
/// `suspects`, `suspicions` and `disagreeing` of an otherwise complete diagnosis.
void find_suspects(const FitModel& model, double significance, Diagnosis& diagnosis);

}  // namespace culet
