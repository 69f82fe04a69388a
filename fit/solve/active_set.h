#pragma once
// The last stage where no meet comes apart: Gauss-Newton with hard constraints (Nocedal & Wright
// 2006, chapter 18) in the parameters, from a shape that already is nearly right to planes and
// symmetry that hold to rounding.

#include "fit/solve/free_meets.h"
#include "fit/solve/relaxation.h"

namespace culet {

struct ActiveSetFit {
    Finished finished;
    /// Corners that the readings want above a neighbour facet, held a hair below it.
    std::vector<ActiveCorner> held;
    /// By how much holding them made chi-square larger.
    double cost_of_holding = 0;
    /// More corners would have to be held than so few planes can keep: nothing like a stone.
    bool is_no_stone = false;
};

struct ActiveSetOptions {
    int iterations = 100;
    /// Ends early, with corners above their neighbours, where chi-square is larger.
    double hopeless = 1e300;
    /// From the end of an earlier fit, the chi-square below which readings that changed a little
    /// have not changed their meaning: no other turns and signs are then looked for.
    double agreeable = 0;
};

ActiveSetFit fit_active_set(Relaxation& relaxation, const Shape& start,
                            const ActiveSetOptions& options);

}  // namespace culet
