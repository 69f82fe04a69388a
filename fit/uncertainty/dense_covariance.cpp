// The covariance of stones small enough for dense algebra.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "fit/model/constants.h"
#include "fit/model/datum_defect.h"
#include "fit/solve/null_space.h"
#include "fit/uncertainty/constants.h"
#include "fit/uncertainty/covariance.h"
#include "stone/numbers/dense_algebra.h"

namespace culet {

namespace {

// The lower triangle of seen' seen + (weight along)' (weight along).
Eigen::MatrixXd lower_normal(const Eigen::MatrixXd& seen, const Eigen::MatrixXd& along,
                             double weight) {
    Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(seen.cols(), seen.cols());
    add_square(seen, 1, normal);
    add_square(along, weight * weight, normal);
    return normal;
}

// P R^-1 of a QR with sorted rows and column pivoting: (B'B)^-1 = F F', stable row by row whatever
// the weights (Cox & Higham 1998).
Eigen::MatrixXd inverse_factor(const Eigen::MatrixXd& seen) {
    std::vector<Eigen::Index> order(std::size_t(seen.rows()));
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = Eigen::Index(i);
    Eigen::VectorXd size(seen.rows());
    for (Eigen::Index i = 0; i < seen.rows(); ++i) size(i) = seen.row(i).cwiseAbs().maxCoeff();
    std::stable_sort(order.begin(), order.end(),
                     [&](Eigen::Index a, Eigen::Index b) { return size(a) > size(b); });
    Eigen::MatrixXd sorted(seen.rows(), seen.cols());
    for (std::size_t i = 0; i < order.size(); ++i) sorted.row(Eigen::Index(i)) = seen.row(order[i]);
    return PivotedQr(sorted).inverse_factor();
}

// The transpose of row-major rows is column-major, as products need it.
DenseRows rows_times(const DenseRows& rows, const MatrixView& columns) {
    return transpose_times(columns, rows.transpose()).transpose();
}

}  // namespace

// The directions that the hard equations leave free, in a basis.
struct Covariance::FreePart {
    const DenseRows& basis;
    DenseRows seen;         // by the rows
    Eigen::MatrixXd along;  // components along the gauge motions
};

void Covariance::find_dense() {
    const DenseRows basis =
        free_directions(linear_.hard_rows, linear_.layout.point(0), linear_.layout.extra(0));
    const Eigen::MatrixXd gauge = datum_defect(linear_);
    held_.resize(linear_.layout.size(), 0);
    seen_.resize(linear_.soft_rows.rows(), 0);
    leverages_ = Eigen::VectorXd::Zero(linear_.soft_rows.rows());
    usable_ = true;
    if (basis.cols() == 0) return;  // exact readings leave nothing free

    // Readings do not see the gauge: it counts as determined and is removed at the end.
    const Eigen::MatrixXd gauge_rows = linear_.metric.asDiagonal() * gauge;
    const FreePart free{basis, linear_.soft_rows * basis,
                        product(basis.transpose(), gauge_rows).transpose()};
    if (!find_well_determined(free)) usable_ = find_poorly_determined(free);
    for (DenseRows* columns : {&held_, &open_}) {
        const Eigen::MatrixXd parts = product(columns->transpose(), gauge_rows);
        *columns -= times_transpose(parts, gauge).transpose();
    }
    leverages_ = seen_.rowwise().squaredNorm();
}

// Cholesky factor of the normal equations, if readings surely determine every direction, and none
// far more tightly than others; else false.
bool Covariance::find_well_determined(const FreePart& free) {
    double largest = 0;
    for (Eigen::Index i = 0; i < linear_.soft_rows.rows(); ++i) {
        // In the metric, no row is longer on the free directions than on all.
        double square = 0;
        for (FunctionRows::InnerIterator it(linear_.soft_rows, i); it; ++it) {
            square += it.value() * it.value() / linear_.metric(it.col());
        }
        largest = std::max(largest, std::sqrt(square));
    }
    if (!(largest < k_cov.most_spread)) return false;
    const double gauge_weight = std::max(k_cov.least_of_gauge, largest);
    const Eigen::Index size = free.basis.cols();
    const Cholesky factor(lower_normal(free.seen, free.along, gauge_weight));
    if (!factor.good()) return false;
    const Eigen::MatrixXd upper = factor.solve_upper(Eigen::MatrixXd::Identity(size, size));
    // (S^-1) = U^-1 U^-T
    held_ = upper_transpose_times(upper, free.basis.transpose()).transpose();
    seen_ = linear_.soft_rows * held_;
    // An unobservable direction would leave some unknown this uncertain.
    const Eigen::VectorXd left = held_.rowwise().squaredNorm().cwiseProduct(linear_.metric);
    if (!linear_.has_prior && !(left.maxCoeff() < 1 / k_shapes.determined)) return false;
    // Every direction is seen once, so all squares add up to their number, but for rounding errors.
    const double squares =
        seen_.squaredNorm() + std::pow(gauge_weight, 2) * product(free.along, upper).squaredNorm();
    return std::abs(squares - double(size)) < k_cov.precision;
}

// QR, whitened by the metric so that eigenvalues compare readings with the mesh.
bool Covariance::find_poorly_determined(const FreePart& free) {
    const Eigen::Index size = free.basis.cols();
    Eigen::MatrixXd metric = Eigen::MatrixXd::Zero(size, size);
    add_square(linear_.metric.cwiseSqrt().asDiagonal() * free.basis, 1, metric);
    const Cholesky chol(metric);
    if (!chol.good()) return false;
    const auto whitened = [&](const Eigen::MatrixXd& rows) -> Eigen::MatrixXd {
        if (rows.rows() == 0) return Eigen::MatrixXd(0, size);
        return chol.divide_by_upper(rows);
    };
    const Eigen::MatrixXd seen = whitened(free.seen);
    const Eigen::MatrixXd along = whitened(free.along);

    const Eigen::VectorXd norms = seen.rowwise().norm();
    const double largest = norms.size() > 0 ? norms.maxCoeff() : 0;
    const double gauge_weight = std::clamp(largest, k_cov.least_of_gauge, k_shapes.tight);
    Eigen::MatrixXd clipped = seen;
    for (Eigen::Index i = 0; i < norms.size(); ++i) {
        if (norms(i) > k_shapes.tight) clipped.row(i) *= k_shapes.tight / norms(i);
    }
    Eigen::MatrixXd normal = lower_normal(clipped, along, gauge_weight);
    const auto unwhitened = [&](const Eigen::MatrixXd& columns) -> DenseRows {
        return rows_times(free.basis, chol.solve_upper(columns));
    };
    Eigen::MatrixXd held_basis = Eigen::MatrixXd::Identity(size, size);
    const Eigen::MatrixXd shifted =
        normal - k_shapes.determined * Eigen::MatrixXd::Identity(size, size);
    open_.resize(held_.rows(), 0);
    if (!linear_.has_prior && !Cholesky(shifted).good()) {
        const SymmetricEigen eigen = symmetric_eigen(normal);
        const DenseRows directions = unwhitened(eigen.vectors);
        const Eigen::Index open = count_unobservable(directions, eigen.values, linear_.metric);
        open_ = directions.leftCols(open);
        rank_defect_ = static_cast<int>(open);
        held_basis = eigen.vectors.rightCols(size - open);
    }
    if (held_basis.cols() == 0) {
        held_.resize(held_.rows(), 0);
        seen_.resize(seen_.rows(), 0);
        return true;
    }
    Eigen::MatrixXd stacked(seen.rows() + along.rows(), held_basis.cols());
    stacked.topRows(seen.rows()) = product(seen, held_basis);
    stacked.bottomRows(along.rows()) = gauge_weight * product(along, held_basis);
    const Eigen::MatrixXd factor = inverse_factor(stacked);
    held_ = unwhitened(product(held_basis, factor));
    seen_ = product(stacked.topRows(seen.rows()), factor);
    return true;
}

}  // namespace culet
