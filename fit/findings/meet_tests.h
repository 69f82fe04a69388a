#pragma once
// Tests whether planes that should meet in one point do. Private to the room.
//
// Exact meets are tested by their Lagrange multipliers (score test, Rao 1948): with N the planes'
// normals, U an orthonormal basis of null(N'), m = U' multipliers and V its covariance, V^-1 m
// estimates the misses of the released planes, with covariance V^-1. Soft and released meets are
// tested by their actual misses (Wald 1943).
// The exact meets' tests together keep the significance level (Bonferroni). While one fails, the
// worst is released and the others are tested again (forward selection, exact in the linear model),
// so that it does not accuse its neighbours.

#include <vector>

#include "fit/findings/findings.h"
#include "fit/uncertainty/covariance.h"

namespace culet {

/// Tests the meets of more than three facets: those of the mesh in vertex order, then those that
/// readings add. A meet that explains less than `least_chi2` is not accused: one of a few wrong
/// readings would explain as much. Lengths are in the scale of the fit. Empty above `k_most_tested`
/// conditions.
std::vector<MeetFinding> test_meets(const FitModel& model, const Shape& shape,
                                    const Covariance& covariance, double significance,
                                    double least_chi2);

inline constexpr int k_most_tested = 1500;

}  // namespace culet
