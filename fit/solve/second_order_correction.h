#pragma once
// Second-order correction (Nocedal & Wright 2006, 18.3): a step along the tangents of hard
// equations leaves them by its square; the factors of the step lead back. Private to the room.

#include "fit/solve/kkt_solver.h"
#include "fit/solve/relaxation.h"

namespace culet {

struct Correction {
    int most = 4;             ///< steps
    double met = 0;           ///< hard equations that miss by less are met
    double precision = 1e-3;  ///< of each step: what it leaves, the next one takes
};

/// `linearisation`: whose rows `solver` has factored; readings sharper than rounding are corrected
/// too. Returns the shape after the last step that halved what was missed, and whether the factors
/// lead there no more.
struct Corrected {
    Shape shape;
    bool stalls = false;
};
Corrected onto_hard_equations(const Relaxation& relaxation, const KktSolver& solver,
                              const StepLinearisation& linearisation, const PenaltyScale& penalty,
                              Shape shape, const Correction& correction);

}  // namespace culet
