#include "fit/uncertainty/covariance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "fit/uncertainty/constants.h"
#include "fit/uncertainty/sparse_covariance.h"
#include "stone/numbers/dense_algebra.h"

namespace culet {

namespace {

constexpr double k_unknown = std::numeric_limits<double>::quiet_NaN();

Eigen::RowVectorXd times_columns(const FunctionRow& function, const DenseRows& columns) {
    Eigen::RowVectorXd result = Eigen::RowVectorXd::Zero(columns.cols());
    for (FunctionRow::InnerIterator it(function); it; ++it) {
        result += it.value() * columns.row(it.index());
    }
    return result;
}

}  // namespace

Covariance::Covariance(Linearised linear, Algorithm algorithm)
    : linear_(std::move(linear)), open_(linear_.layout.size(), 0) {
    const bool small = linear_.layout.size() <= k_cov.most_dense;
    if (algorithm == Algorithm::dense || (algorithm == Algorithm::by_size && small)) {
        find_dense();
    } else {
        find_sparse();
    }
    if (!usable_) leverages_ = Eigen::VectorXd::Constant(linear_.soft_rows.rows(), k_unknown);
}

Covariance::~Covariance() = default;

double Covariance::variance(const FunctionRow& function) const {
    if (!usable_) return k_unknown;
    if (!sparse_) return times_columns(function, held_).squaredNorm();
    return sparse_->has_open
               ? std::max(0.0, total_variance(function) - sparse_->open_variance(function))
               : total_variance(function);
}

double Covariance::open_variance(const FunctionRow& function) const {
    if (!usable_) return k_unknown;
    return sparse_ ? sparse_->open_variance(function)
                   : times_columns(function, open_).squaredNorm();
}

double Covariance::total_variance(const FunctionRow& function) const {
    if (!usable_) return k_unknown;
    if (!sparse_) return variance(function) + open_variance(function);
    return sparse_->of(sparse_->has_open ? sparse_->trusted : sparse_->tight, function);
}

Eigen::MatrixXd Covariance::joint(const FunctionRows& functions) const {
    Eigen::MatrixXd all(functions.rows(), functions.rows());
    if (!usable_) return Eigen::MatrixXd::Constant(functions.rows(), functions.rows(), k_unknown);
    if (sparse_) {
        for (Eigen::Index i = 0; i < functions.rows(); ++i) {
            all.col(i) = functions * with_all(function_row(functions, i), false);
        }
    } else {
        const DenseRows halves = functions * held_, open = functions * open_;
        all = transpose_times(halves.transpose(), halves.transpose());
        if (open.cols() > 0)
            all +=
                k_cov.undetermined_variance * transpose_times(open.transpose(), open.transpose());
    }
    return 0.5 * (all + all.transpose());
}

Eigen::VectorXd Covariance::with_all(const FunctionRow& function, bool open) const {
    if (sparse_) {
        return sparse_->with_all(open && sparse_->has_open ? sparse_->trusted : sparse_->tight,
                                 Eigen::VectorXd(function));
    }
    Eigen::VectorXd all = held_ * times_columns(function, held_).transpose();
    if (open) all += open_ * times_columns(function, open_).transpose();
    return all;
}

Eigen::VectorXd Covariance::step() const {
    const Eigen::VectorXd& residuals = linear_.soft_residuals;
    if (sparse_) return -sparse_->with_all(sparse_->tight, sparse_->rows.transpose() * residuals);
    return -held_ * (seen_.transpose() * residuals);
}

Eigen::VectorXd Covariance::fitted_part(const Eigen::VectorXd& residuals) const {
    if (!sparse_) {
        Eigen::RowVectorXd along = Eigen::RowVectorXd::Zero(seen_.cols());
        for (Eigen::Index i = 0; i < residuals.size(); ++i) {
            if (residuals(i) != 0) along += residuals(i) * seen_.row(i);
        }
        return seen_ * along.transpose();
    }
    return sparse_->rows * sparse_->with_all(sparse_->tight, sparse_->rows.transpose() * residuals);
}

Eigen::VectorXd Covariance::leverage_column(Eigen::Index equation) const {
    if (!sparse_) return seen_ * seen_.row(equation).transpose();
    return sparse_->rows * with_all(function_row(sparse_->rows, equation), false);
}

}  // namespace culet
