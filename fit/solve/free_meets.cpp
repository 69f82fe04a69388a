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
// So many steps in a row that gain no more, at the end: this part of chi-square, a ten-thousandth
// of a sigma. Parameters that the readings all but leave open would creep for ever.
constexpr int k_quiet_steps = 2;
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
        const Linearised linear = linearise(system, shape, outline);
        const double worst = linear.worst_hard();
        if (worst < 1e-16 || worst > 0.5 * before) break;
        before = worst;
        KktSolver solver;
        if (!solver.factor(kkt_rows(linear, false), linear.metric)) break;
        const auto s = solver.solve(none(linear), right_side(linear, false));
        if (!s.good) break;
        const Shape next = retracted(shape, steps(s.unknowns));
        if (linearise(system, next, outline).worst_hard() >= worst) break;
        shape = next;
    }
    return shape;
}

std::shared_ptr<const Outline> outline_of(const System& system, const Shape& shape) {
    System::Enclosed enclosed = system.enclosed(shape);
    return enclosed.closed ? enclosed.outline : nullptr;
}

// Second-order correction: back onto the curved constraints with the same factors. Hard equations
// stand between points and planes, so the corners' outline does not matter.
Shape corrected(const System& system, Shape shape, const std::shared_ptr<const Outline>& outline,
                const KktSolver& solver) {
    double off_before = 1e300;
    for (int k = 0; k < 6; ++k) {
        const Linearised off = linearise(system, shape, outline);
        const double worst = off.worst_hard();
        if (worst < 1e-13 || !(worst < 0.7 * off_before)) break;
        off_before = worst;
        Eigen::VectorXd back = right_side(off, true);
        back.tail(off.soft_rows.rows()).setZero();
        shape = retracted(shape, steps(solver.solve(none(off), back).unknowns));
    }
    return shape;
}

// The hard equations first: their size is the size of what they leave undone.
double exact_penalty(const Linearised& linear) {
    return linear.merit() + 1e6 * linear.hard_residuals.lpNorm<1>();
}

// Damped Gauss-Newton steps (Levenberg and Marquardt's) under hard equations.
class DampedGaussNewton {
public:
    DampedGaussNewton(const System& system, Shape shape, std::shared_ptr<const Outline> outline)
        : system_(system),
          shape_(std::move(shape)),
          outline_(std::move(outline)),
          linear_(linearise(system, shape_, outline_)) {}

    const Shape& shape() const { return shape_; }
    const std::shared_ptr<const Outline>& outline() const { return outline_; }

    enum class State { goes_on, settled, failed };
    State step() {
        KktSolver solver;
        if (!solver.factor(kkt_rows(linear_, true), damping_ * linear_.metric))
            return State::failed;
        const auto s = solver.solve(none(linear_), right_side(linear_, true));
        if (!s.good) return State::failed;
        Eigen::VectorXd step = s.unknowns;
        const double length = step.cwiseAbs().maxCoeff();
        // Half a unit is half the stone's radius: no linearisation holds so far.
        if (length > 0.2) step *= 0.2 / length;
        if (accept(corrected(system_, retracted(shape_, steps(step)), outline_, solver), length)) {
            damping_ = std::max(k_least_damping, damping_ / 5);
            return quiet_ >= k_quiet_steps ? State::settled : State::goes_on;
        }
        // Nothing more to gain at the size of rounding.
        if (length < 1e-9) return State::settled;
        damping_ *= 10;
        // Widths pass from corner to corner with a kink; at its bottom no step is better.
        return damping_ > 1e8 ? State::settled : State::goes_on;
    }

private:
    // Goes to a shape that is no worse and encloses a stone; `length` is of the step to it.
    bool accept(Shape next, double length) {
        const std::shared_ptr<const Outline> next_outline = outline_of(system_, next);
        if (!next_outline) return false;
        Linearised there = linearise(system_, next, next_outline);
        const double before = exact_penalty(linear_), after = exact_penalty(there);
        if (!std::isfinite(after) || !(after <= before * (1 + 1e-12) + 1e-9)) return false;
        quiet_ = before - after < k_no_gain * (1 + before) || length < 1e-12 ? quiet_ + 1 : 0;
        shape_ = std::move(next);
        outline_ = next_outline;
        linear_ = std::move(there);
        return true;
    }

    const System& system_;
    Shape shape_;
    std::shared_ptr<const Outline> outline_;
    Linearised linear_;
    double damping_ = k_first_damping;
    int quiet_ = 0;
};

}  // namespace

Finished finish(const System& system, const Shape& start, int iterations) {
    Finished result;
    const std::shared_ptr<const Outline> first_outline = outline_of(system, start);
    if (!first_outline) {
        result.shape = start;
        result.outline = system.mesh_outline();
        result.enclosed = false;
        return result;
    }
    DampedGaussNewton search(system, start, first_outline);
    for (int i = 0; i < iterations; ++i) {
        result.iterations = i + 1;
        const DampedGaussNewton::State state = search.step();
        result.converged = state == DampedGaussNewton::State::settled;
        if (state != DampedGaussNewton::State::goes_on) break;
    }
    Shape shape = onto_constraints(system, search.shape(), search.outline(), 10);
    result.outline = outline_of(system, shape);
    if (!result.outline) {
        result.outline = search.outline();
        result.enclosed = false;
    }
    const Linearised linear = linearise(system, shape, result.outline);
    result.chi2 = linear.chi2();
    result.worst_hard = linear.worst_hard();
    result.shape = std::move(shape);
    return result;
}

}  // namespace culet
