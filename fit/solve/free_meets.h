#pragma once
// The last stage: Gauss-Newton with hard constraints (Nocedal & Wright 2006, chapter 18), from a
// shape that already is nearly right to planes that hold to rounding.

#include <memory>

#include "fit/model/fit_model.h"
#include "fit/solve/constants.h"

namespace culet {

struct Finished {
    Shape shape;
    std::shared_ptr<const Outline> outline;  ///< the corners at the end
    bool converged = false;
    bool enclosed = true;  ///< split meets: the planes enclose a solid
    int iterations = 0;
    double work = 0;  ///< multiplications of its factorisations, about; 0: not counted
    double chi2 = 0;
    double worst_hard = 0;  ///< what is left of the hard equations
};

/// `iterations` bounds the steps. Directions that no reading holds stay where they were.
Finished finish(const FitModel& model, const Shape& start, int iterations);

}  // namespace culet
