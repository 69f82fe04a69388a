#include "compare/pose/pose_solver.h"

#include <ceres/ceres.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <set>

#include "compare/pose/changed_view.h"
#include "stone/numbers/dense_algebra.h"
#include "stone/numbers/upper_median.h"

namespace culet {

namespace {

// Residuals over this many sigmas count only by their logarithm.
constexpr double k_loss = 2;

/// Computes the changed view once for all residuals, whenever the solver moves on.
class ViewAtChange : public ceres::EvaluationCallback {
public:
    ViewAtChange(const StoneView& view, const ViewChange& change) : view_(view), change_(change) {}
    void PrepareForEvaluation(bool, bool) override { view_.set(change_); }
    const ChangedView& view() const { return view_; }

private:
    ChangedView view_;
    const ViewChange& change_;
};

/// Distance of a wireframe point along its normal from its met edge, in sigmas, with derivatives by
/// the view's change and by the point.
struct EdgeMisfit {
    double value = 0;
    std::array<double, k_view_unknowns> by_change;
    Vec3 by_point;
};

EdgeMisfit misfit_of(const MetEdge& met, const SeenPoint& seen) {
    const double across = met.point.normal_x / met.sigma, down = met.point.normal_y / met.sigma;
    EdgeMisfit misfit;
    misfit.value = (seen.at.x - met.point.at.x) * across + (seen.at.y - met.point.at.y) * down -
                   met.offset / met.sigma;
    for (std::size_t k = 0; k < misfit.by_change.size(); ++k)
        misfit.by_change[k] = across * seen.x_by_change[k] + down * seen.y_by_change[k];
    misfit.by_point = across * seen.x_by_point + down * seen.y_by_point;
    return misfit;
}

class EdgeResidual : public ceres::SizedCostFunction<1, k_view_unknowns, 3, 3> {
public:
    EdgeResidual(const ChangedView& view, const FacetFrame& left, const FacetFrame& right,
                 const MetEdge& met)
        : view_(view), left_(left), right_(right), met_(met) {}
    bool Evaluate(double const* const* blocks, double* residual, double** slopes) const override {
        const MovedEdge moved =
            moved_edge(left_, right_, met_.point.on_stone, blocks[1], blocks[2]);
        const EdgeMisfit misfit = misfit_of(met_, view_(moved.at));
        residual[0] = misfit.value;
        if (slopes == nullptr) return true;
        if (slopes[0] != nullptr)
            std::copy(misfit.by_change.begin(), misfit.by_change.end(), slopes[0]);
        for (std::size_t k = 0; k < moved.slopes.size(); ++k) {
            double* block = slopes[k < 3 ? 1 : 2];
            if (block != nullptr) block[k % 3] = glm::dot(misfit.by_point, moved.slopes[k]);
        }
        return true;
    }

private:
    const ChangedView& view_;
    FacetFrame left_, right_;
    const MetEdge& met_;
};

/// The residual with the model's facets unchanged.
class ViewResidual : public ceres::SizedCostFunction<1, k_view_unknowns> {
public:
    ViewResidual(const ChangedView& view, const MetEdge& met) : view_(view), met_(met) {}
    bool Evaluate(double const* const*, double* residual, double** slopes) const override {
        const EdgeMisfit misfit = misfit_of(met_, view_(met_.point.on_stone));
        residual[0] = misfit.value;
        if (slopes != nullptr && slopes[0] != nullptr)
            std::copy(misfit.by_change.begin(), misfit.by_change.end(), slopes[0]);
        return true;
    }

private:
    const ChangedView& view_;
    const MetEdge& met_;
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

/// Prior of the lens; the focal length is scale / nearness.
struct LensPrior {
    double log_focal = 0;  // log of the view's over the expected one
    double focal_error = 1, sight_error = 1;
    PicturePoint sight_off;  // the view's minus the expected one
    template <class Number>
    bool operator()(const Number* change, Number* residual) const {
        residual[0] = (change[5] - change[6] + log_focal) / focal_error;
        residual[1] = (change[7] + sight_off.x) / sight_error;
        residual[2] = (change[8] + sight_off.y) / sight_error;
        return true;
    }
};

// Prior sigma of fixed parameters: practically zero.
constexpr double k_held = 1e-9;

/// Covariance of all unknowns, the view's first.
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
    // Scale to a unit diagonal first, because units differ by many powers of ten.
    const Eigen::VectorXd size = normal.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
    const Eigen::MatrixXd equal = size.asDiagonal() * normal * size.asDiagonal();
    const Eigen::MatrixXd inverse = PivotedCholesky(equal).inverse();
    return size.asDiagonal() * inverse * size.asDiagonal();
}

// Weight of the prior, in number of observed changes.
constexpr double k_belief = 6;

/// Size of the facets' changes: each one over the square root of the share of its prior variance
/// that the edges determine. By the median, so that mistaken edges do not count.
class Component {
public:
    explicit Component(double expected) : expected_(expected) {}
    void add(double value, double variance_left) {
        const double found = 1 - variance_left / (expected_ * expected_);
        if (found > 0.15) sizes_.push_back(std::abs(value) / std::sqrt(found));
    }
    int count() const { return static_cast<int>(sizes_.size()); }
    double sigma() const {
        if (sizes_.size() < 5) return expected_;
        const double found = upper_median(sizes_) / 0.6745;
        const double count = static_cast<double>(sizes_.size());
        return std::sqrt((count * found * found + k_belief * expected_ * expected_) /
                         (count + k_belief));
    }

private:
    double expected_;
    std::vector<double> sizes_;
};

/// Adds the residuals of the edges; returns the changes of those facets that are free.
std::vector<double*> add_edges(const WireSolid& wire, const std::vector<MetEdge>& edges,
                               const ChangedView& view, bool facets_free, double* change,
                               std::vector<FacetChange>& facets, ceres::Problem& problem) {
    std::set<int> used;
    const auto block = [&](int facet) { return facets[static_cast<std::size_t>(facet)].data(); };
    for (const MetEdge& met : edges) {
        auto* loss = new ceres::CauchyLoss(k_loss);
        if (!facets_free) {
            problem.AddResidualBlock(new ViewResidual(view, met), loss, change);
            continue;
        }
        const Edge& edge = wire.edges[static_cast<std::size_t>(met.point.edge)];
        used.insert({edge.left, edge.right});
        auto* cost =
            new EdgeResidual(view, frame_of(wire, edge.left), frame_of(wire, edge.right), met);
        problem.AddResidualBlock(cost, loss, change, block(edge.left), block(edge.right));
    }
    std::vector<double*> blocks;
    for (const int facet : used) blocks.push_back(block(facet));
    return blocks;
}

LensPrior lens_prior(const StoneView& start, double prior_focal_px, const PicturePoint& sight,
                     const SolverSettings& settings) {
    const bool perspective = start.nearness > 0 && prior_focal_px > 0;
    LensPrior lens;
    lens.focal_error = perspective && settings.focal_error > 0 ? settings.focal_error : k_held;
    lens.sight_error =
        perspective && settings.principal_point_error > 0 ? settings.principal_point_error : k_held;
    if (lens.focal_error != k_held) lens.log_focal = std::log(start.focal_px() / prior_focal_px);
    if (lens.sight_error != k_held)
        lens.sight_off = {start.sight.x - sight.x, start.sight.y - sight.y};
    return lens;
}

bool minimise(ceres::Problem& problem, bool facets_free) {
    ceres::Solver::Options options;
    // The Jacobian is sparse, because an edge has only two of the facets.
    options.linear_solver_type = facets_free ? ceres::SPARSE_NORMAL_CHOLESKY : ceres::DENSE_QR;
    options.sparse_linear_algebra_library_type = ceres::EIGEN_SPARSE;
    options.max_num_iterations = facets_free ? 12 : 20;
    options.function_tolerance = 1e-7;
    options.num_threads = 1;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    return summary.IsSolutionUsable();
}

/// Sets the covariance, and the sizes of the facets' errors by their changes.
void set_errors(ceres::Problem& problem, double* change, const std::vector<double*>& free_blocks,
                const FacetPrior& prior, SolvedView& result) {
    const Eigen::MatrixXd covariance = covariance_of(problem, change, free_blocks);
    for (int i = 0; i < k_view_unknowns; ++i) {
        for (int j = 0; j < k_view_unknowns; ++j) result.covariance.push_back(covariance(i, j));
    }
    Component tilt(prior.angle), lift(prior.lift);
    for (std::size_t b = 0; b < free_blocks.size(); ++b) {
        const Eigen::Index at = k_view_unknowns + 3 * static_cast<Eigen::Index>(b);
        tilt.add(free_blocks[b][0], covariance(at, at));
        tilt.add(free_blocks[b][1], covariance(at + 1, at + 1));
        lift.add(free_blocks[b][2], covariance(at + 2, at + 2));
    }
    result.facet_error = std::numbers::sqrt2 * tilt.sigma();
    result.facet_offset = lift.sigma();
    result.tilts_found = tilt.count();
}

}  // namespace

SolvedView solve_view(const WireSolid& wire, const StoneView& start,
                      const std::vector<MetEdge>& edges, double prior_focal_px,
                      const PicturePoint& sight, const SolverSettings& settings) {
    SolvedView result;
    result.facets.assign(wire.solid.facets.size(), FacetChange{0, 0, 0});
    ViewChange change{};
    ViewAtChange view(start, change);
    ceres::Problem::Options at_once;
    at_once.evaluation_callback = &view;
    ceres::Problem problem(at_once);
    problem.AddParameterBlock(change.data(), k_view_unknowns);
    const std::vector<double*> free_blocks = add_edges(
        wire, edges, view.view(), settings.facets_free, change.data(), result.facets, problem);
    const FacetPrior facets{settings.facet_error / std::numbers::sqrt2, settings.facet_offset};
    for (double* block : free_blocks) {
        problem.AddResidualBlock(
            new ceres::AutoDiffCostFunction<FacetPrior, 3, 3>(new FacetPrior(facets)), nullptr,
            block);
    }
    problem.AddResidualBlock(new ceres::AutoDiffCostFunction<LensPrior, 3, k_view_unknowns>(
                                 new LensPrior(lens_prior(start, prior_focal_px, sight, settings))),
                             nullptr, change.data());
    result.converged = minimise(problem, settings.facets_free);
    ceres::Problem::EvaluateOptions raw;
    raw.apply_loss_function = false;
    raw.num_threads = 1;
    problem.GetResidualBlocks(&raw.residual_blocks);
    raw.residual_blocks.resize(edges.size());  // the edges' were added first
    problem.Evaluate(raw, nullptr, &result.residuals, nullptr, nullptr);
    if (settings.with_covariance) set_errors(problem, change.data(), free_blocks, facets, result);
    result.view = changed(start, change);
    return result;
}

}  // namespace culet
