#include <cmath>

#include "fit/solve/constrained_newton.h"

namespace culet {

namespace {

constexpr double k_rounding = 1e-14;

// Smallest steps onto the hard equations, until rounding is all that is left.
Shape onto_constraints(const Relaxation& relaxation, Shape shape,
                       const std::vector<ActiveCorner>& held) {
    StepLinearisation linearisation = relaxation.hard_linearisation(shape, held);
    const Eigen::VectorXd none = Eigen::VectorXd::Zero(relaxation.parameters().size());
    for (const double least : {KktSolver::k_least_variance, k_least_close}) {
        KktSolver solver;
        std::vector<ActiveCorner> factored;
        for (int i = 0; i < 10 && linearisation.hard_worst > k_met; ++i) {
            // After two steps the same factors do: what they miss is of second order in steps of
            // rounding size. Not where other corners bind than before, which have rows then.
            if (i < 2 || linearisation.holding != factored) {
                if (!solver.factor(linearisation.rows, relaxation.metric(), {}, least)) break;
                factored = linearisation.holding;
            }
            const auto s = solver.solve(none, -linearisation.rows.residuals());
            if (!s.good) break;
            const Shape next = relaxation.parameters().retracted(
                shape, {s.unknowns.data(), std::size_t(s.unknowns.size())});
            StepLinearisation there = relaxation.hard_linearisation(next, held);
            if (!there.finite || there.hard_worst >= linearisation.hard_worst) break;
            shape = next;
            linearisation = std::move(there);
        }
        if (linearisation.hard_worst < k_rounding) break;
    }
    return shape;
}

}  // namespace

void look_at_end(Relaxation& relaxation, const std::vector<ActiveCorner>& held,
                 LocalOptimum& optimum, std::shared_ptr<const Outline> outline) {
    PenaltyScale penalty;
    penalty.with_priors = false;
    relaxation.forget_contacts();
    relaxation.choose(optimum.shape, true, std::move(outline));
    optimum.chi2 = relaxation.linearisation(optimum.shape, penalty, held).chi2;
    optimum.worst_hard = relaxation.hard_linearisation(optimum.shape, {}).hard_worst;
}

void bring_to_meet(Relaxation& relaxation, const std::vector<ActiveCorner>& held,
                   LocalOptimum& optimum) {
    optimum.shape = onto_constraints(relaxation, std::move(optimum.shape), held);
    if (!held.empty() && relaxation.hard_linearisation(optimum.shape, {}).hard_worst > k_rounding) {
        // Corners held next to an edge of no length bind so tightly that meets give way. The meets
        // alone, from here, move less than what corners are held below.
        Shape met = onto_constraints(relaxation, optimum.shape, {});
        if (relaxation.is_convex(met)) optimum.shape = std::move(met);
    }
    look_at_end(relaxation, held, optimum);
}

}  // namespace culet
