#include "fit/solve/constants.h"
#include "fit/solve/constrained_newton.h"
#include "fit/solve/second_order_correction.h"

namespace culet {

namespace {

Shape onto_constraints(Relaxation& relaxation, Shape shape, const std::vector<ActiveCorner>& held,
                       double held_sigma) {
    PenaltyScale penalty;
    penalty.held = held_sigma;
    penalty.with_priors = penalty.with_hinges = false;
    double missed = relaxation.worst_hard(shape);
    for (const double least : {k_kkt.least_variance, k_kkt.least_variance_close}) {
        if (missed < k_newton.rounding) break;
        const StepLinearisation here = relaxation.linearisation(shape, penalty, held);
        KktSolver solver;
        if (!solver.factor(here.rows, relaxation.metric(), {}, least)) break;
        Shape next = onto_hard_equations(relaxation, solver, here, penalty, shape,
                                         {.most = 10, .met = k_newton.met, .precision = 1e-13})
                         .shape;
        const double missed_there = relaxation.worst_hard(next);
        if (!(missed_there < missed)) continue;
        shape = std::move(next);
        missed = missed_there;
    }
    return shape;
}

}  // namespace

void evaluate_minimum(Relaxation& relaxation, const std::vector<ActiveCorner>& held,
                      LocalOptimum& optimum, std::shared_ptr<const Outline> outline) {
    PenaltyScale penalty;
    penalty.with_priors = false;
    relaxation.forget_contacts();
    relaxation.select_branches(optimum.shape, true, std::move(outline));
    optimum.chi2 = relaxation.linearisation(optimum.shape, penalty, held).chi2;
    optimum.worst_hard = relaxation.worst_hard(optimum.shape);
}

void bring_to_meet(Relaxation& relaxation, const std::vector<ActiveCorner>& held,
                   LocalOptimum& optimum) {
    optimum.shape = onto_constraints(relaxation, std::move(optimum.shape), held, k_held.sigma);
    if (!held.empty() && relaxation.worst_hard(optimum.shape) > k_newton.rounding) {
        // Corners held next to a degenerate edge bind so tightly that meets give way.
        Shape met = onto_constraints(relaxation, optimum.shape, held, k_held.sigma_beside_meets);
        if (relaxation.is_convex(met)) optimum.shape = std::move(met);
    }
    evaluate_minimum(relaxation, held, optimum, optimum.outline);
}

}  // namespace culet
