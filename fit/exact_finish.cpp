#include "fit/exact_finish.h"

#include <algorithm>
#include <Eigen/Dense>
#include <cmath>
#include <optional>

namespace culet {

namespace {

// Freedoms that the readings hold to better than the mesh does are moved by all but this part of
// their way in each step; those that no reading holds do not move.
constexpr double k_first_damping = 1e-2;
constexpr double k_least_damping = 1e-6;

std::span<const double> steps(const Eigen::VectorXd& step) {
    return {step.data(), static_cast<std::size_t>(step.size())};
}

Eigen::VectorXd residuals(const SparseRows& rows) {
    return Eigen::Map<const Eigen::VectorXd>(rows.residual.data(),
                                             Eigen::Index(rows.residual.size()));
}

// Smallest steps onto the hard equations, until rounding is all that is left.
Shape onto_constraints(const Relaxation& relaxation, Shape shape, const std::vector<Held>& held) {
    Sheet sheet = relaxation.hard_sheet(shape, held);
    SaddleSolver solver;
    if (!solver.factor(sheet.rows, relaxation.metric())) return shape;
    const Eigen::VectorXd none = Eigen::VectorXd::Zero(relaxation.freedoms().size());
    for (int i = 0; i < 10 && sheet.hard_worst > 1e-16; ++i) {
        // The same factors do: what they miss is of second order in steps of rounding size.
        if (i == 1 && !solver.factor(sheet.rows, relaxation.metric())) break;
        const auto s = solver.solve(none, -residuals(sheet.rows));
        if (!s.good) break;
        const Shape next = relaxation.freedoms().moved(shape, steps(s.unknowns));
        Sheet there = relaxation.hard_sheet(next, held);
        if (!there.finite || there.hard_worst >= sheet.hard_worst) break;
        shape = next;
        sheet = std::move(there);
    }
    return shape;
}

struct Settled {
    Shape shape;
    bool converged = false;
    int iterations = 0;
    double chi2 = 0, worst_hard = 0;
};

Settled settle(Relaxation& relaxation, const Shape& start, const std::vector<Held>& held,
               int iterations) {
    const Freedoms& freedoms = relaxation.freedoms();
    Softness softness;
    softness.with_priors = false;
    Settled result;
    Shape shape = start;
    Sheet sheet = relaxation.sheet(shape, softness, held);
    const Eigen::VectorXd metric = relaxation.metric();
    const Eigen::VectorXd none = Eigen::VectorXd::Zero(freedoms.size());
    SaddleSolver solver;
    double damping = k_first_damping;
    int quiet = 0;
    bool curved = false;
    Eigen::VectorXd forces;
    for (int i = 0; i < iterations; ++i) {
        result.iterations = i + 1;
        bool factored = false;
        if (curved && forces.size() >= Eigen::Index(0)) {
            factored = solver.factor(sheet.rows, damping * metric,
                                     relaxation.curvature(shape, forces));
        }
        if (!factored) {
            curved = false;
            factored = solver.factor(sheet.rows, damping * metric);
        }
        bool better = false;
        double length = 0;
        if (factored) {
            const auto s = solver.solve(none, -residuals(sheet.rows));
            if (s.good) {
                Eigen::VectorXd step = s.unknowns;
                length = step.cwiseAbs().maxCoeff();
                // Half a unit is half the stone's radius: no linearisation holds so far.
                if (length > 0.2) step *= 0.2 / length;
                Shape next = freedoms.moved(shape, steps(step));
                // Second-order correction: back onto the curved constraints, same factors.
                Sheet there = relaxation.sheet(next, softness, held);
                double off_before = 1e300;
                for (int k = 0; k < 4; ++k) {
                    const double worst = there.hard_worst;
                    if (worst < 1e-12 || !(worst < 0.5 * off_before)) break;
                    off_before = worst;
                    Eigen::VectorXd back = Eigen::VectorXd::Zero(sheet.rows.count());
                    const int common = std::min(sheet.rows.count(), there.rows.count());
                    for (int e = 0; e < common; ++e) {
                        if (there.rows.variance[e] == 0 && sheet.rows.variance[e] == 0) {
                            back(e) = -there.rows.residual[e];
                        }
                    }
                    const auto correction = solver.solve(none, back);
                    if (!correction.good) break;
                    next = freedoms.moved(next, steps(correction.unknowns));
                    there = relaxation.sheet(next, softness, held);
                }
                // The hard equations first: their size is the size of what they leave undone.
                const double before = sheet.merit + 1e6 * sheet.hard_sum,
                             after = there.merit + 1e6 * there.hard_sum;
                better = there.finite && after <= before * (1 + 1e-12) + 1e-9;
                if (better) {
                    const double gain = before - after;
                    quiet = gain < 1e-9 * (1 + before) || length < 1e-12 ? quiet + 1 : 0;
                    shape = std::move(next);
                    // The exact Hessian near the end: weak freedoms would creep.
                    if (length < 1e-2) {
                        forces = s.forces;
                        curved = true;
                    }
                    sheet = std::move(there);
                    damping = std::max(k_least_damping, damping / 5);
                }
            }
        }
        if (!better) {
            // Nothing more to gain at the size of rounding.
            if (factored && length < 1e-9) {
                result.converged = true;
                break;
            }
            curved = false;
            damping *= 10;
            if (damping > 1e8) {
                // Widths pass from corner to corner with a kink; at its bottom no step is better.
                result.converged = factored;
                break;
            }
        }
        if (quiet >= 2) {
            result.converged = true;
            break;
        }
    }
    result.shape = onto_constraints(relaxation, std::move(shape), held);
    softness.with_priors = false;
    const Sheet end = relaxation.sheet(result.shape, softness, held);
    result.chi2 = end.chi2;
    result.worst_hard = relaxation.hard_sheet(result.shape, {}).hard_worst;
    return result;
}

// A reading of a nearly upright facet does not say whether it leans in or out, and each way has an
// optimum of its own. By how much chi-square changes when some of them are taken the other way
// follows from the residuals r and the matrix R = 1 - J C J' of their redundancies (both in units
// of sigma), exactly where equations are linear: 2 d'r + d'R d for shifts d of the values. One and
// two at a time are turned over as long as that gains. Nothing when none should be.
std::optional<Shape> leaning_better(Relaxation& relaxation, const Shape& shape,
                                    const std::vector<Held>& held) {
    const std::vector<Relaxation::Folded> folded = relaxation.folded(shape);
    if (folded.empty()) return std::nullopt;
    Softness softness;
    softness.with_priors = false;
    const Sheet sheet = relaxation.sheet(shape, softness, held);
    SaddleSolver solver;
    if (!solver.factor(sheet.rows, k_least_damping * relaxation.metric())) return std::nullopt;
    const auto count = static_cast<Eigen::Index>(folded.size());
    const Eigen::VectorXd none = Eigen::VectorXd::Zero(relaxation.freedoms().size());
    // In units of sigma; the value grows by the shift, the residual shrinks by it.
    Eigen::VectorXd r(count), d(count);
    Eigen::MatrixXd big(count, count);
    for (Eigen::Index i = 0; i < count; ++i) {
        const Relaxation::Folded& f = folded[std::size_t(i)];
        r(i) = sheet.rows.residual[f.row] / f.sigma;
        d(i) = -f.shift / f.sigma;
        Eigen::VectorXd one = Eigen::VectorXd::Zero(sheet.rows.count());
        one(f.row) = -f.sigma;
        const auto s = solver.solve(none, one);
        if (!s.good) return std::nullopt;
        for (Eigen::Index k = 0; k < count; ++k) {
            // forces = (J x - b) / variance
            big(k, i) = s.forces(folded[std::size_t(k)].row) * folded[std::size_t(k)].sigma;
        }
    }
    std::vector<bool> turned(std::size_t(count), false);
    const auto shift_of = [&](Eigen::Index i) { return turned[std::size_t(i)] ? -d(i) : d(i); };
    bool any = false;
    for (int round = 0; round < 4 * count; ++round) {
        double best = -1e-3;
        Eigen::Index first = -1, second = -1;
        for (Eigen::Index i = 0; i < count; ++i) {
            const double a = shift_of(i);
            const double alone = 2 * a * r(i) + a * a * big(i, i);
            if (alone < best) {
                best = alone;
                first = i;
                second = -1;
            }
            for (Eigen::Index k = 0; k < i; ++k) {
                const double b = shift_of(k);
                const double both =
                    alone + 2 * b * r(k) + b * b * big(k, k) + 2 * a * b * big(i, k);
                if (both < best) {
                    best = both;
                    first = i;
                    second = k;
                }
            }
        }
        if (first < 0) break;
        any = true;
        for (Eigen::Index i : {first, second}) {
            if (i < 0) continue;
            r += big.col(i) * shift_of(i);
            turned[std::size_t(i)] = !turned[std::size_t(i)];
        }
    }
    if (!any) return std::nullopt;
    Eigen::VectorXd right = Eigen::VectorXd::Zero(sheet.rows.count());
    for (Eigen::Index i = 0; i < count; ++i) {
        if (turned[std::size_t(i)]) right(folded[std::size_t(i)].row) = folded[std::size_t(i)].shift;
    }
    const auto s = solver.solve(none, right);
    if (!s.good || s.unknowns.cwiseAbs().maxCoeff() > 0.2) return std::nullopt;
    return relaxation.freedoms().moved(shape, steps(s.unknowns));
}

}  // namespace

ExactFinish exact_finish(Relaxation& relaxation, const Shape& start, int iterations) {
    ExactFinish result;
    Settled settled = settle(relaxation, start, {}, iterations);
    for (int round = 0; round < 4; ++round) {
        const auto leaning = leaning_better(relaxation, settled.shape, {});
        if (!leaning) break;
        Settled other = settle(relaxation, *leaning, {}, iterations);
        other.iterations += settled.iterations;
        if (!(other.chi2 < settled.chi2 - 1e-6 * (1 + settled.chi2))) break;
        settled = std::move(other);
    }
    const double free_chi2 = settled.chi2;
    // Penalties let corners stand a hair above their neighbours. Those are held just below from now
    // on: an active set that only grows, since a corner that readings push out will be pushed
    // again.
    for (int round = 0; round < 8; ++round) {
        const std::size_t before = result.held.size();
        for (const Held& h : relaxation.above(settled.shape)) {
            if (std::find(result.held.begin(), result.held.end(), h) == result.held.end()) {
                result.held.push_back(h);
            }
        }
        if (result.held.size() == before) break;
        const int earlier = settled.iterations;
        settled = settle(relaxation, settled.shape, result.held, iterations);
        settled.iterations += earlier;
    }
    result.cost_of_holding = result.held.empty() ? 0 : std::max(0.0, settled.chi2 - free_chi2);
    result.finished.shape = std::move(settled.shape);
    result.finished.outline = relaxation.system().mesh_outline();
    result.finished.converged = settled.converged;
    result.finished.iterations = settled.iterations;
    result.finished.chi2 = settled.chi2;
    result.finished.worst_hard = settled.worst_hard;
    return result;
}

}  // namespace culet
