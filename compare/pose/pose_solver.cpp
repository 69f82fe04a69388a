#include "compare/pose/pose_solver.h"

#include <ceres/ceres.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>

#include "compare/pose/view_formulas.h"
#include "stone/perpendicular.h"

namespace culet {

namespace {

// Residuals of more sigmas than this count by their logarithm only.
constexpr double k_loss = 2;

struct FacetFrame {
    Vec3 normal, across, along;
    double height = 0;  // of the facet's plane, normal . x
    Vec3 middle;
};

FacetFrame frame_of(const WireSolid& wire, int facet) {
    const auto f = static_cast<std::size_t>(facet);
    FacetFrame frame;
    const Plane& plane = wire.solid.facets[f].plane;
    frame.normal = plane.normal;
    frame.across = perpendicular_to(plane.normal);
    frame.along = glm::cross(plane.normal, frame.across);
    frame.height = plane.offset;
    frame.middle = wire.facet_middles[f];
    return frame;
}

/// A changed plane at the point `x`: its normal, and how far x lies below it.
template <class Number>
void change_plane(const FacetFrame& frame, const Vec3& x, const Number* change,
                  std::array<Number, 3>& normal, Number& below) {
    for (int k = 0; k < 3; ++k) {
        normal[static_cast<std::size_t>(k)] =
            frame.normal[k] + change[0] * frame.across[k] + change[1] * frame.along[k];
    }
    const Vec3 arm = x - frame.middle;
    below = change[2] - change[0] * glm::dot(frame.across, arm) -
            change[1] * glm::dot(frame.along, arm);
}

template <class Number>
Number dot(const std::array<Number, 3>& a, const std::array<Number, 3>& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Where a point of an edge goes when its two facets change: to the nearest point of both planes.
template <class Number>
std::array<Number, 3> moved(const FacetFrame& left, const FacetFrame& right, const Vec3& x,
                            const Number* left_change, const Number* right_change) {
    std::array<Number, 3> n1, n2;
    Number r1, r2;
    change_plane(left, x, left_change, n1, r1);
    change_plane(right, x, right_change, n2, r2);
    const Number a = dot(n1, n1), b = dot(n1, n2), d = dot(n2, n2);
    const Number determinant = a * d - b * b;
    const Number s = (d * r1 - b * r2) / determinant, t = (a * r2 - b * r1) / determinant;
    return {x.x + s * n1[0] + t * n2[0], x.y + s * n1[1] + t * n2[1], x.z + s * n1[2] + t * n2[2]};
}

template <class Number>
std::array<Number, 2> seen(const StoneView& view, const Number* change,
                           const std::array<Number, 3>& x) {
    using std::exp;
    const std::array<Number, 3> arm{x[0] - view.middle.x, x[1] - view.middle.y,
                                    x[2] - view.middle.z};
    std::array<Number, 3> there;
    for (int row = 0; row < 3; ++row) {
        there[static_cast<std::size_t>(row)] =
            view.turn[0][row] * arm[0] + view.turn[1][row] * arm[1] + view.turn[2][row] * arm[2];
    }
    there = times(rotation_of(change[0], change[1], change[2]), there);
    const Number scale = view.scale * exp(change[5]);
    const Number nearness = view.nearness * exp(change[6]);
    const Number sight_x = view.sight.x + change[7], sight_y = view.sight.y + change[8];
    const Number beside_x = view.at.x + change[3] - sight_x;
    const Number beside_y = view.at.y + change[4] - sight_y;
    there = times(
        least_rotation_to(Number(beside_x * nearness / scale), Number(beside_y * nearness / scale)),
        there);
    const Number depth = 1.0 + nearness * there[2];
    return {sight_x + (beside_x + scale * there[0]) / depth,
            sight_y + (beside_y + scale * there[1]) / depth};
}

struct EdgeResidual {
    const StoneView& view;
    FacetFrame left, right;
    const MetEdge& met;

    template <class Number>
    bool operator()(const Number* change, const Number* left_change, const Number* right_change,
                    Number* residual) const {
        const std::array<Number, 3> x =
            moved(left, right, met.point.on_stone, left_change, right_change);
        const std::array<Number, 2> at = seen(view, change, x);
        residual[0] = ((at[0] - met.point.at.x) * met.point.normal_x +
                       (at[1] - met.point.at.y) * met.point.normal_y - met.offset) /
                      met.sigma;
        return true;
    }
};

/// The same with facets as in the model.
struct ViewResidual {
    const StoneView& view;
    const MetEdge& met;

    template <class Number>
    bool operator()(const Number* change, Number* residual) const {
        const Vec3& p = met.point.on_stone;
        const std::array<Number, 2> at =
            seen(view, change, std::array<Number, 3>{Number(p.x), Number(p.y), Number(p.z)});
        residual[0] = ((at[0] - met.point.at.x) * met.point.normal_x +
                       (at[1] - met.point.at.y) * met.point.normal_y - met.offset) /
                      met.sigma;
        return true;
    }
};

struct FacetPrior {
    double angle = 1, lift = 1;
    template <class Number>
    bool operator()(const Number* change, Number* residual) const {
        residual[0] = change[0] / angle;
        residual[1] = change[1] / angle;
        residual[2] = change[2] / lift;
        return true;
    }
};

/// The focal length is scale / nearness.
struct LensPrior {
    double log_focal = 0;  // of the view over that expected
    double focal_error = 1, sight_error = 1;
    PicturePoint sight_off;  // of the view from that expected
    template <class Number>
    bool operator()(const Number* change, Number* residual) const {
        residual[0] = (change[5] - change[6] + log_focal) / focal_error;
        residual[1] = (change[7] + sight_off.x) / sight_error;
        residual[2] = (change[8] + sight_off.y) / sight_error;
        return true;
    }
};

// Held parameters stand at zero with such a weight that their variance is nothing.
constexpr double k_held = 1e-9;

/// Covariance of all unknowns, those of the view first.
Eigen::MatrixXd covariance_of(ceres::Problem& problem, double* change,
                              const std::vector<double*>& blocks) {
    ceres::Problem::EvaluateOptions options;
    options.parameter_blocks = {change};
    options.parameter_blocks.insert(options.parameter_blocks.end(), blocks.begin(), blocks.end());
    ceres::CRSMatrix rows;
    problem.Evaluate(options, nullptr, nullptr, nullptr, &rows);
    Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(rows.num_cols, rows.num_cols);
    for (std::size_t r = 0; r < static_cast<std::size_t>(rows.num_rows); ++r) {
        const auto begin = static_cast<std::size_t>(rows.rows[r]);
        const auto end = static_cast<std::size_t>(rows.rows[r + 1]);
        for (std::size_t i = begin; i < end; ++i) {
            for (std::size_t j = begin; j < end; ++j)
                normal(rows.cols[i], rows.cols[j]) += rows.values[i] * rows.values[j];
        }
    }
    // Units differ by many powers of ten: to equal diagonals first.
    const Eigen::VectorXd size = normal.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
    const Eigen::MatrixXd equal = size.asDiagonal() * normal * size.asDiagonal();
    const Eigen::MatrixXd inverse =
        equal.ldlt().solve(Eigen::MatrixXd::Identity(equal.rows(), equal.cols()));
    return size.asDiagonal() * inverse * size.asDiagonal();
}

// What was expected counts as much as so many changes that were found.
constexpr double k_belief = 6;

/// How large the facets' changes are: each over the square root of the share of its expected
/// variance that the edges could find. By their median, so that facets of edges that were mistaken
/// do not count.
class Component {
public:
    explicit Component(double expected) : expected_(expected) {}
    void add(double value, double variance_left) {
        const double found = 1 - variance_left / (expected_ * expected_);
        if (found > 0.15) sizes_.push_back(std::abs(value) / std::sqrt(found));
    }
    double sigma() {
        if (sizes_.size() < 5) return expected_;
        const auto middle = sizes_.begin() + static_cast<std::ptrdiff_t>(sizes_.size() / 2);
        std::nth_element(sizes_.begin(), middle, sizes_.end());
        const double found = *middle / 0.6745;
        const double count = static_cast<double>(sizes_.size());
        return std::sqrt((count * found * found + k_belief * expected_ * expected_) /
                         (count + k_belief));
    }

private:
    double expected_;
    std::vector<double> sizes_;
};

}  // namespace

SolvedView solve_view(const WireSolid& wire, const StoneView& start,
                      const std::vector<MetEdge>& edges, double prior_focal_px,
                      const PicturePoint& sight, const SolverSettings& settings) {
    SolvedView result;
    result.view = start;
    result.facets.assign(wire.solid.facets.size(), FacetChange{0, 0, 0});
    ViewChange change{};
    ceres::Problem problem;
    problem.AddParameterBlock(change.data(), k_view_unknowns);
    std::map<int, int> used;  // facets, and how many edges are theirs
    for (const MetEdge& met : edges) {
        if (!settings.facets_free) {
            problem.AddResidualBlock(
                new ceres::AutoDiffCostFunction<ViewResidual, 1, k_view_unknowns>(
                    new ViewResidual{result.view, met}),
                new ceres::CauchyLoss(k_loss), change.data());
            continue;
        }
        const Edge& edge = wire.edges[static_cast<std::size_t>(met.point.edge)];
        ++used[edge.left];
        ++used[edge.right];
        auto* cost = new ceres::AutoDiffCostFunction<EdgeResidual, 1, k_view_unknowns, 3, 3>(
            new EdgeResidual{result.view, frame_of(wire, edge.left), frame_of(wire, edge.right),
                             met});
        problem.AddResidualBlock(cost, new ceres::CauchyLoss(k_loss), change.data(),
                                 result.facets[static_cast<std::size_t>(edge.left)].data(),
                                 result.facets[static_cast<std::size_t>(edge.right)].data());
    }
    const double axis_error = settings.facet_error / std::numbers::sqrt2;
    const double lift_error = settings.facet_offset;
    std::vector<double*> free_blocks;
    for (const auto& [facet, count] : used) {
        double* block = result.facets[static_cast<std::size_t>(facet)].data();
        problem.AddResidualBlock(new ceres::AutoDiffCostFunction<FacetPrior, 3, 3>(
                                     new FacetPrior{axis_error, lift_error}),
                                 nullptr, block);
        free_blocks.push_back(block);
    }
    const bool perspective = start.nearness > 0 && prior_focal_px > 0;
    LensPrior lens;
    lens.focal_error = perspective && settings.focal_error > 0 ? settings.focal_error : k_held;
    lens.sight_error =
        perspective && settings.principal_point_error > 0 ? settings.principal_point_error : k_held;
    if (perspective) lens.log_focal = std::log(start.focal_px() / prior_focal_px);
    if (lens.focal_error == k_held) lens.log_focal = 0;
    if (lens.sight_error != k_held)
        lens.sight_off = {start.sight.x - sight.x, start.sight.y - sight.y};
    problem.AddResidualBlock(
        new ceres::AutoDiffCostFunction<LensPrior, 3, k_view_unknowns>(new LensPrior(lens)),
        nullptr, change.data());

    ceres::Solver::Options options;
    options.linear_solver_type =
        settings.facets_free ? ceres::DENSE_NORMAL_CHOLESKY : ceres::DENSE_QR;
    options.max_num_iterations = settings.facets_free ? 12 : 20;
    options.function_tolerance = 1e-7;
    options.num_threads = 1;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    result.converged = summary.IsSolutionUsable();
    ceres::Problem::EvaluateOptions raw;
    raw.apply_loss_function = false;
    raw.num_threads = 1;
    problem.GetResidualBlocks(&raw.residual_blocks);
    raw.residual_blocks.resize(edges.size());  // they were added first
    problem.Evaluate(raw, nullptr, &result.residuals, nullptr, nullptr);
    if (settings.with_covariance) {
        const Eigen::MatrixXd covariance = covariance_of(problem, change.data(), free_blocks);
        for (int i = 0; i < k_view_unknowns; ++i) {
            for (int j = 0; j < k_view_unknowns; ++j) result.covariance.push_back(covariance(i, j));
        }
        Component tilt(axis_error), lift(lift_error);
        for (std::size_t b = 0; b < free_blocks.size(); ++b) {
            const Eigen::Index at = k_view_unknowns + 3 * static_cast<Eigen::Index>(b);
            tilt.add(free_blocks[b][0], covariance(at, at));
            tilt.add(free_blocks[b][1], covariance(at + 1, at + 1));
            lift.add(free_blocks[b][2], covariance(at + 2, at + 2));
        }
        result.facet_error = std::numbers::sqrt2 * tilt.sigma();
        result.facet_offset = lift.sigma();
    }
    const StoneView before = result.view;
    result.view = changed(before, change);
    return result;
}

double moved_by_facets(const WireSolid& wire, const StoneView& view, const WirePoint& point,
                       const std::vector<FacetChange>& facets) {
    const Edge& edge = wire.edges[static_cast<std::size_t>(point.edge)];
    const auto left = static_cast<std::size_t>(edge.left),
               right = static_cast<std::size_t>(edge.right);
    const std::array<double, 3> x =
        moved(frame_of(wire, edge.left), frame_of(wire, edge.right), point.on_stone,
              facets[left].data(), facets[right].data());
    const PicturePoint at = seen_at(view, {x[0], x[1], x[2]});
    return (at.x - point.at.x) * point.normal_x + (at.y - point.at.y) * point.normal_y;
}

}  // namespace culet
