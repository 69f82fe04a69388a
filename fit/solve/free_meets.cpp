#include "fit/solve/free_meets.h"

#include "fit/solve/constrained_newton.h"

namespace culet {

Finished finish(const FitModel& model, const Shape& start, int iterations) {
    LocalOptimum end;
    end.shape = start;
    end.outline = outline_of(model, start);
    if (!end.outline) {
        end.outline = model.mesh_outline();
        end.enclosed = false;
        return end;
    }
    const Parameters parameters = model.parameters();
    Relaxation relaxation(model, parameters);
    KktSolver solver;
    end = constrained_newton(relaxation, solver, start, {},
                             {.iterations = iterations, .outline = std::move(end.outline)});
    bring_to_meet(relaxation, {}, end);
    std::shared_ptr<const Outline> outline = outline_of(model, end.shape);
    end.enclosed = outline != nullptr;
    if (outline) end.outline = std::move(outline);
    evaluate_minimum(relaxation, {}, end, end.outline);
    end.work = solver.work();
    return end;
}

}  // namespace culet
