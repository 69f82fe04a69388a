#include "fit/solve/free_meets.h"

#include <algorithm>
#include <cmath>

#include "fit/model/linear.h"
#include "fit/solve/kkt_solver.h"

namespace culet {

namespace {

// Parameters that the readings hold to better than the mesh does are moved by all but this part of
// their way in each step; those that no reading holds do not move.
constexpr double k_first_damping = 1e-2;
constexpr double k_least_damping = 1e-6;
// Steps in a row that gain no more, at the end: this part of chi-square, a ten-thousandth of a
// sigma. Parameters that the readings all but leave open would creep for ever.
constexpr double k_no_gain = 1e-8;

std::span<const double> steps(const Eigen::VectorXd& step) {
    return {step.data(), static_cast<std::size_t>(step.size())};
}

Eigen::VectorXd none(const Linearised& linear) {
    return Eigen::VectorXd::Zero(linear.layout.size());
}

// What a step is to take off the rows of `kkt_rows`.
Eigen::VectorXd right_side(const Linearised& linear, bool with_soft) {
    Eigen::VectorXd right = Eigen::VectorXd::Zero(kkt_row_count(linear, with_soft));
    right.head(linear.hard_rows.rows()) = -linear.hard_residuals;
    if (with_soft) right.tail(linear.soft_rows.rows()) = -linear.soft_residuals;
    return right;
}

// Smallest steps onto the hard equations, until rounding is all that is left.
Shape onto_constraints(const System& system, Shape shape,
                       const std::shared_ptr<const Outline>& outline, int rounds) {
    double before = 1e300;
    for (int i = 0; i < rounds; ++i) {
        const Linearised linear = linearise(system, shape, outline, false);
        const double worst = linear.worst_hard();
        if (worst < 1e-16 || worst > 0.5 * before) break;
        before = worst;
        KktSolver solver;
        if (!solver.factor(kkt_rows(linear, false), linear.metric)) break;
        const auto s = solver.solve(none(linear), right_side(linear, false));
        if (!s.good) break;
        const Shape next = retracted(shape, steps(s.unknowns));
        if (linearise(system, next, outline, false).worst_hard() >= worst) break;
        shape = next;
    }
    return shape;
}

}  // namespace

Finished finish(const System& system, const Shape& start, int iterations) {
    Finished result;
    const auto outline_of = [&](const Shape& shape) -> std::shared_ptr<const Outline> {
        System::Enclosed enclosed = system.enclosed(shape);
        return enclosed.closed ? enclosed.outline : nullptr;
    };
    Shape shape = start;
    std::shared_ptr<const Outline> outline = outline_of(shape);
    if (!outline) {
        result.shape = start;
        result.outline = system.mesh_outline();
        result.enclosed = false;
        return result;
    }
    Linearised linear = linearise(system, shape, outline, false);
    double damping = k_first_damping;
    int quiet = 0;
    for (int i = 0; i < iterations; ++i) {
        result.iterations = i + 1;
        KktSolver solver;
        if (!solver.factor(kkt_rows(linear, true), damping * linear.metric)) break;
        const auto s = solver.solve(none(linear), right_side(linear, true));
        if (!s.good) break;
        Eigen::VectorXd step = s.unknowns;
        const double length = step.cwiseAbs().maxCoeff();
        // Half a unit is half the stone's radius: no linearisation holds so far.
        if (length > 0.2) step *= 0.2 / length;

        Shape next = retracted(shape, steps(step));
        // Second-order correction: back onto the curved constraints with the same factors. Hard
        // equations stand between points and planes, so the corners' outline does not matter.
        double off_before = 1e300;
        for (int k = 0; k < 6; ++k) {
            const Linearised off = linearise(system, next, outline, false);
            const double worst = off.worst_hard();
            if (worst < 1e-13 || !(worst < 0.7 * off_before)) break;
            off_before = worst;
            Eigen::VectorXd back = right_side(off, true);
            back.tail(off.soft_rows.rows()).setZero();
            next = retracted(next, steps(solver.solve(none(linear), back).unknowns));
        }
        const std::shared_ptr<const Outline> next_outline = outline_of(next);
        bool better = false;
        if (next_outline) {
            Linearised there = linearise(system, next, next_outline, false);
            // The hard equations first: their size is the size of what they leave undone.
            const double hard_before = linear.hard_residuals.lpNorm<1>(),
                         hard_after = there.hard_residuals.lpNorm<1>();
            const double merit_before = linear.merit() + 1e6 * hard_before,
                         merit_after = there.merit() + 1e6 * hard_after;
            better = std::isfinite(merit_after) && merit_after <= merit_before * (1 + 1e-12) + 1e-9;
            if (better) {
                const double gain = merit_before - merit_after;
                quiet = gain < k_no_gain * (1 + merit_before) || length < 1e-12 ? quiet + 1 : 0;
                shape = next;
                outline = next_outline;
                linear = std::move(there);
                damping = std::max(k_least_damping, damping / 5);
            }
        }
        if (!better) {
            // Nothing more to gain at the size of rounding.
            if (length < 1e-9) {
                result.converged = true;
                break;
            }
            damping *= 10;
            if (damping > 1e8) {
                // Widths pass from corner to corner with a kink; at its bottom no step is better.
                result.converged = true;
                break;
            }
        }
        if (quiet >= 2) {
            result.converged = true;
            break;
        }
    }
    shape = onto_constraints(system, std::move(shape), outline, 10);
    result.outline = outline_of(shape);
    if (!result.outline) {
        result.outline = outline;
        result.enclosed = false;
    }
    linear = linearise(system, shape, result.outline, false);
    result.chi2 = linear.chi2();
    result.worst_hard = linear.worst_hard();
    result.shape = std::move(shape);
    return result;
}

}  // namespace culet
