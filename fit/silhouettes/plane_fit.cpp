#include "fit/silhouettes/plane_fit.h"

#include <algorithm>
#include <cmath>

#include "fit/silhouettes/plane_solver.h"
#include "stone/numbers/dense_algebra.h"

namespace culet {

namespace {

constexpr double k_first_damping = 1e-3, k_least_damping = 1e-9, k_most_damping = 1e7;
// Converged after `k_quiet` steps in a row that each gain less than this part of the cost.
constexpr double k_no_gain = 1e-5;
constexpr int k_quiet = 2;
// Radians, about half the angle between neighbouring facets: no linearisation holds further.
constexpr double k_longest = 0.1;

}  // namespace

PlaneFit fit_planes(const PlaneFitProblem& problem, const std::vector<Plane>& planes,
                    int most_steps) {
    const PlaneSolver solver(problem);
    PlaneFit result;
    PlaneState state{planes, problem.from, {}, {}};
    if (solver.look(state)) {
        double damping = k_first_damping;
        int quiet = 0;
        while (result.steps < most_steps && !result.converged && damping < k_most_damping) {
            const std::vector<double> scales = solver.scales(state);
            const auto weights = solver.weights(state, scales);
            std::vector<double> sigmas = scales;
            for (double& s : sigmas) s *= problem.shared_errors;
            const double before = solver.cost(state, weights, sigmas);
            const PlaneSolver::Equations equations = solver.equations(state, weights, sigmas, true);
            bool better = false;
            while (!better && damping < k_most_damping && result.steps < most_steps) {
                ++result.steps;
                Eigen::MatrixXd damped = equations.matrix;
                damped.diagonal() *= 1 + damping;
                const Cholesky factor(damped);
                Eigen::VectorXd step = -factor.solve_one(equations.gradient);
                double length = 0;
                for (int p = 0; p < solver.planes(); ++p) {
                    length = std::max({length, std::abs(step(3 * p)), std::abs(step(3 * p + 1))});
                }
                if (length > k_longest) step *= k_longest / length;
                PlaneState next = solver.moved(state, step);
                const bool closes = factor.good() && solver.look(next);
                const double after = closes ? solver.cost(next, weights, sigmas) : 1e300;
                better = after < before;
                if (!better) {
                    damping *= 10;
                    continue;
                }
                damping = std::max(k_least_damping, damping / 10);
                quiet = before - after < k_no_gain * before ? quiet + 1 : 0;
                state = std::move(next);
            }
            result.converged = quiet >= k_quiet || damping >= k_most_damping;
        }
        result.scales = solver.scales(state);
    }
    result.planes = std::move(state.planes);
    result.from = std::move(state.from);
    result.body = std::move(state.body);
    result.distances = std::move(state.distances);
    return result;
}

PlaneInformation plane_information(const PlaneFitProblem& problem, const PlaneFit& fit) {
    const PlaneSolver solver(problem);
    const PlaneState state{fit.planes, fit.from, fit.body, fit.distances};
    const auto weights = solver.weights(state, fit.scales);
    const std::vector<double>& scales = fit.scales;
    PlaneInformation information;
    const std::size_t sets = fit.scales.size();
    std::vector<double> squares(sets, 0), count(sets, 0);
    for (std::size_t c = 0; c < weights.size(); ++c) {
        const auto set = std::size_t(problem.contours[c].set);
        for (std::size_t i = 0; i < weights[c].size(); ++i) {
            squares[set] += weights[c][i] * std::pow(fit.distances.nearest[c][i].distance, 2);
            if (problem.contours[c].weights[i] > 0) {
                count[set] += weights[c][i] / problem.contours[c].weights[i];
            }
        }
    }
    double all = 0;
    for (const double n : count) all += n;
    int present = 0;
    for (const bool p : fit.body.present) present += p;
    const double parameters = 3.0 * present + solver.motions();
    for (std::size_t s = 0; s < sets; ++s) {
        const double own = all > 0 ? parameters * count[s] / all : 0;
        const double dof = std::max(1.0, count[s] - own);
        const bool is_stated = problem.stated_sigmas[s] > 0;
        // A rule that leaves out more than outliers makes the rest look too good.
        const double least = problem.outliers.sure < k_sure ? 1 : 1e-6;
        information.sigmas.push_back(
            is_stated ? problem.stated_sigmas[s]
                      : std::max(std::sqrt(squares[s] / dof), least * scales[s]));
        information.sigmas.back() *= problem.shared_errors;
        if (!is_stated) continue;
        information.chi2 += squares[s] / std::pow(problem.stated_sigmas[s], 2);
        information.chi2_dof += count[s] - own;
    }
    const PlaneSolver::Equations equations =
        solver.equations(state, weights, information.sigmas, true);
    const Eigen::MatrixXd whole = equations.matrix.selfadjointView<Eigen::Lower>();
    const Eigen::Index planes = 3 * solver.planes(), rest = whole.rows() - planes;
    information.matrix = whole.topLeftCorner(planes, planes);
    if (rest > 0) {
        const Eigen::MatrixXd mixed = whole.bottomLeftCorner(rest, planes);
        information.matrix -= transpose_times(
            mixed, PivotedCholesky(whole.bottomRightCorner(rest, rest)).solve(mixed));
    }
    const auto turns = Eigen::Index(fit.from.series.turns.size());
    if (turns > 0) {
        const Eigen::VectorXd variances = PivotedCholesky(whole).inverse().diagonal().tail(turns);
        for (const double v : variances) information.turn_sigmas.push_back(std::sqrt(v));
    }
    return information;
}

}  // namespace culet
