#pragma once
// Gauss-Newton and Newton steps under hard constraints (Nocedal & Wright 2006, chapter 18) in the
// parameters, to the nearest end of one meaning of the readings. Private to the room.

#include <memory>
#include <vector>

#include "fit/solve/free_meets.h"
#include "fit/solve/kkt_solver.h"
#include "fit/solve/relaxation.h"

namespace culet {

/// Its `outline` is that of a stone whose meets come apart.
struct LocalOptimum : Finished {
    std::vector<SharedContact> shared_contacts;  ///< of the meaning that it is the end of
};

struct NewtonOptions {
    int iterations = 100;
    /// The equations bend as they do where the steps will end, so that the first step may already
    /// be Newton's.
    bool near_local_minimum = false;
    /// Likewise jaws rest on corners that are level: as long as all of them carry a part.
    bool contacts_shared = false;
    /// Of a stone whose meets come apart: the corners that the planes give at the start. They are
    /// found anew at each shape, and no step is taken to one whose planes enclose no solid.
    std::shared_ptr<const Outline> outline{};
};

/// The corners that the shape's planes give; nothing where they enclose no solid.
std::shared_ptr<const Outline> outline_of(const FitModel& model, const Shape& shape);

/// `held`: corners that stay below a facet. `solver` keeps its layout from call to call. What meets
/// misses by less than any reading could tell.
LocalOptimum constrained_newton(Relaxation& relaxation, KktSolver& solver, const Shape& start,
                                const std::vector<ActiveCorner>& held,
                                const NewtonOptions& options);
/// Fills in the chi-square of an end, and what is left of its hard equations. `outline`: as in
/// `Relaxation::choose`.
void look_at_end(Relaxation& relaxation, const std::vector<ActiveCorner>& held,
                 LocalOptimum& optimum, std::shared_ptr<const Outline> outline = nullptr);
/// Onto the hard equations by smallest steps, until rounding is all that is left.
void bring_to_meet(Relaxation& relaxation, const std::vector<ActiveCorner>& held,
                   LocalOptimum& optimum);

}  // namespace culet
