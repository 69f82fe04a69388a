#include "compare/turntable/tangency.h"

#include <ceres/ceres.h>
#include <ceres/normal_prior.h>
#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>
#include <numbers>

#include "compare/turntable/shared_planes.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

// Lines of sight nearer to parallel or opposite share no well-determined plane.
constexpr double k_least_sine = 0.1;
// Tolerance for outlines half a turn apart, as a share of a step.
constexpr double k_opposite = 0.05;
constexpr std::size_t k_most_pairs = 4000;
constexpr double k_loss_px = 1;
constexpr double k_far_better = 0.8;  // of the cost
// Determinant of the normal equations over the product of the diagonal: below this it is rounding
// error.
constexpr double k_singular = 1e-12;

// A step about the expected one, in sigmas.
struct ExpectedStep {
    double expected, sigma;

    template <class T>
    bool operator()(const T* const turn, const T* const next, const T* const scale,
                    T* residual) const {
        residual[0] = (*next - *turn - *scale * T(expected)) / sigma;
        return true;
    }
};

struct Problem {
    const std::vector<OutlineHull>& hulls;
    std::vector<double> turns;
    ceres::Problem ceres = {};
    std::array<double, 3> table{0, 0, 0};
    int opposite = 0;
    std::vector<TangentGap> shared = {};
};

void add_opposite(Problem& problem) {
    const std::vector<double>& turns = problem.turns;
    for (std::size_t i = 0; i < turns.size(); ++i) {
        for (std::size_t j = i + 1; j < turns.size(); ++j) {
            const double apart = turns[j] - turns[i] - std::numbers::pi;
            if (std::abs(std::remainder(apart, 2 * std::numbers::pi)) >
                k_opposite * std::abs(turns[1] - turns[0]))
                continue;
            for (const double side : {1.0, -1.0}) {
                problem.ceres.AddResidualBlock(
                    new ceres::AutoDiffCostFunction<OppositeReach, 1, 3, 1>(new OppositeReach{
                        &problem.hulls[i].corners, &problem.hulls[j].corners, side}),
                    new ceres::HuberLoss(k_loss_px), problem.table.data(), &problem.turns[i]);
                ++problem.opposite;
            }
        }
    }
    if (problem.opposite == 0)
        throw InputError(
            fmt::format("no two of {} pictures are half a turn apart, {:g} degrees each: turn the "
                        "stone all the way round, in steps that divide 180 degrees",
                        turns.size(), std::abs(turns[1] - turns[0]) * 180 / std::numbers::pi));
}

void add_shared(Problem& problem) {
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    for (std::size_t i = 0; i < problem.turns.size(); ++i) {
        for (std::size_t j = i + 1; j < problem.turns.size(); ++j) {
            if (std::abs(std::sin(problem.turns[j] - problem.turns[i])) > k_least_sine)
                pairs.emplace_back(i, j);
        }
    }
    const std::size_t every = pairs.size() / k_most_pairs + 1;
    for (std::size_t k = 0; k < pairs.size(); k += every) {
        const auto [i, j] = pairs[k];
        const OutlineHull &one = problem.hulls[i], &other = problem.hulls[j];
        for (const double side : {1.0, -1.0}) {
            if (side > 0 ? one.at_top || other.at_top : one.at_bottom || other.at_bottom) continue;
            problem.ceres.AddResidualBlock(new ceres::AutoDiffCostFunction<SharedPlane, 1, 3, 1, 1>(
                                               new SharedPlane{&one.corners, &other.corners, side}),
                                           new ceres::HuberLoss(k_loss_px), problem.table.data(),
                                           &problem.turns[i], &problem.turns[j]);
            problem.shared.push_back({i, j, 0});
        }
    }
}

double solved(Problem& problem, ceres::LinearSolverType type) {
    ceres::Solver::Options options;
    options.linear_solver_type = type;
    options.max_num_iterations = 50;
    options.function_tolerance = 1e-10;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem.ceres, &summary);
    return summary.final_cost;
}

// From several elevations: a table's flat top makes a kink at 0, where the search would stop.
void solve_with_exact_turns(Problem& problem, const TangencyOptions& options) {
    for (double& turn : problem.turns) {
        if (problem.ceres.HasParameterBlock(&turn)) problem.ceres.SetParameterBlockConstant(&turn);
    }
    // Beyond, pictures are upside down.
    problem.ceres.SetParameterLowerBound(problem.table.data(), 2,
                                         options.from_above ? 0 : -std::numbers::pi / 2);
    problem.ceres.SetParameterUpperBound(problem.table.data(), 2, std::numbers::pi / 2);
    const std::array<double, 3> start = problem.table;
    std::array<double, 3> best = start;
    double least = 1e300;
    for (const double elevation : options.elevations) {
        problem.table = start;
        problem.table[2] = elevation;
        const double cost = solved(problem, ceres::DENSE_QR);
        if (!(cost < least)) continue;
        least = cost;
        best = problem.table;
    }
    problem.table = best;
}

// Each turn about an expected one.
double solve_about(Problem& problem, const std::vector<double>& expected, double sigma) {
    const ceres::Matrix weight = ceres::Matrix::Constant(1, 1, 1 / sigma);
    std::vector<ceres::ResidualBlockId> priors;
    for (std::size_t i = 0; i < expected.size(); ++i)
        priors.push_back(problem.ceres.AddResidualBlock(
            new ceres::NormalPrior(weight, ceres::Vector::Constant(1, expected[i])), nullptr,
            &problem.turns[i]));
    // Hundreds of unknowns, thousands of equations.
    const double cost = solved(problem, ceres::DENSE_NORMAL_CHOLESKY);
    for (const ceres::ResidualBlockId prior : priors) problem.ceres.RemoveResidualBlock(prior);
    return cost;
}

// Each step about the given one, or far from it, so that one of another size moves all pictures
// behind it.
void solve_by_steps(Problem& problem, const std::vector<double>& given, double sigma) {
    double scale = 1;
    std::vector<ceres::ResidualBlockId> steps;
    for (std::size_t i = 0; i + 1 < given.size(); ++i)
        steps.push_back(problem.ceres.AddResidualBlock(
            new ceres::AutoDiffCostFunction<ExpectedStep, 1, 1, 1, 1>(
                new ExpectedStep{given[i + 1] - given[i], sigma}),
            new ceres::CauchyLoss(1), &problem.turns[i], &problem.turns[i + 1], &scale));
    problem.ceres.SetParameterBlockConstant(problem.turns.data());
    solved(problem, ceres::DENSE_NORMAL_CHOLESKY);
    problem.ceres.SetParameterBlockVariable(problem.turns.data());
    for (const ceres::ResidualBlockId step : steps) problem.ceres.RemoveResidualBlock(step);
    problem.ceres.RemoveParameterBlock(&scale);
}

// Turns about even steps, or about others if they suit the outlines far better.
SteppedTurns solve_with_free_turns(Problem& problem, double sigma) {
    const std::vector<double> given = problem.turns;
    for (double& turn : problem.turns) {
        if (!problem.ceres.HasParameterBlock(&turn)) return stepped_turns(given, given);
        problem.ceres.SetParameterBlockVariable(&turn);
    }
    const double even = solve_about(problem, given, sigma);
    const std::array<double, 3> table = problem.table;
    const std::vector<double> turns = problem.turns;
    solve_by_steps(problem, given, sigma);
    SteppedTurns expected = stepped_turns(given, problem.turns);
    std::copy(expected.turns.begin(), expected.turns.end(), problem.turns.begin());
    if (expected.turns != given &&
        solve_about(problem, expected.turns, sigma) < k_far_better * even)
        return expected;
    problem.table = table;
    std::copy(turns.begin(), turns.end(), problem.turns.begin());
    return stepped_turns(given, given);
}

void take_sigmas(Problem& problem, Tangency& found) {
    ceres::CRSMatrix slopes;
    ceres::Problem::EvaluateOptions by_table;
    by_table.parameter_blocks = {problem.table.data()};
    problem.ceres.Evaluate(by_table, nullptr, nullptr, nullptr, &slopes);
    glm::dmat3 normal(0);
    for (std::size_t row = 0; row + 1 < slopes.rows.size(); ++row) {
        for (int a = slopes.rows[row]; a < slopes.rows[row + 1]; ++a) {
            for (int b = slopes.rows[row]; b < slopes.rows[row + 1]; ++b)
                normal[slopes.cols[std::size_t(a)]][slopes.cols[std::size_t(b)]] +=
                    slopes.values[std::size_t(a)] * slopes.values[std::size_t(b)];
        }
    }
    const double squares = normal[0][0] * normal[1][1] * normal[2][2];
    const bool is_regular = glm::determinant(normal) > k_singular * squares;
    const glm::dmat3 inverse = is_regular ? glm::inverse(normal) : glm::dmat3(HUGE_VAL);
    for (int i = 0; i < 3; ++i)
        found.sigmas[std::size_t(i)] = found.residual_px * std::sqrt(inverse[i][i]);
}

}  // namespace

Tangency tangency_of(const std::vector<OutlineHull>& hulls, const std::vector<double>& turns,
                     const TangencyOptions& options) {
    Problem problem{hulls, turns};
    // Start with the middle of all outlines.
    double sum = 0;
    for (const OutlineHull& hull : hulls) {
        const auto [low, high] =
            std::minmax_element(hull.corners.begin(), hull.corners.end(),
                                [](const glm::dvec2& a, const glm::dvec2& b) { return a.x < b.x; });
        sum += (low->x + high->x) / 2;
    }
    problem.table[0] = sum / static_cast<double>(hulls.size());
    if (options.turn_sigma == 0) add_opposite(problem);
    add_shared(problem);
    solve_with_exact_turns(problem, options);
    Tangency found;
    found.tangents = problem.opposite + int(problem.shared.size());
    if (options.turn_sigma > 0) found.expected = solve_with_free_turns(problem, options.turn_sigma);
    found.table = problem.table;
    found.turns = problem.turns;
    std::vector<double> residuals;
    ceres::Problem::EvaluateOptions evaluate;
    evaluate.apply_loss_function = false;
    problem.ceres.Evaluate(evaluate, nullptr, &residuals, nullptr, nullptr);
    residuals.resize(std::size_t(found.tangents));  // without those of expected turns
    for (const double r : residuals) found.residual_px += r * r;
    found.gaps = std::move(problem.shared);
    for (std::size_t k = 0; k < found.gaps.size(); ++k)
        found.gaps[k].px = residuals[std::size_t(problem.opposite) + k];
    found.residual_px =
        std::sqrt(found.residual_px / std::max(1.0, static_cast<double>(residuals.size()) - 3));
    take_sigmas(problem, found);
    return found;
}

}  // namespace culet
