#include "fit/solve/free_meets.h"

#include <algorithm>
#include <cmath>

#include "fit/solve/constrained_newton.h"
#include "fit/solve/second_order_correction.h"

namespace culet {

namespace {

// Parameters that the readings hold to better than the mesh does are moved by all but this part of
// their way in each step; those that no reading holds do not move.
constexpr double k_meets_damping = 1e-2;
constexpr double k_meets_least_damping = 1e-6;
// So many steps in a row that gain no more, at the end: this part of chi-square, a ten-thousandth
// of a sigma. Parameters that the readings all but leave open would creep for ever.
constexpr int k_quiet_steps = 2;
constexpr double k_meets_no_gain = 1e-8;
// Half a unit is half the stone's radius: no linearisation holds so far.
constexpr double k_meets_longest = 0.2;
constexpr Correction k_correction{.most = 6, .met = 1e-13, .precision = 1e-13};

std::shared_ptr<const Outline> outline_of(const System& system, const Shape& shape) {
    System::Enclosed enclosed = system.enclosed(shape);
    return enclosed.closed ? enclosed.outline : nullptr;
}

// The hard equations first: their size is the size of what they leave undone.
double exact_penalty(const StepLinearisation& linearisation) {
    return linearisation.merit + 1e6 * linearisation.hard_sum;
}

// Damped Gauss-Newton steps (Levenberg and Marquardt's) under hard equations. Corners are where the
// planes meet, and the readings' equations those of the corners at each shape.
class DampedGaussNewton {
public:
    DampedGaussNewton(Relaxation& relaxation, Shape shape, std::shared_ptr<const Outline> outline)
        : relaxation_(relaxation),
          metric_(relaxation.metric()),
          shape_(std::move(shape)),
          outline_(std::move(outline)) {
        penalty_.with_priors = penalty_.with_hinges = false;
        here_ = linearised(shape_, outline_);
    }

    const Shape& shape() const { return shape_; }
    const std::shared_ptr<const Outline>& outline() const { return outline_; }

    enum class State { goes_on, settled, failed };
    State step() {
        if (!solver_.factor(here_.rows, damping_ * metric_)) return State::failed;
        const auto s =
            solver_.solve(Eigen::VectorXd::Zero(metric_.size()), -here_.rows.residuals());
        if (!s.good) return State::failed;
        Eigen::VectorXd step = s.unknowns;
        const double length = step.cwiseAbs().maxCoeff();
        if (length > k_meets_longest) step *= k_meets_longest / length;
        Shape next = relaxation_.parameters().retracted(
            shape_, {step.data(), static_cast<std::size_t>(step.size())});
        next = onto_hard_equations(relaxation_, solver_, here_, penalty_, std::move(next),
                                   k_correction)
                   .shape;
        if (accept(std::move(next), length)) {
            damping_ = std::max(k_meets_least_damping, damping_ / 5);
            return quiet_ >= k_quiet_steps ? State::settled : State::goes_on;
        }
        choose(shape_, outline_);
        // Nothing more to gain at the size of rounding.
        if (length < 1e-9) return State::settled;
        damping_ *= 10;
        // Widths pass from corner to corner with a kink; at its bottom no step is better.
        return damping_ > 1e8 ? State::settled : State::goes_on;
    }

private:
    void choose(const Shape& shape, const std::shared_ptr<const Outline>& outline) {
        relaxation_.forget_contacts();
        relaxation_.choose(shape, true, outline);
    }
    StepLinearisation linearised(const Shape& shape,
                                 const std::shared_ptr<const Outline>& outline) {
        choose(shape, outline);
        return relaxation_.linearisation(shape, penalty_);
    }

    // Goes to a shape that is no worse and encloses a stone; `length` is of the step to it.
    bool accept(Shape next, double length) {
        const std::shared_ptr<const Outline> next_outline = outline_of(relaxation_.system(), next);
        if (!next_outline) return false;
        StepLinearisation there = linearised(next, next_outline);
        const double before = exact_penalty(here_), after = exact_penalty(there);
        if (!std::isfinite(after) || !(after <= before * (1 + 1e-12) + 1e-9)) return false;
        quiet_ = before - after < k_meets_no_gain * (1 + before) || length < 1e-12 ? quiet_ + 1 : 0;
        shape_ = std::move(next);
        outline_ = next_outline;
        here_ = std::move(there);
        return true;
    }

    Relaxation& relaxation_;
    KktSolver solver_;
    const Eigen::VectorXd metric_;
    PenaltyScale penalty_;
    Shape shape_;
    std::shared_ptr<const Outline> outline_;
    StepLinearisation here_;
    double damping_ = k_meets_damping;
    int quiet_ = 0;
};

}  // namespace

Finished finish(const System& system, const Shape& start, int iterations) {
    Finished result;
    std::shared_ptr<const Outline> outline = outline_of(system, start);
    if (!outline) {
        result.shape = start;
        result.outline = system.mesh_outline();
        result.enclosed = false;
        return result;
    }
    const Parameters parameters = system.parameters();
    Relaxation relaxation(system, parameters);
    DampedGaussNewton search(relaxation, start, std::move(outline));
    for (int i = 0; i < iterations; ++i) {
        result.iterations = i + 1;
        const DampedGaussNewton::State state = search.step();
        result.converged = state == DampedGaussNewton::State::settled;
        if (state != DampedGaussNewton::State::goes_on) break;
    }
    LocalOptimum end;
    end.shape = search.shape();
    relaxation.choose(end.shape, true, search.outline());
    bring_to_meet(relaxation, {}, end);
    result.outline = outline_of(system, end.shape);
    if (!result.outline) {
        result.outline = search.outline();
        result.enclosed = false;
    }
    look_at_end(relaxation, {}, end, result.outline);
    result.chi2 = end.chi2;
    result.worst_hard = end.worst_hard;
    result.shape = std::move(end.shape);
    return result;
}

}  // namespace culet
