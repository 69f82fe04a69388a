#pragma once
// The last stage of fits whose meets stay together: Gauss-Newton with hard constraints (Nocedal &
// Wright 2006, chapter 18) in the parameters. From a shape that is nearly right it reaches planes
// and symmetry that hold to rounding error.

#include "fit/solve/free_meets.h"
#include "fit/solve/relaxation.h"

namespace culet {

struct ActiveSetFit {
    Finished finished;
    /// Corners that the readings would lift above a neighbour facet; they are held 1e-7 below it.
    std::vector<ActiveCorner> held;
    /// Increase of chi-square by holding them.
    double cost_of_holding = 0;
    /// More corners would have to be held than the planes have parameters: no stone is near.
    bool is_no_stone = false;
};

struct ActiveSetOptions {
    int iterations = 100;
    /// Stop early, with corners above their neighbours, when chi-square exceeds this.
    double hopeless = 1e300;
    /// When continuing an earlier fit: below this chi-square the readings' active branches are
    /// taken to be unchanged, and no other signs are tried.
    double good_chi2 = 0;
};

ActiveSetFit fit_active_set(Relaxation& relaxation, const Shape& start,
                            const ActiveSetOptions& options);

}  // namespace culet
