#include "fit/solve/constrained_newton.h"

#include <algorithm>
#include <cmath>

#include "fit/model/enclosed.h"
#include "fit/solve/constants.h"
#include "fit/solve/second_order_correction.h"

namespace culet {

namespace {

std::span<const double> steps(const Eigen::VectorXd& step) {
    return {step.data(), static_cast<std::size_t>(step.size())};
}

// Precision of a step. The next step corrects what this one leaves, and hard equations are met to
// rounding at the end; but readings should be left with less than a hundredth of their uncertainty.
double step_precision(const JacobianRows& rows) {
    double sharpest = 1, largest = 0;
    for (int i = 0; i < rows.count(); ++i) {
        if (rows.variance[i] > 0) sharpest = std::min(sharpest, rows.variance[i]);
        largest = std::max(largest, std::abs(rows.residual[i]));
    }
    if (!(largest > 0)) return k_newton.coarsest;
    return std::clamp(k_newton.part_of_sigma * std::sqrt(sharpest) / largest, k_newton.finest,
                      k_newton.coarsest);
}

class Newton {
public:
    Newton(Relaxation& relaxation, KktSolver& solver, const Shape& start,
           const std::vector<ActiveCorner>& held, const NewtonOptions& options)
        : relaxation_(relaxation),
          solver_(solver),
          held_(held),
          options_(options),
          metric_(relaxation.metric()),
          none_(Eigen::VectorXd::Zero(relaxation.parameters().size())),
          shape_(start),
          outline_(options.outline) {
        penalty_.with_priors = false;
        penalty_.with_hinges = !outline_;
        select_branches(shape_, outline_);
        if (options.contacts_shared) relaxation.share_level_corners(shape_);
        here_ = linearised(shape_);
        damping_ = options.near_local_minimum ? k_newton.least_damping : k_newton.first_damping;
    }

    LocalOptimum run();

private:
    struct Step {
        bool factored = false, better = false;
        bool idle = false;  ///< a Newton step whose gain is lost in rounding
        double length = 0;
    };

    void select_branches(const Shape& shape, const std::shared_ptr<const Outline>& outline) {
        relaxation_.forget_contacts();
        relaxation_.select_branches(shape, true, outline);
    }
    StepLinearisation linearised(const Shape& shape) {
        return relaxation_.linearisation(shape, penalty_, held_);
    }
    void take_multipliers_at_start();
    bool branch_changes();
    bool ends(bool by_itself);
    Step step();
    bool factor();
    void accept(Shape next, StepLinearisation there, const KktSolver::Solution& solution,
                double before, double gain, double length);
    bool gives_up(const Step& made);

    Relaxation& relaxation_;
    KktSolver& solver_;
    const std::vector<ActiveCorner>& held_;
    const NewtonOptions& options_;
    const Eigen::VectorXd metric_, none_;
    PenaltyScale penalty_;
    Shape shape_;
    std::shared_ptr<const Outline> outline_;
    StepLinearisation here_;
    double damping_ = 0;
    int quiet_ = 0, choices_ = 0;
    bool second_order_ = false;    ///< the next step is Newton's
    Eigen::VectorXd multipliers_;  ///< of the equations, for the Lagrangian Hessian
    double length_before_ = 0;     ///< of the previous step in this branch, or 0
    /// The branches were chosen at this shape. At a kink (a caliper's jaw that touches two corners
    /// at once) they would alternate for ever; `select_branches` then lets the jaw rest on both.
    bool asked_ = false;
    double least_ = k_kkt.least_variance;
    bool may_be_close_ = true;
    LocalOptimum result_;
};

void Newton::take_multipliers_at_start() {
    if (!solver_.factor(here_.rows, damping_ * metric_)) return;
    const auto s = solver_.solve(none_, -here_.rows.residuals(), step_precision(here_.rows));
    second_order_ = s.good;
    multipliers_ = s.multipliers;
}

bool Newton::branch_changes() {
    if (outline_ || choices_ > k_newton.most_branches) return false;  // chosen at each shape
    asked_ = true;
    relaxation_.select_branches(shape_, true);
    StepLinearisation fresh = linearised(shape_);
    if (std::abs(fresh.merit - here_.merit) < k_newton.same_branch * (1 + here_.merit))
        return false;
    ++choices_;
    here_ = std::move(fresh);
    quiet_ = 0;
    length_before_ = 0;
    asked_ = false;
    damping_ = std::max(damping_, k_newton.branch_damping);
    if (damping_ > k_newton.stuck_damping) damping_ = k_newton.first_damping;
    return true;
}

bool Newton::ends(bool by_itself) {
    if (branch_changes()) return false;
    result_.converged = by_itself;
    return true;
}

// Includes the second-order terms for Newton steps, unless they make the matrix indefinite.
bool Newton::factor() {
    if (second_order_) {
        const std::vector<SymmetricEntry> second_order =
            relaxation_.curvature(shape_, multipliers_);
        if (solver_.factor(here_.rows, damping_ * metric_, second_order, least_)) return true;
    }
    second_order_ = false;
    if (solver_.factor(here_.rows, damping_ * metric_, {}, least_)) return true;
    if (least_ != k_kkt.least_variance_close) return false;
    least_ = k_kkt.least_variance;
    may_be_close_ = false;
    return solver_.factor(here_.rows, damping_ * metric_);
}

void Newton::accept(Shape next, StepLinearisation there, const KktSolver::Solution& solution,
                    double before, double gain, double length) {
    quiet_ = gain < k_newton.no_gain * (1 + before) || length < k_newton.no_step ? quiet_ + 1 : 0;
    // Newton steps converge quadratically: predict the next step's length and gain.
    const double shrinks =
        second_order_ && length_before_ > 0 ? std::min(1.0, length / length_before_) : 1;
    const double next_length = length * shrinks * shrinks,
                 next_gain = std::abs(gain) * std::pow(shrinks, 4);
    length_before_ = length;
    if (second_order_ && next_length < k_newton.short_step &&
        next_gain < k_newton.no_gain * (1 + before))
        quiet_ = k_newton.quiet_steps;
    shape_ = std::move(next);
    // Near the minimum use the exact Hessian: weak parameters would otherwise converge slowly.
    if (length < k_newton.newton_length) {
        multipliers_ = solution.multipliers;
        second_order_ = true;
    }
    here_ = std::move(there);
    damping_ = std::max(k_newton.least_damping, damping_ / k_newton.damping_falls);
    // Choose the branches once, when little is left to gain in this one.
    if (!asked_ && next_gain < k_newton.little && here_.hard_sum < k_newton.all_but_met)
        branch_changes();
}

Newton::Step Newton::step() {
    Step made;
    made.factored = factor();
    if (!made.factored) return made;
    const auto solution = solver_.solve(none_, -here_.rows.residuals(), step_precision(here_.rows));
    if (!solution.good) return made;
    Eigen::VectorXd step = solution.unknowns;
    made.length = step.cwiseAbs().maxCoeff();
    if (made.length > k_newton.longest) step *= k_newton.longest / made.length;
    Corrected corrected = onto_hard_equations(
        relaxation_, solver_, here_, penalty_,
        relaxation_.parameters().retracted_with_turn(shape_, steps(step)),
        {.most = k_newton.most_corrections,
         .met = made.length < k_newton.near ? k_newton.met : k_newton.far_from_met,
         .precision = k_newton.correction_precision});
    if (corrected.stalls && may_be_close_) least_ = k_kkt.least_variance_close;
    Shape next = std::move(corrected.shape);
    std::shared_ptr<const Outline> outline;
    if (outline_) {
        outline = outline_of(relaxation_.model(), next);
        if (!outline) return made;
        select_branches(next, outline);
    }
    StepLinearisation there = linearised(next);
    // Hard equations dominate the merit. Residuals below `nearly_met` do not count: they are
    // brought to rounding at the end.
    const auto merit = [](const StepLinearisation& at) {
        return at.merit + k_newton.hard_weight * std::max(0.0, at.hard_sum - k_newton.nearly_met);
    };
    const double before = merit(here_), after = merit(there);
    made.better = there.finite && after <= before * (1 + k_newton.merit_part) + k_newton.merit_rise;
    if (made.better) {
        outline_ = std::move(outline);
        accept(std::move(next), std::move(there), solution, before, before - after, made.length);
        return made;
    }
    if (outline_) select_branches(shape_, outline_);
    // A Newton step whose change is within the rounding of the sums.
    made.idle = there.finite && second_order_ && made.length < k_newton.short_step &&
                after - before < k_newton.no_gain * (1 + before);
    return made;
}

// After a step that did not improve the merit.
bool Newton::gives_up(const Step& made) {
    second_order_ = false;
    length_before_ = 0;
    damping_ *= k_newton.damping_rises;
    // The gain is below rounding, or no damping leads to a better step.
    const bool nothing_left = (made.factored && made.length < k_newton.lost_step) || made.idle ||
                              damping_ > k_newton.most_damping;
    return nothing_left && ends(made.factored);
}

LocalOptimum Newton::run() {
    if (options_.near_local_minimum) take_multipliers_at_start();
    for (int i = 0; i < options_.iterations; ++i) {
        result_.iterations = i + 1;
        const Step made = step();
        if (!made.better && gives_up(made)) break;
        if (quiet_ >= k_newton.quiet_steps && ends(true)) break;
    }
    result_.shape = std::move(shape_);
    result_.outline = std::move(outline_);
    return std::move(result_);
}

}  // namespace

std::shared_ptr<const Outline> outline_of(const FitModel& model, const Shape& shape) {
    Enclosed enclosed = enclosed_by(model, shape);
    return enclosed.closed ? enclosed.outline : nullptr;
}

LocalOptimum constrained_newton(Relaxation& relaxation, KktSolver& solver, const Shape& start,
                                const std::vector<ActiveCorner>& held,
                                const NewtonOptions& options) {
    LocalOptimum result = Newton(relaxation, solver, start, held, options).run();
    if (options.contacts_shared && !relaxation.contacts_hold(result.shape)) {
        NewtonOptions again = options;
        again.contacts_shared = false;
        LocalOptimum freed = constrained_newton(relaxation, solver, start, held, again);
        freed.iterations += result.iterations;
        return freed;
    }
    result.shared_contacts = relaxation.shared_contacts();
    evaluate_minimum(relaxation, held, result, result.outline);
    return result;
}

}  // namespace culet
