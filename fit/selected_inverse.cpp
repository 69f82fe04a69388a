#include "fit/selected_inverse.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

namespace culet {

namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;
using Rows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

// A row of more entries than this touches more than a few facets and their corners.
constexpr Eigen::Index k_long = 90;
// With more long rows than this, keeping them apart costs more than the fill that they make.
constexpr std::size_t k_most_long = 48;

struct Parts {
    Eigen::SparseMatrix<double> matrix;
    std::vector<Eigen::Index> long_rows;
};

Parts assembled(const NormalEquations& equations) {
    Parts parts;
    const Rows& rows = equations.rows;
    for (Eigen::Index i = 0; i < rows.rows(); ++i) {
        if (rows.innerVector(i).nonZeros() > k_long) parts.long_rows.push_back(i);
    }
    if (parts.long_rows.size() > k_most_long) parts.long_rows.clear();
    Rows kept = rows;
    for (const Eigen::Index i : parts.long_rows) {
        for (Rows::InnerIterator it(kept, i); it; ++it) it.valueRef() = 0;
    }
    kept.prune(0.0, 0.0);
    const Eigen::SparseMatrix<double> columns(kept), hard(equations.hard_rows);
    parts.matrix = Eigen::SparseMatrix<double>(columns.transpose()) * columns;
    parts.matrix +=
        equations.hard_weight * equations.hard_weight *
        Eigen::SparseMatrix<double>(Eigen::SparseMatrix<double>(hard.transpose()) * hard);
    // The three unknowns of a facet or point belong together even when nothing joins them.
    Triplets diagonal;
    for (Eigen::Index i = 0; i < equations.diagonal.size(); ++i) {
        diagonal.emplace_back(i, i, equations.diagonal(i));
        for (Eigen::Index k = 3 * (i / 3); k < std::min(3 * (i / 3) + 3, equations.diagonal.size());
             ++k) {
            if (k != i) diagonal.emplace_back(i, k, 0.0);
        }
    }
    Eigen::SparseMatrix<double> priors(equations.diagonal.size(), equations.diagonal.size());
    priors.setFromTriplets(diagonal.begin(), diagonal.end());
    parts.matrix += priors;
    parts.matrix.makeCompressed();
    return parts;
}

}  // namespace

bool SelectedInverse::compute(const NormalEquations& equations) {
    const Parts parts = assembled(equations);
    factor_.compute(parts.matrix);
    if (factor_.info() != Eigen::Success) return false;
    const Eigen::VectorXd pivots = factor_.vectorD();
    if (!(pivots.minCoeff() > 0)) return false;
    place_ = factor_.permutationP().indices();

    // Takahashi's recurrence from the last column to the first, for Z = (L D L')^-1:
    // z_jj = 1/d_j - sum_k l_kj z_kj and z_ij = -sum_k l_kj z_ik, k over the entries of column j.
    inverse_ =
        factor_.matrixL();  // unit lower triangle; its pattern is closed under the recurrence
    inverse_.makeCompressed();
    const Eigen::Index n = inverse_.cols();
    const Eigen::SparseMatrix<double> lower = inverse_;
    const int* start = inverse_.outerIndexPtr();
    const int* index = inverse_.innerIndexPtr();
    double* z = inverse_.valuePtr();
    const double* l = lower.valuePtr();
    std::vector<double> column;
    std::vector<int> where(std::size_t(n), -1);
    for (Eigen::Index j = n - 1; j >= 0; --j) {
        const int begin = start[j], end = start[j + 1];
        const int count = end - begin - 1;  // below the diagonal
        column.assign(std::size_t(count), 0.0);
        for (int a = 0; a < count; ++a) where[std::size_t(index[begin + 1 + a])] = a;
        for (int a = 0; a < count; ++a) {
            // Column k of Z, k = the a-th row of column j: its entries among the rows of column j.
            const int k = index[begin + 1 + a];
            const double lkj = l[begin + 1 + a];
            for (int at = start[k]; at < start[k + 1]; ++at) {
                const int b = where[std::size_t(index[at])];
                if (b < 0) continue;
                column[std::size_t(b)] -= lkj * z[at];
                if (b != a) column[std::size_t(a)] -= l[begin + 1 + b] * z[at];
            }
        }
        double diagonal = 1 / pivots(j);
        for (int a = 0; a < count; ++a) {
            z[begin + 1 + a] = column[std::size_t(a)];
            diagonal -= l[begin + 1 + a] * column[std::size_t(a)];
            where[std::size_t(index[begin + 1 + a])] = -1;
        }
        z[begin] = diagonal;
    }

    wide_.resize(n, 0);
    if (!parts.long_rows.empty()) {
        const Eigen::Index count = Eigen::Index(parts.long_rows.size());
        Eigen::MatrixXd long_rows(count, n);
        for (Eigen::Index i = 0; i < count; ++i) {
            long_rows.row(i) =
                Eigen::RowVectorXd(equations.rows.row(parts.long_rows[std::size_t(i)]));
        }
        wide_ = factor_.solve(long_rows.transpose());
        capacitance_.compute(Eigen::MatrixXd::Identity(count, count) + long_rows * wide_);
    }
    return true;
}

double SelectedInverse::entry(Eigen::Index row, Eigen::Index column) const {
    const int i = std::max(place_(row), place_(column)), j = std::min(place_(row), place_(column));
    const int* begin = inverse_.innerIndexPtr() + inverse_.outerIndexPtr()[j];
    const int* end = inverse_.innerIndexPtr() + inverse_.outerIndexPtr()[j + 1];
    const int* found = std::lower_bound(begin, end, i);
    if (found == end || *found != i) return std::numeric_limits<double>::quiet_NaN();
    return inverse_.valuePtr()[found - inverse_.innerIndexPtr()];
}

double SelectedInverse::quadratic(const Eigen::SparseVector<double>& f) const {
    return bilinear(f, f);
}

double SelectedInverse::bilinear(const Eigen::SparseVector<double>& f,
                                 const Eigen::SparseVector<double>& g) const {
    double sum = 0;
    for (Eigen::SparseVector<double>::InnerIterator a(f); a && !std::isnan(sum); ++a) {
        if (a.value() == 0) continue;
        for (Eigen::SparseVector<double>::InnerIterator b(g); b; ++b) {
            if (b.value() != 0) sum += a.value() * b.value() * entry(a.index(), b.index());
        }
    }
    if (std::isnan(sum)) {
        const Eigen::VectorXd right = g;
        sum = f.dot(factor_.solve(right));
    }
    if (wide_.cols() > 0) {
        const Eigen::VectorXd along = wide_.transpose() * f, along_g = wide_.transpose() * g;
        sum -= capacitance_.matrixL().solve(along).dot(capacitance_.matrixL().solve(along_g));
    }
    return sum;
}

Eigen::VectorXd SelectedInverse::solve(const Eigen::VectorXd& right) const {
    Eigen::VectorXd solution = factor_.solve(right);
    if (wide_.cols() > 0) {
        solution -= wide_ * capacitance_.solve(wide_.transpose() * right);
    }
    return solution;
}

int negative_pivots(const NormalEquations& equations) {
    Parts parts = assembled(equations);
    if (!parts.long_rows.empty()) {
        // Borders instead of fill: [A0, D'; D, -1] has as many more negative pivots as borders.
        const Eigen::Index n = parts.matrix.cols(), count = Eigen::Index(parts.long_rows.size());
        Triplets all;
        for (Eigen::Index k = 0; k < n; ++k) {
            for (Eigen::SparseMatrix<double>::InnerIterator it(parts.matrix, k); it; ++it) {
                all.emplace_back(it.row(), it.col(), it.value());
            }
        }
        for (Eigen::Index i = 0; i < count; ++i) {
            all.emplace_back(n + i, n + i, -1.0);
            for (Rows::InnerIterator it(equations.rows, parts.long_rows[std::size_t(i)]); it;
                 ++it) {
                all.emplace_back(n + i, it.col(), it.value());
                all.emplace_back(it.col(), n + i, it.value());
            }
        }
        parts.matrix.resize(n + count, n + count);
        parts.matrix.setFromTriplets(all.begin(), all.end());
    }
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(parts.matrix);
    if (factor.info() != Eigen::Success) return 0;
    const Eigen::VectorXd pivots = factor.vectorD();
    return int((pivots.array() < 0).count()) - int(parts.long_rows.size());
}

}  // namespace culet
