#include "fit/solve/free_meets.h"

#include "fit/solve/constrained_newton.h"

namespace culet {

Finished finish(const System& system, const Shape& start, int iterations) {
    LocalOptimum end;
    end.shape = start;
    end.outline = outline_of(system, start);
    if (!end.outline) {
        end.outline = system.mesh_outline();
        end.enclosed = false;
        return end;
    }
    const Parameters parameters = system.parameters();
    Relaxation relaxation(system, parameters);
    KktSolver solver;
    end = constrained_newton(relaxation, solver, start, {},
                             {.iterations = iterations, .outline = std::move(end.outline)});
    bring_to_meet(relaxation, {}, end);
    std::shared_ptr<const Outline> outline = outline_of(system, end.shape);
    end.enclosed = outline != nullptr;
    if (outline) end.outline = std::move(outline);
    look_at_end(relaxation, {}, end, end.outline);
    end.work = solver.work();
    return end;
}

}  // namespace culet
