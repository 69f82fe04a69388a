#include "fit/uncertainty/sparse_covariance.h"

#include <algorithm>
#include <cmath>

#include "fit/model/datum_defect.h"

namespace culet {

namespace {

// Weights on as many unknowns as there are motions, those that move most (elimination with complete
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

FunctionRow function_row(const Eigen::SparseMatrix<double, Eigen::RowMajor>& rows, Eigen::Index i) {
    FunctionRow row(rows.cols());
    for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator it(rows, i); it; ++it) {
        row.coeffRef(it.col()) += it.value();
    }
    return row;
}

void Covariance::find_sparse(const Linearised& linear) {
    // Hard equations as very tight soft ones: their own variance stays far below the readings', and
    // the matrix positive definite whatever repeats.
    double tightest = 0;
    Eigen::SparseMatrix<double, Eigen::RowMajor> rows = rows_;
    Eigen::VectorXd norms(rows.rows());
    for (Eigen::Index i = 0; i < rows.rows(); ++i) {
        norms(i) = rows.innerVector(i).norm();
        if (norms(i) > k_tight) {
            rows.innerVector(i) *= k_tight / norms(i);
            norms(i) = k_tight;
        }
        tightest = std::max(tightest, norms(i));
    }
    const double hard = std::clamp(1e3 * tightest, 1e4, 1e6);
    sparse_ = std::make_unique<Sparse>();
    sparse_->gauge = datum_defect(linear, rows_);
    sparse_->gauge_rows = linear.metric.asDiagonal() * sparse_->gauge;
    sparse_->pins = pins(sparse_->gauge, std::max(1e6, tightest * tightest));
    sparse_->prior = 1e-3;
    const auto equations = [&](double prior) {
        return NormalEquations{rows, linear.hard_rows, hard, prior * linear.metric + sparse_->pins};
    };
    if (!sparse_->compute(sparse_->tight, equations(sparse_->prior))) return;
    usable_ = true;
    rows_ = rows;
    // By Sylvester's law the number of negative pivots counts the directions below the bound.
    open_freedoms_ = negative_pivots(equations(-k_determined));
    if (open_freedoms_ > 0) {
        sparse_->has_open = sparse_->compute(sparse_->trusted, equations(1.0));
        usable_ = sparse_->has_open;
    }
    if (!usable_) return;
    leverages_.resize(rows_.rows());
    for (Eigen::Index i = 0; i < rows_.rows(); ++i) {
        leverages_(i) =
            norms(i) > 0 ? std::min(1.0, sparse_->of(sparse_->tight, function_row(rows_, i))) : 0;
    }
}

}  // namespace culet
