#pragma once
// Second-order correction (Nocedal & Wright 2006, 18.3): a step along the tangents of hard
// equations violates them by its square. The step's own factors correct that. Private to the room.

#include "fit/solve/kkt_solver.h"
#include "fit/solve/relaxation.h"

namespace culet {

struct Correction {
    int most = 4;             ///< number of correction steps
    double met = 0;           ///< stop when hard equations miss by less
    double precision = 1e-3;  ///< relative, of each step; the next one corrects what it leaves
};

/// `linearisation`: whose rows `solver` has factored. Corrects readings sharper than rounding, too.
/// Returns the shape after the last step that halved the residual. `stalls`: the factors no longer
/// reduce it.
struct Corrected {
    Shape shape;
    bool stalls = false;
};
Corrected onto_hard_equations(const Relaxation& relaxation, const KktSolver& solver,
                              const StepLinearisation& linearisation, const PenaltyScale& penalty,
                              Shape shape, const Correction& correction);

}  // namespace culet
