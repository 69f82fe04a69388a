#include "fit/saddle_solver.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace culet {

namespace {

// Exact equations are factored with this variance and refined to none: far above rounding, far
// below the variance of anything that is read (lengths are in half diameters).
constexpr double k_least_variance = 1e-9;
constexpr int k_refinements = 12;

}  // namespace

// Columns of the lower half: the diagonal, then rows in order.
void SaddleSolver::lay_out(const SparseRows& rows, const std::vector<Entry>& curvature) {
    begin_ = rows.begin;
    column_ = rows.column;
    curved_.clear();
    for (const Entry& e : curvature) curved_.emplace_back(e.row, e.column);
    const int size = unknowns_ + equations_;
    struct Place {
        int column, row, source;
    };
    std::vector<Place> places;
    places.reserve(std::size_t(size) + column_.size() + curved_.size());
    int source = 0;
    for (int i = 0; i < equations_; ++i) {
        for (int k = begin_[i]; k < begin_[i + 1]; ++k) {
            places.push_back({column_[k], unknowns_ + i, source++});
        }
    }
    for (const auto& [row, column] : curved_) places.push_back({column, row, source++});
    const int entries = source;
    for (int i = 0; i < size; ++i) places.push_back({i, i, source++});
    std::sort(places.begin(), places.end(), [](const Place& a, const Place& b) {
        return std::tie(a.column, a.row, a.source) < std::tie(b.column, b.row, b.source);
    });
    slot_.assign(std::size_t(entries), 0);
    diagonal_.assign(std::size_t(size), 0);
    std::vector<int> outer(std::size_t(size) + 1, 0), inner;
    int column = -1, row = -1;
    for (const Place& p : places) {
        if (p.column != column || p.row != row) {
            inner.push_back(p.row);
            ++outer[p.column + 1];
            column = p.column;
            row = p.row;
        }
        const int at = static_cast<int>(inner.size()) - 1;
        (p.source < entries ? slot_[p.source] : diagonal_[p.source - entries]) = at;
    }
    for (int i = 0; i < size; ++i) outer[i + 1] += outer[i];
    matrix_.resize(size, size);
    matrix_.resizeNonZeros(static_cast<Eigen::Index>(inner.size()));
    std::copy(outer.begin(), outer.end(), matrix_.outerIndexPtr());
    std::copy(inner.begin(), inner.end(), matrix_.innerIndexPtr());
    std::fill_n(matrix_.valuePtr(), inner.size(), 0.0);
    factors_.analyzePattern(matrix_);
}

bool SaddleSolver::factor(const SparseRows& rows, const Eigen::VectorXd& stiffness,
                          const std::vector<Entry>& curvature) {
    const int unknowns = static_cast<int>(stiffness.size());
    bool same = unknowns == unknowns_ && rows.count() == equations_ && rows.begin == begin_ &&
                rows.column == column_ && curvature.size() == curved_.size();
    for (std::size_t i = 0; same && i < curved_.size(); ++i) {
        same = curved_[i] == std::make_pair(curvature[i].row, curvature[i].column);
    }
    unknowns_ = unknowns;
    equations_ = rows.count();
    if (!same) lay_out(rows, curvature);

    double* values = matrix_.valuePtr();
    std::fill_n(values, matrix_.nonZeros(), 0.0);
    std::size_t source = 0;
    for (double slope : rows.slope) values[slot_[source++]] += slope;
    for (const Entry& e : curvature) values[slot_[source++]] += e.value;
    for (int i = 0; i < unknowns_; ++i) values[diagonal_[i]] += stiffness(i);
    for (int i = 0; i < equations_; ++i) {
        values[diagonal_[unknowns_ + i]] = -std::max(rows.variance[i], k_least_variance);
    }
    factors_.factorize(matrix_);
    if (factors_.info() != Eigen::Success) return false;
    const auto& pivots = factors_.vectorD();
    if (!pivots.allFinite()) return false;
    if ((pivots.array() < 0).count() != equations_) return false;
    variance_ = Eigen::Map<const Eigen::VectorXd>(rows.variance.data(), equations_);
    return true;
}

SaddleSolver::Solution SaddleSolver::solve(const Eigen::VectorXd& a, const Eigen::VectorXd& b,
                                           double precision) const {
    Eigen::VectorXd right(unknowns_ + equations_);
    right << a, b;
    // The matrix as it is meant: exact equations have no variance.
    const auto times = [&](const Eigen::VectorXd& x) {
        Eigen::VectorXd product = matrix_.selfadjointView<Eigen::Lower>() * x;
        for (int i = 0; i < equations_; ++i) {
            if (variance_(i) < k_least_variance) {
                product(unknowns_ + i) += (k_least_variance - variance_(i)) * x(unknowns_ + i);
            }
        }
        return product;
    };
    Solution solution;
    Eigen::VectorXd x = factors_.solve(right);
    Eigen::VectorXd left = right - times(x);
    double size = left.lpNorm<Eigen::Infinity>();
    const double enough = precision * right.lpNorm<Eigen::Infinity>();
    for (int i = 0; i < k_refinements && size > enough; ++i) {
        const Eigen::VectorXd next = x + factors_.solve(left);
        const Eigen::VectorXd next_left = right - times(next);
        const double next_size = next_left.lpNorm<Eigen::Infinity>();
        if (!(next_size < 0.7 * size)) break;
        x = next;
        left = next_left;
        size = next_size;
    }
    solution.good = x.allFinite();
    solution.unknowns = x.head(unknowns_);
    solution.forces = x.tail(equations_);
    return solution;
}

}  // namespace culet
