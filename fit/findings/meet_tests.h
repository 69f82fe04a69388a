#pragma once
// Do planes that should meet in one point do so? Private to the room.
//
// Exact meets are tested by their multipliers (score test, Rao 1948): with N the planes' normals
// and U an orthonormal basis of null(N'), U' multipliers is what the readings pull the planes apart
// with, its covariance V follows from the fit, V^-1 is the covariance of the misses that would come
// out, and (V^-1 U' multipliers) is their estimate. Soft and released meets are tested by the
// misses that did come out (Wald 1943). The tests of exact meets together keep the level
// (Bonferroni); as long as one fails, the worst is let go and the others are tested given that
// (forward selection, exact in the linear model), so that one bad meet does not accuse its
// neighbours.

#include <vector>

#include "fit/findings/findings.h"
#include "fit/uncertainty/covariance.h"

namespace culet {

/// Meets of more than three facets, in the order of the mesh's vertices, then those that readings
/// ask for beyond the mesh. A meet that explains less than `least_chi2` is not accused: what one
/// wrong reading would explain, when a few wrong readings would do. Lengths in the scale of the
/// fit. Empty when there are too many (more than `k_most_tested` conditions).
std::vector<MeetFinding> test_meets(const FitModel& model, const Shape& shape,
                                    const Covariance& covariance, double significance,
                                    double least_chi2);

inline constexpr int k_most_tested = 1500;

}  // namespace culet
