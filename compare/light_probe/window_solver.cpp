#include "compare/light_probe/window_solver.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <utility>

namespace culet::window {

namespace {

struct MissedEdge {
    const Frame& frame;
    EdgeSight sight;  ///< `from` relative to the place
    Vec3 place;
    double sigma;

    template <class Number>
    bool operator()(const Number* p, const Number* turn, Number* residual) const {
        const Number from_start[3] = {Number(sight.from.x), Number(sight.from.y),
                                      Number(sight.from.z)};
        const Number direction_start[3] = {Number(sight.direction.x), Number(sight.direction.y),
                                           Number(sight.direction.z)};
        Number from[3], direction[3];
        ceres::AngleAxisRotatePoint(turn, from_start, from);
        ceres::AngleAxisRotatePoint(turn, direction_start, direction);
        Vector<Number> at;
        for (int k = 0; k < 3; ++k)
            at[static_cast<std::size_t>(k)] = p[near] * (place[k] + from[k]);
        residual[0] =
            inside_edges(window_of(frame, p), at, {direction[0], direction[1], direction[2]}) /
            sigma;
        return true;
    }
};

MissedEdge missed_edge(const Frame& frame, const SeenOutline& outline, const EdgeSight& sight,
                       double sigma) {
    return {frame, {sight.from - outline.place, sight.direction}, outline.place, sigma};
}

struct TurnPrior {
    double sigma;
    template <class Number>
    bool operator()(const Number* turn, Number* residual) const {
        for (int k = 0; k < 3; ++k) residual[k] = turn[k] / sigma;
        return true;
    }
};

using Turns = std::vector<std::array<double, 3>>;  // of the places, one for each outline

void add_window(double* window, bool hold_nearness, bool facing, ceres::Problem& problem) {
    problem.AddParameterBlock(window, parameter_count);
    // Wide bounds, only against windows without sides to fit: edge-on, wider than half the world,
    // or narrower than any pixel.
    for (const int k : {tilt_x, tilt_y}) {
        problem.SetParameterLowerBound(window, k, -1.4);
        problem.SetParameterUpperBound(window, k, 1.4);
    }
    for (const int k : {log_u, log_v}) {
        problem.SetParameterLowerBound(window, k, -12);
        problem.SetParameterUpperBound(window, k, 3);
    }
    std::vector<int> held;
    if (hold_nearness) held.push_back(near);
    if (facing) held.insert(held.end(), {tilt_x, tilt_y});
    if (!held.empty())
        problem.SetManifold(window, new ceres::SubsetManifold(parameter_count, held));
}

void add_outlines(const Frame& frame, const std::vector<SeenOutline>& outlines, double* window,
                  Turns& turns, ceres::Problem& problem) {
    for (std::size_t o = 0; o < outlines.size(); ++o) {
        double* turn = turns[o].data();
        problem.AddParameterBlock(turn, 3);
        if (o == 0 || outlines[o].turned_sigma <= 0) {
            problem.SetParameterBlockConstant(turn);
        } else {
            problem.AddResidualBlock(new ceres::AutoDiffCostFunction<TurnPrior, 3, 3>(
                                         new TurnPrior{outlines[o].turned_sigma}),
                                     nullptr, turn);
        }
        for (const EdgeSight& sight : outlines[o].sights) {
            problem.AddResidualBlock(
                new ceres::AutoDiffCostFunction<MissedEdge, 1, parameter_count, 3>(
                    new MissedEdge(missed_edge(frame, outlines[o], sight, outlines[o].sigma))),
                nullptr, window, turn);
        }
    }
}

// `scale`: factor on the sights' sigmas.
void set_sigmas(ceres::Problem& problem, double scale, Solved& result) {
    ceres::Covariance::Options settings;
    settings.algorithm_type = ceres::DENSE_SVD;
    settings.null_space_rank = -1;
    settings.num_threads = 1;
    ceres::Covariance covariance(settings);
    std::array<double, parameter_count * parameter_count> block{};
    result.nearness_sigma = result.tilt_sigma = std::numeric_limits<double>::infinity();
    const double* at = result.at.data();
    const std::vector<std::pair<const double*, const double*>> wanted{{at, at}};
    if (!covariance.Compute(wanted, &problem) ||
        !covariance.GetCovarianceBlock(at, at, block.data()))
        return;
    const auto sigma = [&](int k) {
        return scale * std::sqrt(std::max(block[static_cast<std::size_t>(k) * parameter_count +
                                                static_cast<std::size_t>(k)],
                                          0.0));
    };
    result.nearness_sigma = sigma(near);
    result.tilt_sigma = std::hypot(sigma(tilt_x), sigma(tilt_y));
}

}  // namespace

Solved solved(const Frame& frame, const std::vector<SeenOutline>& outlines, const Parameters& start,
              bool hold_nearness, bool facing) {
    Solved result;
    result.at = start;
    Turns turns(outlines.size(), {0, 0, 0});
    ceres::Problem problem;
    add_window(result.at.data(), hold_nearness, facing, problem);
    add_outlines(frame, outlines, result.at.data(), turns, problem);
    ceres::Solver::Options options;
    options.max_num_iterations = 100;
    options.linear_solver_type = ceres::DENSE_QR;
    options.logging_type = ceres::SILENT;
    options.num_threads = 1;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    if (!summary.IsSolutionUsable()) return result;
    result.cost = summary.final_cost;

    double squares = 0, weighted = 0;
    std::size_t sights = 0;
    for (std::size_t o = 0; o < outlines.size(); ++o) {
        for (const EdgeSight& sight : outlines[o].sights) {
            double missed = 0;
            missed_edge(frame, outlines[o], sight, 1.0)(result.at.data(), turns[o].data(), &missed);
            squares += missed * missed;
            weighted += missed * missed / (outlines[o].sigma * outlines[o].sigma);
            ++sights;
        }
    }
    result.residual = std::sqrt(squares / static_cast<double>(sights));
    set_sigmas(problem,
               std::sqrt(std::max(1.0, weighted / static_cast<double>(sights - parameter_count))),
               result);
    return result;
}

}  // namespace culet::window
