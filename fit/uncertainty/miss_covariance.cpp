#include "fit/uncertainty/miss_covariance.h"

#include <cmath>

#include "fit/solve/null_space.h"
#include "fit/uncertainty/inference.h"

namespace culet {

namespace {

using Rows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

// Beyond so many parameters the cube of their number is the larger effort.
constexpr Eigen::Index k_most_dense = 1000;
// Weights of readings, in the metric. Squared and beside what nothing holds they leave half of a
// number's digits.
constexpr double k_most_weight = 1e4;
// Likewise coefficients of the basis. What is left of a condition's variance given the others has
// six digits then.
constexpr double k_most_growth = 1e6, k_least_own = 1e-10;

// Adds factor row' row to the lower half.
void add_square(const Rows& rows, Eigen::Index i, double factor, Eigen::MatrixXd& to) {
    for (Rows::InnerIterator a(rows, i); a; ++a) {
        const double scaled = factor * a.value();
        for (Rows::InnerIterator b(rows, i); b && b.col() <= a.col(); ++b) {
            to(a.col(), b.col()) += scaled * b.value();
        }
    }
}

double largest_weight(const Linearised& linear) {
    double most = 0;
    for (Eigen::Index i = 0; i < linear.soft_rows.rows(); ++i) {
        double square = 0;
        for (Rows::InnerIterator it(linear.soft_rows, i); it; ++it) {
            square += it.value() * it.value() / linear.metric(it.col());
        }
        most = std::max(most, square);
    }
    return std::sqrt(most);
}

}  // namespace

std::optional<Eigen::MatrixXd> miss_covariance(const Linearised& linear, const Combinations& kept,
                                               const Combinations& tested) {
    if (tested.rows() == 0) return Eigen::MatrixXd(0, 0);
    const double weight = largest_weight(linear);
    if (!(weight < k_most_weight)) return std::nullopt;
    const FreeDirections free =
        free_directions(kept * linear.hard_rows, linear.layout.point(0), linear.layout.extra(0));
    const Eigen::Index size = free.basis.cols();
    if (size > k_most_dense || !(free.growth < k_most_growth)) return std::nullopt;

    Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(size, size);
    const Rows seen = linear.soft_rows * free.basis;
    for (Eigen::Index i = 0; i < seen.rows(); ++i) add_square(seen, i, 1, normal);
    for (Eigen::Index i = 0; i < free.basis.rows(); ++i) {
        add_square(free.basis, i, linear.metric(i) / k_unheld_variance, normal);
    }
    // Motions that nothing sees are held; whatever the weight, no condition is missed by them.
    for (const Eigen::VectorXd& gauge : linear.gauge_rows) {
        const Eigen::VectorXd along = weight * (free.basis.transpose() * gauge);
        normal.selfadjointView<Eigen::Lower>().rankUpdate(along);
    }
    const Eigen::LLT<Eigen::MatrixXd> factor(std::move(normal));
    if (factor.info() != Eigen::Success) return std::nullopt;
    const Rows missed = (tested * linear.hard_rows) * free.basis;
    Eigen::MatrixXd half = Eigen::MatrixXd(missed.transpose());
    factor.matrixL().solveInPlace(half);
    Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(tested.rows(), tested.rows());
    covariance.selfadjointView<Eigen::Lower>().rankUpdate(half.transpose());
    const Eigen::LLT<Eigen::MatrixXd> own(covariance);
    if (own.info() != Eigen::Success) return std::nullopt;
    for (Eigen::Index i = 0; i < covariance.rows(); ++i) {
        const double left = own.matrixLLT()(i, i);
        if (!(left * left > k_least_own * covariance(i, i))) return std::nullopt;
    }
    return Eigen::MatrixXd(covariance.selfadjointView<Eigen::Lower>());
}

}  // namespace culet
