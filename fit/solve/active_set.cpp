#include "fit/solve/active_set.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <optional>

#include "fit/solve/constrained_newton.h"
#include "fit/solve/sign_ambiguity.h"
#include "fit/solve/turning.h"

namespace culet {

namespace {

constexpr int k_most_meanings = 8;
// No other meanings are looked for once that took so many multiplications (of a thousand facets,
// one end of which takes some 15 s).
constexpr double k_most_work = 1.5e10;
// Of chi-square: ends that differ by less are one.
constexpr double k_gain = 1e-3;
// Of chi-square, by which an end may be worse from which a better one is looked for: two sigmas.
constexpr double k_hardly_worse = 4;
// In half diameters, far above rounding and far below what corners are held below a facet; and far
// above that.
constexpr double k_no_length = 1e-9, k_drawn = 1e-5;
// Of chi-square, by which an edge that was not drawn so may cost more when it is held: two sigmas.
constexpr double k_cost_of_an_edge = 4;
// Half diameters: far below what anything reads.
constexpr double k_apart = 1e-5;

bool is_same_place(const Shape& one, const Shape& other) {
    for (std::size_t p = 0; p < one.points.size(); ++p) {
        if (glm::distance(one.points[p], other.points[p]) > k_apart) return false;
    }
    return true;
}

}  // namespace

ActiveSetFit fit_active_set(Relaxation& relaxation, const Shape& start,
                            const ActiveSetOptions& options) {
    const int iterations = options.iterations;
    ActiveSetFit result;
    KktSolver solver;
    const bool goes_on = options.agreeable > 0;
    LocalOptimum optimum = constrained_newton(
        relaxation, solver, start, {},
        {.iterations = iterations, .near_an_end = goes_on, .contacts_shared = goes_on});
    PenaltyScale penalty;
    penalty.with_priors = false;
    // What the readings may as well mean: each meaning has an end of its own. The best of those
    // that are hardly worse is kept: another may be found from there.
    std::optional<LocalOptimum> beside;
    // `with_turn`: what the mesh says against how they stand counts, too.
    const auto gains_from = [&](const Shape& another, bool with_turn) {
        const auto off = [&](const Shape& shape) {
            return with_turn ? turn_off_the_mesh(relaxation, shape) : 0;
        };
        const double off_now = off(optimum.shape);
        const double goal = optimum.chi2 + off_now - off(another);
        LocalOptimum other = constrained_newton(relaxation, solver, another, {},
                                                {.iterations = iterations, .goal = goal});
        other.iterations += optimum.iterations;
        if (is_same_place(other.shape, optimum.shape)) return false;
        if (!(other.chi2 + off(other.shape) < optimum.chi2 + off_now - k_gain)) {
            if (other.converged && other.chi2 < optimum.chi2 + k_hardly_worse &&
                !(beside && beside->chi2 < other.chi2)) {
                beside = std::move(other);
            }
            return false;
        }
        optimum = std::move(other);
        return true;
    };
    const auto turns_better = [&](const Shape& from) {
        const auto turned = turned_better(relaxation, solver, from, penalty);
        return turned && gains_from(*turned, true);
    };
    for (int round = 0; round < k_most_meanings && !(optimum.chi2 < options.agreeable) &&
                        solver.work() < k_most_work;
         ++round) {
        beside.reset();
        relaxation.forget_contacts(optimum.shared_contacts);
        const std::vector<Shape> sign_choices = better_signs(
            relaxation, solver, optimum.shape, penalty, k_nearly_upright, k_most_leanings);
        if (std::any_of(sign_choices.begin(), sign_choices.end(),
                        [&](const Shape& other) { return gains_from(other, false); })) {
            continue;
        }
        if (turns_better(optimum.shape)) continue;
        if (!beside || !turns_better(beside->shape)) break;
    }
    bring_to_meet(relaxation, {}, optimum);
    const double free_chi2 = optimum.chi2;
    // Penalties let corners stand a hair above their neighbours. Those are held just below from now
    // on: an active set that only grows, since a corner that readings push out will be pushed
    // again.
    // A few steps a round, or it leads nowhere.
    int left = iterations;
    for (int round = 0; round < 8 && left > 0 && optimum.chi2 < options.hopeless; ++round) {
        // What does not meet will not with more corners held.
        if (optimum.worst_hard > k_all_but_met) break;
        const std::size_t before = result.held.size();
        std::vector<ActiveCorner> above = relaxation.above(optimum.shape);
        // An edge that has come down to nothing would turn over if it could, unless drawn so: in
        // rounding, beside others that are held.
        const bool come_down = round == 0 && above.empty();
        const std::vector<ActiveCorner> nearly = relaxation.above(optimum.shape, k_no_length);
        if (nearly.size() > above.size()) {
            const std::vector<ActiveCorner> drawn =
                relaxation.above(relaxation.system().mesh_shape(), k_drawn);
            const auto holds = [](const std::vector<ActiveCorner>& all, const ActiveCorner& h) {
                return std::find(all.begin(), all.end(), h) != all.end();
            };
            for (const ActiveCorner& h : nearly) {
                if (!holds(drawn, h) && !holds(above, h)) above.push_back(h);
            }
        }
        for (const ActiveCorner& h : above) {
            // An edge that would turn over shows at both its ends: one of them is enough, most
            // often.
            const bool known =
                std::any_of(result.held.begin(), result.held.end(), [&](const ActiveCorner& other) {
                    return other == h || relaxation.are_ends_of_one_edge(other, h);
                });
            if (!known) result.held.push_back(h);
        }
        if (result.held.size() == before) {
            for (const ActiveCorner& h : above) {
                if (std::find(result.held.begin(), result.held.end(), h) == result.held.end()) {
                    result.held.push_back(h);
                }
            }
        }
        if (result.held.size() == before) break;
        // Planes have three parameters each.
        if (result.held.size() > 3 * relaxation.system().stone().solid.facets.size()) {
            if (come_down) result.held.clear();
            result.is_no_stone = !come_down;
            break;
        }
        LocalOptimum next = constrained_newton(relaxation, solver, optimum.shape, result.held,
                                               {.iterations = left, .near_an_end = goes_on});
        bring_to_meet(relaxation, result.held, next);
        left -= next.iterations;
        next.iterations += optimum.iterations;
        if (come_down && !(next.chi2 < optimum.chi2 + k_cost_of_an_edge)) {
            result.held.clear();
            break;
        }
        optimum = std::move(next);
    }
    result.cost_of_holding = result.held.empty() ? 0 : std::max(0.0, optimum.chi2 - free_chi2);
    result.finished.shape = std::move(optimum.shape);
    result.finished.outline = relaxation.system().mesh_outline();
    result.finished.converged = optimum.converged;
    result.finished.iterations = optimum.iterations;
    result.finished.work = solver.work();
    result.finished.chi2 = optimum.chi2;
    result.finished.worst_hard = optimum.worst_hard;
    return result;
}

}  // namespace culet
