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

std::span<const double> steps(const Eigen::VectorXd& step) {
    return {step.data(), static_cast<std::size_t>(step.size())};
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
        const ConstrainedSolver solver(linear, 1, false);
        if (!solver.usable()) break;
        const Shape next =
            moved(shape, steps(solver.solve(Eigen::VectorXd::Zero(linear.layout.size()),
                                            -linear.hard_residuals)));
        if (linearise(system, next, outline, false).worst_hard() >= worst) break;
        shape = next;
    }
    return shape;
}

}  // namespace

Finished finish(const System& system, const Shape& start, int iterations) {
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
    Linearised linear = linearise(system, shape, outline, !splits);
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
        // Second-order correction: back onto the curved constraints with the same factors.
        const std::shared_ptr<const Outline> first_outline = outline_of(next);
        if (first_outline) {
            const Linearised off = linearise(system, next, first_outline, false);
            if (off.hard_residuals.size() > 0) {
                next = moved(next, steps(solver.solve(Eigen::VectorXd::Zero(linear.layout.size()),
                                                      -off.hard_residuals)));
            }
        }
        const std::shared_ptr<const Outline> next_outline = outline_of(next);
        bool better = false;
        if (next_outline) {
            Linearised there = linearise(system, next, next_outline, !splits);
            // The hard equations first: their size is the size of what they leave undone.
            const double hard_before = linear.hard_residuals.lpNorm<1>(),
                         hard_after = there.hard_residuals.lpNorm<1>();
            const double merit_before = linear.merit() + 1e6 * hard_before,
                         merit_after = there.merit() + 1e6 * hard_after;
            better = std::isfinite(merit_after) && merit_after <= merit_before * (1 + 1e-12) + 1e-9;
            if (better) {
                const double gain = merit_before - merit_after;
                quiet = gain < 1e-10 * (1 + merit_before) || length < 1e-12 ? quiet + 1 : 0;
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
                // Corners that change places make a kink; at its bottom no step is better.
                result.converged = splits;
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
