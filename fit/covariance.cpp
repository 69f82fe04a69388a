#include "fit/covariance.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "fit/elimination.h"
#include "fit/normal_inverse.h"

namespace culet {

namespace {

// Freedoms held less than twice as tightly by the readings as by the mesh (lambda = 4 in
// variance) count as not determined.
constexpr double k_determined = 4;
// Dense algebra grows with the cube of the unknowns; beyond this many it is the slower one.
constexpr Eigen::Index k_most_dense = 1300;
// For the question what is open, a reading is tight enough at this weight: squares of larger ones
// would drown a weight of one in rounding.
constexpr double k_tight = 1e6;
// Normal equations square the spread of weights. Nothing that is held is so at less than a weight
// of 2: beyond this, QR keeps what they lose.
constexpr double k_most_spread = 1e5;
// Of motions that nothing sees, so that they count as held.
constexpr double k_least_of_gauge = 1e3;
// Of all variances together: what is told of them has three digits.
constexpr double k_precision = 1e-6;

// Gauge motions, orthonormal in the metric. The turn about up is one of them also where readings
// see it (widths along azimuths) but hold it less than the mesh does: no freedom of the stone's
// shape.
Eigen::MatrixXd gauge_motions(const Linearised& linear,
                              const Eigen::SparseMatrix<double, Eigen::RowMajor>& rows) {
    Eigen::MatrixXd motions(linear.layout.size(), Eigen::Index(linear.gauge_rows.size()) + 1);
    Eigen::Index count = 0;
    std::vector<Eigen::VectorXd> all;
    for (const Eigen::VectorXd& row : linear.gauge_rows) {
        all.push_back(row.cwiseQuotient(linear.metric));
    }
    if (linear.turn.size() > 0) {
        const double size = linear.turn.dot(linear.metric.cwiseProduct(linear.turn));
        const double hard = (linear.hard_rows * linear.turn).norm();
        if ((rows * linear.turn).squaredNorm() < k_determined * size &&
            hard < 1e-9 * linear.turn.norm()) {
            all.push_back(linear.turn);
        }
    }
    for (Eigen::VectorXd& g : all) {
        g /= g.norm();
        for (int twice = 0; twice < 2; ++twice) {
            for (Eigen::Index k = 0; k < count; ++k) {
                g -= motions.col(k) * motions.col(k).dot(linear.metric.cwiseProduct(g));
            }
        }
        const double size = std::sqrt(g.dot(linear.metric.cwiseProduct(g)));
        if (!(size > 1e-6)) continue;
        motions.col(count++) = g / size;
    }
    return motions.leftCols(count);
}

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

Eigen::SparseMatrix<double, Eigen::RowMajor> without_hinges(const Linearised& linear) {
    Eigen::SparseMatrix<double, Eigen::RowMajor> rows = linear.soft_rows;
    for (std::size_t i = 0; i < linear.soft.size(); ++i) {
        if (linear.soft[i].role != Equation::Role::hinge) continue;
        for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator it(rows, Eigen::Index(i));
             it; ++it) {
            it.valueRef() = 0;
        }
    }
    return rows;
}

// Entry by entry of the sparse factor, each times a row of the dense one.
DenseRows product(const Eigen::SparseMatrix<double, Eigen::RowMajor>& rows,
                  const DenseRows& columns) {
    DenseRows result = DenseRows::Zero(rows.rows(), columns.cols());
    for (Eigen::Index i = 0; i < rows.rows(); ++i) {
        for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator it(rows, i); it; ++it) {
            result.row(i) += it.value() * columns.row(it.col());
        }
    }
    return result;
}
Eigen::RowVectorXd product(const FunctionRow& function, const DenseRows& columns) {
    Eigen::RowVectorXd result = Eigen::RowVectorXd::Zero(columns.cols());
    for (FunctionRow::InnerIterator it(function); it; ++it) {
        result += it.value() * columns.row(it.index());
    }
    return result;
}

FunctionRow function_row(const Eigen::SparseMatrix<double, Eigen::RowMajor>& rows, Eigen::Index i) {
    FunctionRow row(rows.cols());
    for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator it(rows, i); it; ++it) {
        row.coeffRef(it.col()) += it.value();
    }
    return row;
}

// R^-1 of a QR of rows in the order of their size, with column pivoting: stable row by row whatever
// the weights (Cox & Higham 1998). Columns: P R^-1, so that (B'B)^-1 = F F'.
Eigen::MatrixXd inverse_factor(const Eigen::MatrixXd& seen) {
    std::vector<Eigen::Index> order(std::size_t(seen.rows()));
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = Eigen::Index(i);
    Eigen::VectorXd size(seen.rows());
    for (Eigen::Index i = 0; i < seen.rows(); ++i) size(i) = seen.row(i).cwiseAbs().maxCoeff();
    std::stable_sort(order.begin(), order.end(),
                     [&](Eigen::Index a, Eigen::Index b) { return size(a) > size(b); });
    Eigen::MatrixXd sorted(seen.rows(), seen.cols());
    for (std::size_t i = 0; i < order.size(); ++i) sorted.row(Eigen::Index(i)) = seen.row(order[i]);
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(sorted);
    const Eigen::Index n = seen.cols();
    Eigen::MatrixXd inverse = Eigen::MatrixXd::Identity(n, n);
    qr.matrixR().topLeftCorner(n, n).triangularView<Eigen::Upper>().solveInPlace(inverse);
    return qr.colsPermutation() * inverse;
}

}  // namespace

// What the hard equations leave free, in a basis of it.
struct Covariance::FreePart {
    const DenseRows& basis;
    DenseRows seen;         // by the rows
    Eigen::MatrixXd along;  // its part along each motion that nothing sees
};

// The factor of the penalised normal equations. The gauge is held by pins (as many unknowns as
// motions), and inner constraints follow from them (Baarda's S-transformation): the covariance is
// P C P' with P = 1 - G G' M.
struct Covariance::Sparse {
    struct Held {
        NormalInverse inverse;
        Eigen::MatrixXd gauge_solved;  // U = C M G
        Eigen::MatrixXd gauge_part;    // G' M U
    };
    Held tight;    // a weak prior: what the readings hold
    Held trusted;  // the mesh's own trust as prior, where something is open
    bool has_open = false;
    Eigen::MatrixXd gauge;       // G, orthonormal in the metric
    Eigen::MatrixXd gauge_rows;  // M G
    Eigen::VectorXd pins;
    double prior = 0;

    bool compute(Held& held, const NormalEquations& equations) const {
        if (!held.inverse.compute(equations)) return false;
        held.gauge_solved.resize(gauge.rows(), gauge.cols());
        for (Eigen::Index k = 0; k < gauge.cols(); ++k) {
            held.gauge_solved.col(k) = held.inverse.solve(gauge_rows.col(k));
        }
        held.gauge_part = gauge_rows.transpose() * held.gauge_solved;
        return true;
    }

    double of(const Held& held, const FunctionRow& function) const {
        double value = held.inverse.quadratic(function);
        if (gauge.cols() > 0) {
            const Eigen::VectorXd along = gauge.transpose() * function;
            const Eigen::VectorXd solved = held.gauge_solved.transpose() * function;
            value += along.dot(held.gauge_part * along) - 2 * solved.dot(along);
        }
        return std::max(0.0, value);
    }

    // A function, and what the gauge has to say of it.
    struct Part {
        NormalInverse::Half half;
        Eigen::VectorXd along, solved;
    };
    Part part_of(const Held& held, const FunctionRow& function) const {
        return {held.inverse.half(function), gauge.transpose() * function,
                held.gauge_solved.transpose() * function};
    }
    double of(const Held& held, const Part& one, const Part& other) const {
        double value = NormalInverse::product(one.half, other.half);
        if (gauge.cols() > 0) {
            value += one.along.dot(held.gauge_part * other.along) - one.solved.dot(other.along) -
                     other.solved.dot(one.along);
        }
        return value;
    }
    // Of the hat matrix, as far as it was asked for.
    mutable std::map<Eigen::Index, Part> parts;
    mutable std::map<std::pair<Eigen::Index, Eigen::Index>, double> leverages;

    Eigen::VectorXd with_all(const Held& held, const FunctionRow& function) const {
        const Eigen::VectorXd along = gauge.transpose() * function;
        Eigen::VectorXd all =
            held.inverse.solve(Eigen::VectorXd(function)) - held.gauge_solved * along;
        all -= gauge * (gauge_rows.transpose() * all);
        return all;
    }
};

Covariance::Covariance(const Linearised& linear, Algorithm algorithm)
    : rows_(without_hinges(linear)) {
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

void Covariance::find_dense(const Linearised& linear) {
    const DenseRows basis =
        dense_free_directions(linear.hard_rows, linear.layout.point(0), linear.layout.extra(0));
    const Eigen::MatrixXd gauge = gauge_motions(linear, rows_);
    held_.resize(linear.layout.size(), 0);
    open_.resize(linear.layout.size(), 0);
    seen_.resize(rows_.rows(), 0);
    leverages_ = Eigen::VectorXd::Zero(rows_.rows());
    usable_ = true;
    if (basis.cols() == 0) return;  // exact readings leave nothing free

    // Along the gauge nothing is seen: it counts as held, and is taken out at the end.
    const FreePart free{basis, product(rows_, basis),
                        Eigen::MatrixXd((linear.metric.asDiagonal() * gauge).transpose() * basis)};
    if (!find_well_held(linear, free)) usable_ = find_loosely_held(linear, free);
    const auto off_gauge = [&](DenseRows& columns) {
        if (columns.cols() == 0 || gauge.cols() == 0) return;
        const Eigen::MatrixXd parts = (linear.metric.asDiagonal() * gauge).transpose() * columns;
        columns.noalias() -= gauge * parts;
    };
    off_gauge(held_);
    off_gauge(open_);
    leverages_ = seen_.rowwise().squaredNorm();
}

// Where readings hold every direction, and none far more tightly than others: Cholesky's factor of
// the normal equations. False where that cannot be told so.
bool Covariance::find_well_held(const Linearised& linear, const FreePart& free) {
    double largest = 0;
    for (Eigen::Index i = 0; i < rows_.rows(); ++i) {
        // In the metric no row is longer on directions that are free than on all.
        double square = 0;
        for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator it(rows_, i); it; ++it) {
            square += it.value() * it.value() / linear.metric(it.col());
        }
        largest = std::max(largest, std::sqrt(square));
    }
    if (!(largest < k_most_spread)) return false;
    const double gauge_weight = std::max(k_least_of_gauge, largest);
    const Eigen::Index size = free.basis.cols();
    Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(size, size);
    const auto count = [&normal](const Eigen::MatrixXd& rows, double weight) {
        if (rows.rows() == 0) return;
        normal.selfadjointView<Eigen::Lower>().rankUpdate(rows.transpose(), weight * weight);
    };
    count(free.seen, 1);
    count(free.along, gauge_weight);
    const Eigen::LLT<Eigen::MatrixXd> factor(normal);
    if (factor.info() != Eigen::Success) return false;
    const Eigen::MatrixXd upper = factor.matrixU().solve(Eigen::MatrixXd::Identity(size, size));
    held_ = free.basis * upper.triangularView<Eigen::Upper>();  // (S^-1) = U^-1 U^-T
    seen_ = product(rows_, held_);
    // No direction's variance is larger than all together.
    const double variances = held_.rowwise().squaredNorm().dot(linear.metric);
    if (!(variances < 1 / k_determined)) {
        Eigen::MatrixXd room = Eigen::MatrixXd::Identity(size, size) / k_determined;
        room.selfadjointView<Eigen::Lower>().rankUpdate(
            Eigen::MatrixXd(held_.transpose() * linear.metric.cwiseSqrt().asDiagonal()), -1);
        if (Eigen::LLT<Eigen::MatrixXd>(room).info() != Eigen::Success) return false;
    }
    // Every direction is seen once: the squares of all that is seen add up to their number, unless
    // they are lost in rounding.
    const double squares =
        seen_.squaredNorm() +
        std::pow(gauge_weight, 2) * Eigen::MatrixXd(free.along * upper).squaredNorm();
    return std::abs(squares - double(size)) < k_precision;
}

// By QR of what is seen, whitened by the metric so that eigenvalues compare readings with the mesh.
bool Covariance::find_loosely_held(const Linearised& linear, const FreePart& free) {
    const Eigen::Index size = free.basis.cols();
    Eigen::MatrixXd metric = Eigen::MatrixXd::Zero(size, size);
    metric.selfadjointView<Eigen::Lower>().rankUpdate(
        Eigen::MatrixXd(free.basis.transpose() * linear.metric.cwiseSqrt().asDiagonal()));
    const Eigen::LLT<Eigen::MatrixXd> chol(metric);
    if (chol.info() != Eigen::Success) return false;
    const auto whitened = [&](const Eigen::MatrixXd& rows) -> Eigen::MatrixXd {
        if (rows.rows() == 0) return Eigen::MatrixXd(0, size);
        return chol.matrixU().solve<Eigen::OnTheRight>(rows);
    };
    const Eigen::MatrixXd seen = whitened(free.seen);
    const Eigen::MatrixXd along = whitened(free.along);

    const Eigen::VectorXd norms = seen.rowwise().norm();
    const double largest = norms.size() > 0 ? norms.maxCoeff() : 0;
    const double gauge_weight = std::clamp(largest, k_least_of_gauge, k_tight);
    Eigen::MatrixXd clipped = seen;
    for (Eigen::Index i = 0; i < norms.size(); ++i) {
        if (norms(i) > k_tight) clipped.row(i) *= k_tight / norms(i);
    }
    Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(size, size);
    if (clipped.rows() > 0) normal.selfadjointView<Eigen::Lower>().rankUpdate(clipped.transpose());
    if (along.rows() > 0) {
        normal.selfadjointView<Eigen::Lower>().rankUpdate(along.transpose(),
                                                          gauge_weight * gauge_weight);
    }
    const auto unwhitened = [&](const Eigen::MatrixXd& columns) -> DenseRows {
        return free.basis * Eigen::MatrixXd(chol.matrixU().solve(columns));
    };
    Eigen::MatrixXd held_basis = Eigen::MatrixXd::Identity(size, size);
    const Eigen::MatrixXd shifted = normal - k_determined * Eigen::MatrixXd::Identity(size, size);
    if (Eigen::LLT<Eigen::MatrixXd>(shifted).info() != Eigen::Success) {
        normal = Eigen::MatrixXd(normal.selfadjointView<Eigen::Lower>());
        const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(normal);
        Eigen::Index count = 0;
        while (count < size && eigen.eigenvalues()(count) < k_determined) ++count;
        open_freedoms_ = int(count);
        open_ = unwhitened(eigen.eigenvectors().leftCols(count));
        held_basis = eigen.eigenvectors().rightCols(size - count);
    }
    if (held_basis.cols() == 0) {
        held_.resize(held_.rows(), 0);
        seen_ = DenseRows::Zero(rows_.rows(), 0);
        return true;
    }
    Eigen::MatrixXd stacked(seen.rows() + along.rows(), held_basis.cols());
    stacked.topRows(seen.rows()) = seen * held_basis;
    stacked.bottomRows(along.rows()) = gauge_weight * along * held_basis;
    const Eigen::MatrixXd factor = inverse_factor(stacked);
    held_ = unwhitened(held_basis * factor);
    seen_ = stacked.topRows(seen.rows()) * factor;
    return true;
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
    sparse_->gauge = gauge_motions(linear, rows_);
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
