#include "fit/solve/active_set.h"

#include <algorithm>

#include "fit/solve/constants.h"
#include "fit/solve/constrained_newton.h"
#include "fit/solve/sign_ambiguity.h"

namespace culet {

namespace {

// Returns the best local minimum found by changing signs of facets near upright.
LocalOptimum with_best_signs(Relaxation& relaxation, KktSolver& solver,
                             const ActiveSetOptions& options, LocalOptimum optimum) {
    PenaltyScale penalty;
    penalty.with_priors = false;
    const auto gains_from = [&](const Shape& another) {
        LocalOptimum other =
            constrained_newton(relaxation, solver, another, {},
                               {.iterations = options.iterations / k_signs.steps_divisor});
        other.iterations += optimum.iterations;
        if (!(other.chi2 < optimum.chi2 - k_signs.same_minimum)) return false;
        optimum = std::move(other);
        return true;
    };
    for (int round = 0; round < k_signs.most_rounds && !(optimum.chi2 < options.good_chi2) &&
                        solver.work() < k_signs.most_work;
         ++round) {
        relaxation.forget_contacts(optimum.shared_contacts);
        const std::vector<Shape> others =
            better_signs(relaxation, solver, optimum.shape, penalty, k_signs.nearly_upright,
                         k_signs.most_choices);
        if (std::none_of(others.begin(), others.end(), gains_from)) break;
    }
    return optimum;
}

bool is_among(const std::vector<ActiveCorner>& all, const ActiveCorner& corner) {
    return std::find(all.begin(), all.end(), corner) != all.end();
}

// Returns corners above a neighbour facet, and those of degenerate edges, which would turn over if
// they could. Edges drawn degenerate are left out: their ends are above only by rounding, beside
// others that are held.
std::vector<ActiveCorner> corners_to_hold(const Relaxation& relaxation, const Shape& shape) {
    std::vector<ActiveCorner> above = relaxation.above(shape);
    const std::vector<ActiveCorner> nearly = relaxation.above(shape, k_held.no_length);
    if (nearly.size() == above.size()) return above;
    const std::vector<ActiveCorner> drawn =
        relaxation.above(relaxation.model().mesh_shape(), k_held.drawn);
    for (const ActiveCorner& h : nearly) {
        if (!is_among(drawn, h) && !is_among(above, h)) above.push_back(h);
    }
    return above;
}

// An edge that would turn over shows at both its ends; holding one of them usually suffices, so the
// second is held only if there is nothing else. Returns false when nothing is new.
bool hold_more(const Relaxation& relaxation, const std::vector<ActiveCorner>& above,
               std::vector<ActiveCorner>& held) {
    const std::size_t before = held.size();
    for (const ActiveCorner& h : above) {
        const bool known = std::any_of(held.begin(), held.end(), [&](const ActiveCorner& other) {
            return other == h || are_ends_of_one_edge(relaxation.model(), other, h);
        });
        if (!known) held.push_back(h);
    }
    if (held.size() > before) return true;
    for (const ActiveCorner& h : above) {
        if (!is_among(held, h)) held.push_back(h);
    }
    return held.size() > before;
}

// Penalties let corners stand slightly above their neighbours. These are now held just below. The
// active set only grows: a corner that readings push out would be pushed out again.
void hold_corners(Relaxation& relaxation, KktSolver& solver, const ActiveSetOptions& options,
                  LocalOptimum& optimum, ActiveSetFit& result) {
    // Shared by all rounds: a few steps suffice in each, or none do.
    int left = options.iterations;
    for (int round = 0; round < k_held.most_rounds && left > 0 && optimum.chi2 < options.hopeless;
         ++round) {
        // Holding more corners does not make the meets hold.
        if (optimum.worst_hard > k_newton.all_but_met) break;
        const bool come_down = round == 0 && relaxation.above(optimum.shape).empty();
        const std::vector<ActiveCorner> above = corners_to_hold(relaxation, optimum.shape);
        if (!hold_more(relaxation, above, result.held)) break;
        // Planes have three parameters each.
        if (result.held.size() > 3 * relaxation.model().stone().solid.facets.size()) {
            if (come_down) result.held.clear();
            result.is_no_stone = !come_down;
            break;
        }
        LocalOptimum next =
            constrained_newton(relaxation, solver, optimum.shape, result.held,
                               {.iterations = left, .near_local_minimum = options.good_chi2 > 0});
        bring_to_meet(relaxation, result.held, next);
        left -= next.iterations;
        next.iterations += optimum.iterations;
        if (come_down && !(next.chi2 < optimum.chi2 + k_held.cost_of_an_edge)) {
            result.held.clear();
            break;
        }
        optimum = std::move(next);
    }
}

}  // namespace

ActiveSetFit fit_active_set(Relaxation& relaxation, const Shape& start,
                            const ActiveSetOptions& options) {
    ActiveSetFit result;
    KktSolver solver;
    const bool goes_on = options.good_chi2 > 0;
    LocalOptimum optimum = constrained_newton(relaxation, solver, start, {},
                                              {.iterations = options.iterations,
                                               .near_local_minimum = goes_on,
                                               .contacts_shared = goes_on});
    optimum = with_best_signs(relaxation, solver, options, std::move(optimum));
    bring_to_meet(relaxation, {}, optimum);
    const double free_chi2 = optimum.chi2;
    hold_corners(relaxation, solver, options, optimum, result);
    result.cost_of_holding = result.held.empty() ? 0 : std::max(0.0, optimum.chi2 - free_chi2);
    result.finished = std::move(optimum);
    result.finished.outline = relaxation.model().mesh_outline();
    result.finished.work = solver.work();
    return result;
}

}  // namespace culet
