#include "fit/uncertainty/sparse_covariance.h"

#include <algorithm>
#include <cmath>

#include "fit/model/constants.h"
#include "fit/model/datum_defect.h"
#include "fit/uncertainty/constants.h"

namespace culet {

namespace {

// Weights on as many unknowns as motions: those that move most (elimination with complete
// pivoting).
Eigen::VectorXd pins(Eigen::MatrixXd motions, double weight) {
    Eigen::VectorXd result = Eigen::VectorXd::Zero(motions.rows());
    for (Eigen::Index k = 0; k < motions.cols(); ++k) {
        Eigen::Index row = 0, column = 0;
        if (!(motions.cwiseAbs().maxCoeff(&row, &column) > 0)) break;
        result(row) = weight;
        const Eigen::VectorXd pivot = motions.col(column) / motions(row, column);
        motions -= pivot * Eigen::RowVectorXd(motions.row(row));
        motions.row(row).setZero();
    }
    return result;
}

}  // namespace

Covariance::Sparse::Sparse(const Linearised& of)
    : linear(of), rows(of.soft_rows), sizes(of.soft_rows.rows()), gauge_(datum_defect(of)) {
    double tightest = 0;
    for (Eigen::Index i = 0; i < rows.rows(); ++i) {
        sizes(i) = rows.innerVector(i).norm();
        if (sizes(i) > k_shapes.tight) {
            rows.innerVector(i) *= k_shapes.tight / sizes(i);
            sizes(i) = k_shapes.tight;
        }
        tightest = std::max(tightest, sizes(i));
    }
    // Hard equations become very tight soft ones, far below the readings' variances; so the matrix
    // stays positive definite even if they repeat.
    hard_weight_ = std::clamp(1e3 * tightest, 1e4, 1e6);
    gauge_rows_ = linear.metric.asDiagonal() * gauge_;
    pins_ = pins(gauge_, std::max(1e6, tightest * tightest));
}

NormalEquations Covariance::Sparse::equations(double prior) const {
    return {rows, linear.hard_rows, hard_weight_, prior * linear.metric + pins_};
}

bool Covariance::Sparse::compute(PinnedInverse& pinned, double prior) const {
    if (!pinned.inverse.compute(equations(prior))) return false;
    pinned.gauge_solved.resize(gauge_.rows(), gauge_.cols());
    for (Eigen::Index k = 0; k < gauge_.cols(); ++k) {
        pinned.gauge_solved.col(k) = pinned.inverse.solve(gauge_rows_.col(k));
    }
    pinned.gauge_part = gauge_rows_.transpose() * pinned.gauge_solved;
    return true;
}

double Covariance::Sparse::of(const PinnedInverse& pinned, const FunctionRow& function) const {
    const Eigen::VectorXd along = gauge_.transpose() * function;
    return std::max(0.0, pinned.inverse.quadratic(function) +
                             along.dot(pinned.gauge_part * along -
                                       2 * (pinned.gauge_solved.transpose() * function)));
}

Eigen::VectorXd Covariance::Sparse::with_all(const PinnedInverse& pinned,
                                             const Eigen::VectorXd& function) const {
    const Eigen::VectorXd along = gauge_.transpose() * function;
    Eigen::VectorXd all = pinned.inverse.solve(function) - pinned.gauge_solved * along;
    all -= gauge_ * (gauge_rows_.transpose() * all);
    return all;
}

double Covariance::Sparse::most_open() const {
    double most = 0;
    FunctionRow own(linear.layout.size());
    for (Eigen::Index i = 0; i < own.size(); ++i) {
        own.setZero();
        own.coeffRef(i) = 1;
        most += std::floor(of(tight, own) * linear.metric(i) * k_shapes.determined);
    }
    return most;
}

double Covariance::Sparse::open_variance(const FunctionRow& function) const {
    if (!has_open) return 0;
    return std::max(0.0, of(tight, function) - of(trusted, function)) *
           (1 / k_cov.undetermined_variance);
}

void Covariance::find_sparse() {
    sparse_ = std::make_unique<Sparse>(linear_);
    usable_ = sparse_->compute(sparse_->tight, (1 / k_cov.undetermined_variance));
    if (!usable_) return;
    const double most = linear_.has_prior ? 0 : sparse_->most_open();
    if (most > 0) {
        // By Sylvester's law the negative pivots count the directions below the bound.
        const int below = negative_pivots(sparse_->equations(-k_shapes.determined));
        rank_defect_ = static_cast<int>(std::min(most, double(below)));
        sparse_->has_open = rank_defect_ > 0;
        if (sparse_->has_open) usable_ = sparse_->compute(sparse_->trusted, 1);
        if (!usable_) return;
    }
    leverages_.resize(sparse_->rows.rows());
    for (Eigen::Index i = 0; i < leverages_.size(); ++i) {
        leverages_(i) =
            sparse_->sizes(i) > 0
                ? std::min(1.0, sparse_->of(sparse_->tight, function_row(sparse_->rows, i)))
                : 0;
    }
}

}  // namespace culet
