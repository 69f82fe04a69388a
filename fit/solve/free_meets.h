#pragma once
// The last stage for meets that may come apart: Gauss-Newton with hard constraints (Nocedal &
// Wright 2006, chapter 18), from a shape that is nearly right to planes that hold to rounding
// error.

#include <memory>

#include "fit/model/fit_model.h"
#include "fit/solve/constants.h"

namespace culet {

struct Finished {
    Shape shape;
    std::shared_ptr<const Outline> outline;  ///< the corners at the end
    bool converged = false;
    bool enclosed = true;  ///< of split meets: the planes enclose a solid
    int iterations = 0;
    double work = 0;  ///< of its factorisations, in multiplications (estimate); 0: not counted
    double chi2 = 0;
    double worst_hard = 0;  ///< largest residual of the hard equations
};

/// Takes at most `iterations` steps. Unobservable directions stay where they were.
Finished finish(const FitModel& model, const Shape& start, int iterations);

}  // namespace culet
