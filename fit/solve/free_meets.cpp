#include "fit/solve/free_meets.h"

#include "fit/solve/constrained_newton.h"

namespace culet {

Finished finish(const System& system, const Shape& start, int iterations) {
    Finished result;
    result.shape = start;
    result.outline = outline_of(system, start);
    if (!result.outline) {
        result.outline = system.mesh_outline();
        result.enclosed = false;
        return result;
    }
    const Parameters parameters = system.parameters();
    Relaxation relaxation(system, parameters);
    KktSolver solver;
    LocalOptimum end =
        constrained_newton(relaxation, solver, start, {},
                           {.iterations = iterations, .outline = std::move(result.outline)});
    bring_to_meet(relaxation, {}, end);
    if (auto outline = outline_of(system, end.shape)) {
        end.outline = std::move(outline);
    } else {
        result.enclosed = false;
    }
    look_at_end(relaxation, {}, end, end.outline);
    result.shape = std::move(end.shape);
    result.outline = std::move(end.outline);
    result.converged = end.converged;
    result.iterations = end.iterations;
    result.work = solver.work();
    result.chi2 = end.chi2;
    result.worst_hard = end.worst_hard;
    return result;
}

}  // namespace culet
