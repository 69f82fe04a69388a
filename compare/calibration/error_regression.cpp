#include "compare/calibration/error_regression.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "stone/numbers/dense_algebra.h"

namespace culet {

namespace {

// Ridge penalties that are tried, for standardised scores.
constexpr double k_least_penalty = 1e-3, k_most_penalty = 1e4, k_penalty_step = 1.5;
constexpr double k_constant = 1e-9;  // a score with a smaller spread counts as constant
constexpr Eigen::Index k_least_draws = 3;

Eigen::VectorXd shrinkage(const Eigen::VectorXd& sizes, double penalty) {
    const Eigen::ArrayXd squares = sizes.array().square();
    return (squares / (squares + penalty)).matrix();
}

// By generalised cross-validation (Golub, Heath and Wahba 1979). `along`: `wanted` in the basis u.
double best_penalty(const SingularValues& parts, const Eigen::VectorXd& along,
                    const Eigen::VectorXd& wanted) {
    double best = std::numeric_limits<double>::infinity(), penalty = k_most_penalty;
    for (double tried = k_least_penalty; tried <= k_most_penalty; tried *= k_penalty_step) {
        const Eigen::VectorXd kept = shrinkage(parts.values, tried);
        const double off = (wanted - parts.u * kept.cwiseProduct(along)).squaredNorm();
        // One more degree of freedom for the mean.
        const double left = 1 - (kept.sum() + 1) / static_cast<double>(wanted.size());
        if (left > 0 && off / (left * left) < best) {
            best = off / (left * left);
            penalty = tried;
        }
    }
    return penalty;
}

}  // namespace

ErrorRegression::ErrorRegression(std::vector<double> log_errors,
                                 std::vector<std::vector<double>> scores)
    : log_errors_(std::move(log_errors)), scores_(std::move(scores)) {
    if (scores_.empty()) return;
    std::vector<std::size_t> all(scores_.front().size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    complete_ = fit(all);
    if (complete_) left_out_ = complete_->left_out;
}

std::optional<ErrorRegression::Fit> ErrorRegression::fit(
    const std::vector<std::size_t>& known) const {
    std::vector<std::size_t> draws;
    for (std::size_t i = 0; i < scores_.size(); ++i) {
        if (std::none_of(known.begin(), known.end(),
                         [&](std::size_t k) { return std::isnan(scores_[i][k]); }))
            draws.push_back(i);
    }
    const auto rows = static_cast<Eigen::Index>(draws.size()),
               columns = static_cast<Eigen::Index>(known.size());
    if (rows < k_least_draws || columns == 0) return std::nullopt;
    Eigen::MatrixXd matrix(rows, columns);
    Eigen::VectorXd wanted(rows);
    for (Eigen::Index i = 0; i < rows; ++i) {
        const std::size_t draw = draws[static_cast<std::size_t>(i)];
        wanted[i] = log_errors_[draw];
        for (Eigen::Index k = 0; k < columns; ++k)
            matrix(i, k) = scores_[draw][known[static_cast<std::size_t>(k)]];
    }
    const double mean = wanted.mean();
    const Eigen::RowVectorXd means = matrix.colwise().mean();
    matrix.rowwise() -= means;
    const double n = static_cast<double>(rows);
    Eigen::RowVectorXd deviations = (matrix.colwise().squaredNorm() / n).cwiseSqrt();
    deviations = (deviations.array() > k_constant).select(deviations, 1.0);
    matrix = matrix.array().rowwise() / deviations.array();
    wanted.array() -= mean;

    const SingularValues parts = singular_values(matrix);
    const Eigen::VectorXd& sizes = parts.values;
    const Eigen::VectorXd along = parts.u.transpose() * wanted;
    const Eigen::VectorXd kept = shrinkage(sizes, best_penalty(parts, along, wanted));
    const Eigen::VectorXd turned =
        (kept.array() > 0)
            .select(kept.array() / sizes.array().max(std::numeric_limits<double>::min()), 0.0)
            .matrix()
            .cwiseProduct(along);
    const Eigen::VectorXd weights = (parts.v * turned).cwiseQuotient(deviations.transpose());
    Fit result;
    result.weights.assign(weights.begin(), weights.end());
    result.constant = mean - means.dot(weights);
    result.left_out.assign(scores_.size(), std::numeric_limits<double>::quiet_NaN());
    const Eigen::VectorXd answers = parts.u * kept.cwiseProduct(along);
    for (Eigen::Index i = 0; i < rows; ++i) {
        const double leverage =
            1 / n + (parts.u.row(i).transpose().cwiseAbs2().cwiseProduct(kept)).sum();
        result.left_out[draws[static_cast<std::size_t>(i)]] =
            (answers[i] - wanted[i]) / std::max(1e-6, 1 - leverage);
    }
    return result;
}

std::optional<double> ErrorRegression::of(const std::vector<double>& scores) const {
    std::vector<std::size_t> known;
    for (std::size_t k = 0; k < scores.size(); ++k)
        if (!std::isnan(scores[k])) known.push_back(k);
    const std::optional<Fit> fitted = known.size() == scores.size() ? complete_ : fit(known);
    if (!fitted) return std::nullopt;
    double answer = fitted->constant;
    for (std::size_t k = 0; k < known.size(); ++k) answer += fitted->weights[k] * scores[known[k]];
    return answer;
}

}  // namespace culet
