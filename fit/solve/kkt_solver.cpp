#include "fit/solve/kkt_solver.h"
#include "fit/solve/constants.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace culet {

namespace {

bool are_sound(const Eigen::MatrixXd& numbers) {
    return numbers.allFinite() && (numbers.array().abs() < k_kkt.largest).all();
}

bool have_one_pattern(const Eigen::SparseMatrix<double>& a, const Eigen::SparseMatrix<double>& b) {
    return a.rows() == b.rows() && a.nonZeros() == b.nonZeros() &&
           std::equal(a.outerIndexPtr(), a.outerIndexPtr() + a.outerSize() + 1,
                      b.outerIndexPtr()) &&
           std::equal(a.innerIndexPtr(), a.innerIndexPtr() + a.nonZeros(), b.innerIndexPtr());
}

}  // namespace

void KktSolver::assemble(const JacobianRows& rows, const Eigen::VectorXd& stiffness,
                         const std::vector<SymmetricEntry>& curvature, double least) {
    unknowns_ = stiffness.size();
    equations_ = rows.count();
    softened_ = Eigen::VectorXd::Zero(unknowns_ + equations_);
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(rows.column.size() + std::size_t(unknowns_ + equations_) + curvature.size());
    for (Eigen::Index i = 0; i < unknowns_; ++i) entries.emplace_back(i, i, stiffness(i));
    for (const SymmetricEntry& e : curvature) entries.emplace_back(e.row, e.column, e.value);
    for (int i = 0; i < rows.count(); ++i) {
        const Eigen::Index row = unknowns_ + i;
        for (int k = rows.begin[i]; k < rows.begin[i + 1]; ++k) {
            entries.emplace_back(row, rows.column[k], rows.slope[k]);
        }
        const double variance = std::max(rows.variance[i], least);
        softened_(row) = variance - rows.variance[i];
        entries.emplace_back(row, row, -variance);
    }
    matrix_.resize(unknowns_ + equations_, unknowns_ + equations_);
    matrix_.setFromTriplets(entries.begin(), entries.end());
}

bool KktSolver::factor(const JacobianRows& rows, const Eigen::VectorXd& stiffness,
                       const std::vector<SymmetricEntry>& curvature, double least) {
    const Matrix before = std::move(matrix_);
    assemble(rows, stiffness, curvature, least);
    if (!have_one_pattern(before, matrix_)) {
        factors_.analyse(matrix_);
        work_ += k_kkt.ordering_work * double(matrix_.rows());
    }
    work_ += k_kkt.solving_work * double(matrix_.rows());
    if (!factors_.factor(matrix_)) return false;
    const Matrix& lower = factors_.lower();
    for (Eigen::Index j = 0; j < lower.cols(); ++j) {
        const double entries = double(lower.outerIndexPtr()[j + 1] - lower.outerIndexPtr()[j]);
        work_ += 0.5 * entries * (entries + 1);
    }
    // By Sylvester's law of inertia each equation gives one negative pivot.
    return (factors_.pivots().array() < 0).count() == equations_ && factors_.pivots().allFinite();
}

double KktSolver::log_determinant() const {
    return factors_.pivots().array().abs().log().sum();
}

Eigen::VectorXd KktSolver::refined(const Eigen::VectorXd& right, double precision) const {
    Eigen::VectorXd x = factors_.solve(right);
    if (precision >= 1 || !are_sound(x)) return x;
    // Residual of the intended matrix: exact equations have no variance.
    const auto left_by = [&](const Eigen::VectorXd& at) -> Eigen::VectorXd {
        return right - matrix_.selfadjointView<Eigen::Lower>() * at - softened_.cwiseProduct(at);
    };
    const double enough = precision * right.lpNorm<Eigen::Infinity>();
    Eigen::VectorXd left = left_by(x);
    double size = left.lpNorm<Eigen::Infinity>();
    for (int round = 0; round < k_kkt.refinements && size > enough; ++round) {
        const Eigen::VectorXd next = x + factors_.solve(left);
        if (!are_sound(next)) break;
        Eigen::VectorXd next_left = left_by(next);
        const double next_size = next_left.lpNorm<Eigen::Infinity>();
        if (!(next_size < k_kkt.least_progress * size)) break;
        x = next;
        left = std::move(next_left);
        size = next_size;
    }
    return x;
}

KktSolver::Solution KktSolver::solve(const Eigen::VectorXd& a, const Eigen::VectorXd& b,
                                     double precision) const {
    if (a.size() != unknowns_ || b.size() != equations_) {
        throw std::logic_error("right-hand sides of another system than was factored");
    }
    Eigen::VectorXd right(unknowns_ + equations_);
    right << a, b;
    const Eigen::VectorXd x = refined(right, precision);
    return {x.head(unknowns_), x.tail(equations_), are_sound(x)};
}

KktSolver::Solutions KktSolver::solve_all(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b,
                                          double precision) const {
    const Eigen::Index count = std::max(a.cols(), b.cols());
    Solutions all{Eigen::MatrixXd(unknowns_, count), Eigen::MatrixXd(equations_, count), true};
    for (Eigen::Index k = 0; k < count; ++k) {
        Solution one =
            solve(a.cols() > 0 ? Eigen::VectorXd(a.col(k)) : Eigen::VectorXd::Zero(unknowns_),
                  b.cols() > 0 ? Eigen::VectorXd(b.col(k)) : Eigen::VectorXd::Zero(equations_),
                  precision);
        all.unknowns.col(k) = one.unknowns;
        all.multipliers.col(k) = one.multipliers;
        all.good = all.good && one.good;
    }
    return all;
}

}  // namespace culet
