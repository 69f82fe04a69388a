#pragma once
// Gauss-Newton and Newton steps under hard constraints (Nocedal & Wright 2006, chapter 18) in the
// parameters, to the nearest local minimum. Private to the room.

#include <memory>
#include <vector>

#include "fit/solve/free_meets.h"
#include "fit/solve/kkt_solver.h"
#include "fit/solve/relaxation.h"

namespace culet {

/// `outline` is set only for a stone with split meets.
struct LocalOptimum : Finished {
    std::vector<SharedContact> shared_contacts;  ///< of the active branch at the minimum
};

struct NewtonOptions {
    int iterations = 100;
    /// Take the Lagrangian Hessian at the start, so that the first step may be Newton's.
    bool near_local_minimum = false;
    /// Let jaws share corners that are level at the start. Given up unless each carries a part of
    /// the load.
    bool contacts_shared = false;
    /// For a stone with split meets: the corners that the planes give at the start. They are found
    /// anew at each shape. Steps to planes that enclose no solid are rejected.
    std::shared_ptr<const Outline> outline{};
};

/// Null where the planes enclose no solid.
std::shared_ptr<const Outline> outline_of(const FitModel& model, const Shape& shape);

/// `held`: corners held below a facet. `solver` keeps its sparsity pattern from call to call. At
/// the result meets miss by less than any reading can tell.
LocalOptimum constrained_newton(Relaxation& relaxation, KktSolver& solver, const Shape& start,
                                const std::vector<ActiveCorner>& held,
                                const NewtonOptions& options);
/// Sets chi-square and the largest hard residual. `outline`: as in `Relaxation::select_branches`.
void evaluate_minimum(Relaxation& relaxation, const std::vector<ActiveCorner>& held,
                      LocalOptimum& optimum, std::shared_ptr<const Outline> outline = nullptr);
/// Moves the optimum onto the hard equations by minimum-norm steps, to rounding error.
void bring_to_meet(Relaxation& relaxation, const std::vector<ActiveCorner>& held,
                   LocalOptimum& optimum);

}  // namespace culet
