#pragma once
// Which way facets lean. A reading of an inclination does not say whether a facet looks up or down:
// it has two meanings, and each has an optimum of its own.

#include <vector>

#include "fit/solve/kkt_solver.h"
#include "fit/solve/relaxation.h"

namespace culet {

/// By how much the merit changes when the readings of some facets are taken the other way follows
/// from the residuals r and the matrix R = 1 - J C J' of their redundancies (both in units of
/// sigma), exactly where equations are linear: 2 d'r + d'R d for shifts d of the values. One and
/// two facets at a time are turned over as long as that gains, then chains of them (Kernighan & Lin
/// 1970). Returns the shape moved to where the others are meant, of the `most` best such sets of
/// facets, the best first; none where none should be turned. Only facets within this sine of
/// upright are asked, and of them those whose entry in `sides` (none: of all) is 0. `solver` may
/// know the pattern of the equations from steps before.
std::vector<Shape> better_signs(Relaxation& relaxation, KktSolver& solver, const Shape& shape,
                                const PenaltyScale& penalty, double within, std::size_t most,
                                const std::vector<int>& sides = {});

}  // namespace culet
