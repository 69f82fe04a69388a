#include "fit/normal_inverse.h"

#include <algorithm>
#include <cmath>

#include "fit/elimination_order.h"

namespace culet {

namespace {

using Rows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

// A row of more entries than this touches more than a few facets and their corners.
constexpr Eigen::Index k_long = 90;
// With more long rows than this, keeping them apart costs more than the fill that they make.
constexpr std::size_t k_most_long = 48;

std::vector<Eigen::Index> long_rows(const Rows& rows) {
    std::vector<Eigen::Index> found;
    for (Eigen::Index i = 0; i < rows.rows(); ++i) {
        if (rows.innerVector(i).nonZeros() > k_long) found.push_back(i);
    }
    if (found.size() > k_most_long) found.clear();
    return found;
}

// Factors of the equations; long rows beside them: as borders, or not at all.
Fronts factored(const NormalEquations& equations, const std::vector<Eigen::Index>& apart,
                bool as_borders, bool& good) {
    const int unknowns = static_cast<int>(equations.diagonal.size());
    SparseRows all;
    const auto add = [&](const Rows& rows, Eigen::Index i, double weight) {
        for (Rows::InnerIterator it(rows, i); it; ++it) {
            if (it.value() != 0) all.add(static_cast<int>(it.col()), weight * it.value());
        }
        all.close(0, 1);
    };
    std::size_t next = 0;
    for (Eigen::Index i = 0; i < equations.rows.rows(); ++i) {
        if (next < apart.size() && apart[next] == i) {
            ++next;
        } else {
            add(equations.rows, i, 1);
        }
    }
    for (Eigen::Index i = 0; i < equations.hard_rows.rows(); ++i) {
        add(equations.hard_rows, i, equations.hard_weight);
    }
    const int folded = all.count();
    for (const Eigen::Index i : apart) {
        if (as_borders) add(equations.rows, i, 1);
    }
    const EliminationOrder order = elimination_order(all, unknowns, {}, folded);
    Fronts fronts;
    fronts.lay_out(unknowns + all.count(), order.blocks, order.cliques);
    std::vector<std::pair<int, int>> entries;
    std::vector<double> values;
    const auto put = [&](int row, int column, double value) {
        entries.emplace_back(row, column);
        values.push_back(value);
    };
    for (int i = 0; i < unknowns; ++i) put(i, i, equations.diagonal(i));
    for (int i = 0; i < all.count(); ++i) {
        if (i >= folded) put(unknowns + i, unknowns + i, -1);
        for (int k = all.begin[i]; k < all.begin[i + 1]; ++k) {
            if (i >= folded) {
                put(unknowns + i, all.column[k], all.slope[k]);
                continue;
            }
            for (int l = all.begin[i]; l <= k; ++l) {
                put(all.column[k], all.column[l], all.slope[k] * all.slope[l]);
            }
        }
    }
    const std::vector<std::size_t> slots = fronts.slots(entries);
    for (std::size_t e = 0; e < slots.size(); ++e) fronts.add(slots[e], values[e]);
    good = fronts.factor();
    return fronts;
}

}  // namespace

bool NormalInverse::compute(const NormalEquations& equations) {
    const std::vector<Eigen::Index> apart = long_rows(equations.rows);
    bool good = false;
    fronts_ = factored(equations, apart, false, good);
    if (!good || fronts_.negative_pivots() > 0) return false;
    const Eigen::Index n = equations.diagonal.size();
    wide_.resize(n, 0);
    if (!apart.empty()) {
        const Eigen::Index count = Eigen::Index(apart.size());
        Eigen::MatrixXd rows(count, n);
        for (Eigen::Index i = 0; i < count; ++i) {
            rows.row(i) = Eigen::RowVectorXd(equations.rows.row(apart[std::size_t(i)]));
        }
        wide_ = rows.transpose();
        for (Eigen::Index i = 0; i < count; ++i) fronts_.solve(wide_.col(i).data(), 1);
        capacitance_.compute(Eigen::MatrixXd::Identity(count, count) + rows * wide_);
    }
    return true;
}

NormalInverse::Half NormalInverse::half(const Eigen::SparseVector<double>& f) const {
    std::vector<std::pair<int, double>> entries;
    for (Eigen::SparseVector<double>::InnerIterator it(f); it; ++it) {
        if (it.value() != 0) entries.emplace_back(static_cast<int>(it.index()), it.value());
    }
    Half half{fronts_.half(entries), {}};
    if (wide_.cols() > 0) {
        const Eigen::VectorXd along = wide_.transpose() * f;
        half.long_rows = capacitance_.matrixL().solve(along);
    }
    return half;
}

double NormalInverse::product(const Half& f, const Half& g) {
    return Fronts::product(f.short_rows, g.short_rows) - f.long_rows.dot(g.long_rows);
}

double NormalInverse::quadratic(const Eigen::SparseVector<double>& f) const {
    const Half own = half(f);
    return product(own, own);
}

Eigen::VectorXd NormalInverse::solve(const Eigen::VectorXd& right) const {
    Eigen::VectorXd solution = right;
    fronts_.solve(solution.data(), 1);
    if (wide_.cols() > 0) {
        solution -= wide_ * capacitance_.solve(wide_.transpose() * right);
    }
    return solution;
}

int negative_pivots(const NormalEquations& equations) {
    // Borders instead of fill: [A0, D'; D, -1] has as many more negative pivots as borders.
    const std::vector<Eigen::Index> apart = long_rows(equations.rows);
    bool good = false;
    const Fronts fronts = factored(equations, apart, true, good);
    return good ? fronts.negative_pivots() - static_cast<int>(apart.size()) : 0;
}

}  // namespace culet
