#include "fit/finish.h"

#include <algorithm>
#include <cmath>

#include "fit/linear.h"

namespace culet {

namespace {

// Freedoms that the readings hold to better than the mesh does are moved by all but this part of
// their way in each step; those that no reading holds do not move.
constexpr double k_first_damping = 1e-2;
constexpr double k_least_damping = 1e-6;
// Corners that want to stand above a neighbour facet are held this far below it, in half diameters:
// far above rounding, far below anything one could measure.
constexpr double k_hold_below = 1e-7;
// Steps in a row that gain no more, at the end: this part of chi-square, a ten-thousandth of a
// sigma. Freedoms that the readings all but leave open would creep for ever.
constexpr double k_no_gain = 1e-8;

std::span<const double> steps(const Eigen::VectorXd& step) {
    return {step.data(), static_cast<std::size_t>(step.size())};
}

// Smallest steps onto the hard equations, until rounding is all that is left.
Shape onto_constraints(const System& system, Shape shape,
                       const std::shared_ptr<const Outline>& outline,
                       const std::vector<Equation>& held, int rounds) {
    double before = 1e300;
    for (int i = 0; i < rounds; ++i) {
        const Linearised linear = linearise(system, shape, outline, false, held);
        const double worst = linear.worst_hard();
        if (worst < 1e-16 || worst > 0.5 * before) break;
        before = worst;
        const ConstrainedSolver solver(linear, 1, false);
        if (!solver.usable()) break;
        const Shape next =
            moved(shape, steps(solver.solve(Eigen::VectorXd::Zero(linear.layout.size()),
                                            -linear.hard_residuals)));
        if (linearise(system, next, outline, false, held).worst_hard() >= worst) break;
        shape = next;
    }
    return shape;
}

// Gauss-Newton under the system's hard equations and `held` ones.
Finished settle(const System& system, const Shape& start, const std::vector<Equation>& held,
                int iterations) {
    Finished result;
    const bool splits = system.splits();
    const auto outline_of = [&](const Shape& shape) -> std::shared_ptr<const Outline> {
        if (!splits) return system.mesh_outline();
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
    Linearised linear = linearise(system, shape, outline, !splits, held);
    double damping = k_first_damping;
    int quiet = 0;
    for (int i = 0; i < iterations; ++i) {
        result.iterations = i + 1;
        const ConstrainedSolver solver(linear, damping);
        if (!solver.usable()) break;
        const Eigen::VectorXd gradient = linear.soft_rows.transpose() * linear.soft_residuals;
        Eigen::VectorXd step = solver.solve(-gradient, -linear.hard_residuals);
        const double length = step.cwiseAbs().maxCoeff();
        // Half a unit is half the stone's radius: no linearisation holds so far.
        if (length > 0.2) step *= 0.2 / length;

        Shape next = moved(shape, steps(step));
        // Second-order correction: back onto the curved constraints with the same factors. Hard
        // equations stand between points and planes, so the corners' outline does not matter.
        double off_before = 1e300;
        for (int k = 0; k < 6; ++k) {
            const Linearised off = linearise(system, next, outline, false, held);
            const double worst = off.worst_hard();
            if (worst < 1e-13 || !(worst < 0.7 * off_before)) break;
            off_before = worst;
            next = moved(next, steps(solver.solve(Eigen::VectorXd::Zero(linear.layout.size()),
                                                  -off.hard_residuals)));
        }
        const std::shared_ptr<const Outline> next_outline = outline_of(next);
        bool better = false;
        if (next_outline) {
            Linearised there = linearise(system, next, next_outline, !splits, held);
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
    shape = onto_constraints(system, std::move(shape), outline, held, 10);
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

}  // namespace

Finished finish(const System& system, const Shape& start, int iterations) {
    std::vector<Equation> held;
    Finished result = settle(system, start, held, iterations);
    if (system.splits()) return result;
    // Penalties let corners stand a hair above their neighbours. Those are held just below from now
    // on: an active set that only grows, since a corner that readings push out will be pushed
    // again.
    for (int round = 0; round < 8; ++round) {
        const std::size_t before = held.size();
        for (Equation& e : system.hinges()) {
            if (!(e.formula(result.shape).value > 0)) continue;
            e.role = Equation::Role::relation;
            e.exact = true;
            e.value = -k_hold_below;
            held.push_back(std::move(e));
        }
        if (held.size() == before) break;
        const int steps = result.iterations;
        result = settle(system, result.shape, held, iterations);
        result.iterations += steps;
    }
    return result;
}

}  // namespace culet
