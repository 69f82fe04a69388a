#include "fit/uncertainty/covariance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "fit/uncertainty/sparse_covariance.h"

namespace culet {

namespace {

// Dense algebra grows with the cube of the unknowns; beyond this many it is the slower one.
constexpr Eigen::Index k_most_dense = 1300;

Eigen::RowVectorXd product(const FunctionRow& function, const DenseRows& columns) {
    Eigen::RowVectorXd result = Eigen::RowVectorXd::Zero(columns.cols());
    for (FunctionRow::InnerIterator it(function); it; ++it) {
        result += it.value() * columns.row(it.index());
    }
    return result;
}

}  // namespace

Covariance::Covariance(const Linearised& linear, Algorithm algorithm)
    : rows_(linear.soft_rows) {
    const bool small = linear.layout.size() <= k_most_dense;
    if (algorithm == Algorithm::dense || (algorithm == Algorithm::by_size && small)) {
        find_dense(linear);
    } else {
        find_sparse(linear);
    }
    if (!usable_) {
        leverages_ =
            Eigen::VectorXd::Constant(rows_.rows(), std::numeric_limits<double>::quiet_NaN());
    }
}

Covariance::~Covariance() = default;

std::optional<DenseRows> Covariance::halves(const std::vector<FunctionRow>& functions) const {
    if (!usable_ || sparse_) return std::nullopt;
    DenseRows all(Eigen::Index(functions.size()), held_.cols() + open_.cols());
    for (std::size_t i = 0; i < functions.size(); ++i) {
        all.row(Eigen::Index(i)) << product(functions[i], held_), product(functions[i], open_);
    }
    return all;
}

double Covariance::variance(const FunctionRow& function) const {
    if (!usable_) return std::numeric_limits<double>::quiet_NaN();
    if (!sparse_) return product(function, held_).squaredNorm();
    const double loose = sparse_->of(sparse_->tight, function);
    if (!sparse_->has_open) return loose;
    const double trusted = sparse_->of(sparse_->trusted, function);
    return std::max(0.0, trusted - std::max(0.0, loose - trusted) * sparse_->prior);
}

double Covariance::total_variance(const FunctionRow& function) const {
    if (!usable_) return std::numeric_limits<double>::quiet_NaN();
    if (!sparse_) return variance(function) + open_variance(function);
    return sparse_->of(sparse_->has_open ? sparse_->trusted : sparse_->tight, function);
}

double Covariance::open_variance(const FunctionRow& function) const {
    if (!usable_) return std::numeric_limits<double>::quiet_NaN();
    if (!sparse_) return product(function, open_).squaredNorm();
    if (!sparse_->has_open) return 0;
    // An open direction of length q has the variance q^2 / (lambda + prior): what the two priors
    // disagree on.
    const double loose = sparse_->of(sparse_->tight, function),
                 trusted = sparse_->of(sparse_->trusted, function);
    return std::max(0.0, loose - trusted) * sparse_->prior;
}

Eigen::VectorXd Covariance::with_all(const FunctionRow& function, bool open) const {
    if (!sparse_) {
        Eigen::VectorXd all = held_ * product(function, held_).transpose();
        if (open) all += open_ * product(function, open_).transpose();
        return all;
    }
    return sparse_->with_all(open && sparse_->has_open ? sparse_->trusted : sparse_->tight,
                             function);
}

Eigen::VectorXd Covariance::fitted_part(const Eigen::VectorXd& residuals) const {
    if (!sparse_) {
        Eigen::RowVectorXd along = Eigen::RowVectorXd::Zero(seen_.cols());
        for (Eigen::Index i = 0; i < residuals.size(); ++i) {
            if (residuals(i) != 0) along += residuals(i) * seen_.row(i);
        }
        return seen_ * along.transpose();
    }
    const Eigen::VectorXd all = rows_.transpose() * residuals;
    return rows_ * sparse_->with_all(sparse_->tight, FunctionRow(all.sparseView()));
}

double Covariance::fitted_square(const std::vector<std::pair<Eigen::Index, double>>& s) const {
    if (!sparse_) {
        Eigen::RowVectorXd along = Eigen::RowVectorXd::Zero(seen_.cols());
        for (const auto& [i, value] : s) along += value * seen_.row(i);
        return along.squaredNorm();
    }
    Eigen::VectorXd all = Eigen::VectorXd::Zero(rows_.rows());
    for (const auto& [i, value] : s) all(i) = value;
    return all.dot(fitted_part(all));
}

double Covariance::leverage(Eigen::Index equation, Eigen::Index other) const {
    if (!sparse_) return seen_.row(equation).dot(seen_.row(other));
    const auto key = std::minmax(equation, other);
    const auto [found, is_new] = sparse_->leverages.try_emplace(key, 0.0);
    if (is_new) {
        const auto part_of = [&](Eigen::Index i) -> const Sparse::Part& {
            auto [part, unknown] = sparse_->parts.try_emplace(i);
            if (unknown) part->second = sparse_->part_of(sparse_->tight, function_row(rows_, i));
            return part->second;
        };
        const Sparse::Part &a = part_of(key.first), &b = part_of(key.second);
        found->second = sparse_->of(sparse_->tight, a, b);
    }
    return found->second;
}

Eigen::VectorXd Covariance::leverage_column(Eigen::Index equation) const {
    if (!sparse_) return seen_ * seen_.row(equation).transpose();
    return rows_ * with_all(function_row(rows_, equation), false);
}

}  // namespace culet
