#include "fit/solve/constrained_newton.h"

#include <algorithm>
#include <cmath>

#include "fit/solve/predicted_reduction.h"
#include "fit/solve/second_order_correction.h"

namespace culet {

namespace {

// Parameters that the readings hold to better than the mesh does are moved by all but this part of
// their way in each step; those that no reading holds do not move.
constexpr double k_first_damping = 1e-2;
constexpr double k_least_damping = 1e-6;

constexpr double k_rounding = 1e-14;
// Of what meets to rounding: each residual is a sum of four products of numbers up to one.
constexpr double k_met = 1e-15;
// Corrections of longer steps end here.
constexpr double k_far_from_met = 1e-13;
// Corrections of steps so short may be the last ones.
constexpr double k_near = 1e-3;
constexpr double k_nearly_met = 1e-10;
constexpr int k_most_choices = 12;
// A shape that leans another way is better within so many steps, or far off: twice chi-square and
// so much.
constexpr int k_hurry = 10;
constexpr double k_far_off = 100;
// Along kinks (edges of no length, corners about to rise) steps may creep for ever. Where so many
// of them, half of them refused, together gain no more than this in chi-square, what is left is a
// tenth of a sigma or less; so is it where some are refused and they gain no more than the second.
constexpr std::size_t k_creeping = 6;
constexpr double k_crumb = 0.01, k_dust = 0.001;
// In how many rounds a step may find out which corners it has to stop.
constexpr int k_most_rounds = 4;
// Steps in a row that gain nothing, at the end: this part of chi-square.
constexpr int k_quiet = 2;
constexpr double k_no_gain = 1e-8;
// Of Newton's steps: the next would be gone in rounding.
constexpr double k_short = 1e-7;
// Part of chi-square: meanings that differ by less are one. Jaws that touch two corners at once
// change their mind about places a ten-millionth of a sigma apart.
constexpr double k_same_meaning = 1e-7;
// Of chi-square: where a step gains less, the shape tells what the readings mean.
constexpr double k_little = 0.05;

// Exact equations that are nearly one (of corners held where planes are nearly parallel) are
// factored with this variance, where that can be done.
constexpr double k_least_close = 1e-11;

// What a correction leaves, the next one takes.
constexpr double k_correction_precision = 1e-3;

std::span<const double> steps(const Eigen::VectorXd& step) {
    return {step.data(), static_cast<std::size_t>(step.size())};
}

// Of a step: the next one mends what it leaves, and hard equations end in rounding; but of a
// reading it leaves no more than a hundredth of its uncertainty.
double step_precision(const JacobianRows& rows) {
    double sharpest = 1, largest = 0;
    for (int i = 0; i < rows.count(); ++i) {
        if (rows.variance[i] > 0) sharpest = std::min(sharpest, rows.variance[i]);
        largest = std::max(largest, std::abs(rows.residual[i]));
    }
    return largest > 0 ? std::clamp(0.01 * std::sqrt(sharpest) / largest, 1e-13, 1e-7) : 1e-7;
}

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
            const Shape next = relaxation.parameters().retracted(shape, steps(s.unknowns));
            StepLinearisation there = relaxation.hard_linearisation(next, held);
            if (!there.finite || there.hard_worst >= linearisation.hard_worst) break;
            shape = next;
            linearisation = std::move(there);
        }
        if (linearisation.hard_worst < k_rounding) break;
    }
    return shape;
}

void look_at_end(Relaxation& relaxation, const std::vector<ActiveCorner>& held,
                 LocalOptimum& optimum) {
    PenaltyScale penalty;
    penalty.with_priors = false;
    relaxation.forget_contacts();
    relaxation.choose(optimum.shape, true);
    optimum.chi2 = relaxation.linearisation(optimum.shape, penalty, held).chi2;
    optimum.worst_hard = relaxation.hard_linearisation(optimum.shape, {}).hard_worst;
}

bool creeps_on(const std::vector<double>& merits) {
    if (merits.size() <= k_creeping) return false;
    const auto from = merits.end() - std::ptrdiff_t(k_creeping) - 1;
    std::size_t refused = 0;
    for (auto m = from; m + 1 != merits.end(); ++m) refused += *m == *(m + 1);
    const double gain = *from - merits.back();
    return (gain < k_crumb && 2 * refused >= k_creeping) || (gain < k_dust && refused > 0);
}

}  // namespace

LocalOptimum constrained_newton(Relaxation& relaxation, KktSolver& solver, const Shape& start,
                                const std::vector<ActiveCorner>& held,
                                const NewtonOptions& options) {
    const Parameters& parameters = relaxation.parameters();
    PenaltyScale penalty;
    penalty.with_priors = false;
    LocalOptimum result;
    Shape shape = start;
    relaxation.forget_contacts();
    relaxation.choose(shape, true);
    if (options.contacts_shared) relaxation.share_level_corners(shape);
    StepLinearisation linearisation = relaxation.linearisation(shape, penalty, held);
    const Eigen::VectorXd metric = relaxation.metric();
    const Eigen::VectorXd none = Eigen::VectorXd::Zero(parameters.size());
    double damping = options.near_an_end ? k_least_damping : k_first_damping;
    int quiet = 0, choices = 0, refused = 0;
    std::vector<double> merits;
    bool curved = false;
    double length_before = 0;  // of the step before in this meaning, where there was one
    // The readings are asked again what they mean here. At a kink (a caliper's jaw that touches two
    // corners at once) they would change their mind for ever; `choose` ties the two.
    bool asked = false;
    const auto meaning_changes = [&] {
        if (choices > k_most_choices) return false;
        asked = true;
        relaxation.choose(shape, true);
        StepLinearisation fresh = relaxation.linearisation(shape, penalty, held);
        if (std::abs(fresh.merit - linearisation.merit) <
            k_same_meaning * (1 + linearisation.merit)) {
            return false;
        }
        ++choices;
        merits.clear();
        linearisation = std::move(fresh);
        quiet = 0;
        length_before = 0;
        asked = false;
        damping = std::max(damping, 1e-4);
        if (damping > 1) damping = 1e-2;
        return true;
    };
    const auto ends = [&](bool by_itself) {
        if (meaning_changes()) return false;
        result.converged = by_itself;
        return true;
    };
    Eigen::VectorXd forces;
    std::vector<SymmetricEntry> bends;
    double least = KktSolver::k_least_variance;
    bool may_be_close = true;
    if (options.near_an_end && solver.factor(linearisation.rows, damping * metric)) {
        const auto s =
            solver.solve(none, -linearisation.rows.residuals(), step_precision(linearisation.rows));
        curved = s.good;
        forces = s.forces;
    }
    for (int i = 0; i < options.iterations; ++i) {
        result.iterations = i + 1;
        bool factored = false, better = false, idle = false;
        double length = 0;
        // A step that lifts corners above their neighbours is taken again with those pressed down
        // (semismooth Newton), as in the earlier stages.
        std::vector<int> active_hinges = linearisation.above;
        for (int round = 0; round < k_most_rounds && !better; ++round) {
            bends.clear();
            if (curved) bends = relaxation.curvature(shape, forces);
            factored = curved && solver.factor(linearisation.rows, damping * metric, bends, least);
            if (!factored) {
                curved = false;
                bends.clear();
                factored = solver.factor(linearisation.rows, damping * metric, {}, least);
            }
            if (!factored && least == k_least_close) {
                least = KktSolver::k_least_variance;
                may_be_close = false;
                factored = solver.factor(linearisation.rows, damping * metric);
            }
            if (!factored) break;
            const double precision = step_precision(linearisation.rows);
            const auto s = solver.solve(none, -linearisation.rows.residuals(), precision);
            if (!s.good) break;
            const std::size_t before_release = active_hinges.size();
            for (std::size_t k = 0; k < linearisation.holding.size(); ++k) {
                if (s.forces(linearisation.first_holding + Eigen::Index(k)) >= 0) continue;
                // It is held up, not down.
                const auto at = std::lower_bound(active_hinges.begin(), active_hinges.end(),
                                                 linearisation.holding_hinge[k]);
                if (at != active_hinges.end() && *at == linearisation.holding_hinge[k])
                    active_hinges.erase(at);
            }
            if (active_hinges.size() < before_release && round + 1 < k_most_rounds) {
                linearisation = relaxation.linearisation(shape, penalty, held, &active_hinges);
                continue;
            }
            Eigen::VectorXd step = s.unknowns;
            length = step.cwiseAbs().maxCoeff();
            // Half a unit is half the stone's radius: no linearisation holds so far.
            const bool whole = length <= 0.2;
            if (!whole) step *= 0.2 / length;
            const double predicted = predicted_merit(linearisation, s, bends);
            Corrected corrected =
                onto_hard_equations(relaxation, solver, linearisation, penalty,
                                    parameters.retracted_with_turn(shape, steps(step)),
                                    {.met = length < k_near ? k_met : k_far_from_met,
                                     .precision = k_correction_precision});
            Shape next = std::move(corrected.shape);
            if (corrected.stalls && may_be_close) least = k_least_close;
            StepLinearisation there = relaxation.linearisation(next, penalty, held);
            if (!there.finite) break;
            // The hard equations first: their size is the size of what they leave undone.
            // Hard equations are brought to rounding at the end; so little does not count.
            const double before = linearisation.merit +
                                  1e6 * std::max(0.0, linearisation.hard_sum - k_nearly_met),
                         after = there.merit + 1e6 * std::max(0.0, there.hard_sum - k_nearly_met);
            better = after <= before * (1 + 1e-12) + 1e-9;
            if (!better) {
                // Newton's step, and the sums' own rounding.
                idle = curved && length < k_short && after - before < k_no_gain * (1 + before);
                if (there.above == active_hinges) break;
                active_hinges = std::move(there.above);
                linearisation = relaxation.linearisation(shape, penalty, held, &active_hinges);
                continue;
            }
            const double gain = before - after;
            quiet = gain < k_no_gain * (1 + before) || length < 1e-12 ? quiet + 1 : 0;
            // The next of Newton's steps would be shorter by the square of what this one is, and
            // would gain less by the square of that.
            const double shrinks =
                curved && length_before > 0 ? std::min(1.0, length / length_before) : 1;
            const double next_length = length * shrinks * shrinks,
                         next_gain = std::abs(gain) * std::pow(shrinks, 4);
            length_before = length;
            if (curved && next_length < k_short && next_gain < k_no_gain * (1 + before)) {
                quiet = k_quiet;
            }
            shape = std::move(next);
            // The exact Hessian near the end: weak parameters would creep.
            if (length < 1e-2) {
                forces = s.forces;
                curved = true;
            }
            linearisation = std::move(there);
            // A step that was refused a moment ago would be so again.
            if (refused == 0) damping = std::max(k_least_damping, damping / 5);
            refused = 0;
            // Once in each meaning, when there is little left to gain from it.
            const bool as_promised = whole && std::abs(linearisation.merit - predicted) < k_little;
            if (!asked && (next_gain < k_little || as_promised) &&
                linearisation.hard_sum < k_all_but_met)
                meaning_changes();
        }
        if (!better) {
            curved = false;
            length_before = 0;
            // The longer nothing helps, the larger the strides.
            damping *= std::pow(10, std::clamp(++refused / 2, 1, 4));
            if (active_hinges != linearisation.above)
                linearisation = relaxation.linearisation(shape, penalty, held);
            // Nothing more to gain at the size of rounding; or no step is better.
            if ((factored && length < 1e-9) || idle || damping > 1e8) {
                if (ends(factored)) break;
            }
        }
        merits.push_back(linearisation.merit);
        if (i >= k_hurry && !(linearisation.chi2 < 2 * options.goal + k_far_off)) break;
        const bool creeps = linearisation.hard_sum < k_all_but_met && creeps_on(merits);
        if ((quiet >= k_quiet || creeps) && ends(true)) break;
    }
    if (options.contacts_shared && !relaxation.contacts_hold(shape)) {
        NewtonOptions again = options;
        again.contacts_shared = false;
        LocalOptimum freed = constrained_newton(relaxation, solver, shape, held, again);
        freed.iterations += result.iterations;
        return freed;
    }
    result.shape = std::move(shape);
    result.shared_contacts = relaxation.shared_contacts();
    look_at_end(relaxation, held, result);
    return result;
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
