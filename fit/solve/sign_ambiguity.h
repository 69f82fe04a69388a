#pragma once
// Decides which way facets lean. A reading of an inclination does not say whether a facet looks up
// or down. Each choice of sign has a local minimum of its own.

#include <vector>

#include "fit/solve/kkt_solver.h"
#include "fit/solve/relaxation.h"

namespace culet {

/// Turns facets over where that lowers the merit. The change of the merit follows from the
/// residuals r and the redundancy matrix R = 1 - J C J' (both in units of sigma): 2 d'r + d'R d for
/// shifts d of the values, exact for linear equations.
///
/// Returns the shapes predicted for the `most` best sets of facets, the best first; none where no
/// turn gains. Considers facets within this sine of upright whose entry in `sides` is 0 (empty:
/// all). `solver` may keep the sparsity pattern of earlier steps.
std::vector<Shape> better_signs(Relaxation& relaxation, KktSolver& solver, const Shape& shape,
                                const PenaltyScale& penalty, double within, std::size_t most,
                                const std::vector<int>& sides = {});

}  // namespace culet
