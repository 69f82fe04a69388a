#include "fit/saddle_solver.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <ranges>
#include <span>
#include <stdexcept>

#include "fit/elimination_order.h"

namespace culet {

namespace {

constexpr int k_refinements = 12;
// Measured, in multiplications of a factorisation: what laying out the matrix, and the solutions
// that follow a factorisation, take of each row.
constexpr double k_laid_out = 2000, k_solved = 400;
// Columns of a row that may be folded into a layout as it stands.
constexpr std::size_t k_most_short = 12;
// Larger solutions are those of a matrix that is singular but for rounding. Up to here their
// products with any entry of a sheet, and sums of such, are numbers.
constexpr double k_most = 1e150;

template <typename Numbers>
bool are_sound(const Numbers& numbers) {
    return numbers.allFinite() && (numbers.array().abs() < k_most).all();
}

}  // namespace

void SaddleSolver::lay_out() {
    work_ += k_laid_out * (unknowns_ + equations_);
    SparseRows rows = rows_;
    for (const std::vector<int>& columns : past_) {
        for (const int column : columns) rows.add(column, 0);
        rows.close(0, 1);
    }
    EliminationOrder order = elimination_order(rows, unknowns_, curvature_);
    is_folded_ = std::move(order.is_folded);
    is_folded_.resize(std::size_t(equations_));
    eliminated_ = order.eliminated;
    // Folded equations have no place of their own.
    fronts_.lay_out(unknowns_ + equations_, order.blocks, order.cliques);
    std::vector<std::pair<int, int>> diagonal;
    for (int i = 0; i < unknowns_; ++i) diagonal.emplace_back(i, i);
    diagonal_ = fronts_.slots(diagonal);
    place_rows(std::vector<char>(std::size_t(equations_), 0));
    place_curvature();
}

// Those that stay have the columns and the kind that they had in this layout. False when some entry
// of another has no place in it.
bool SaddleSolver::place_rows(const std::vector<char>& stays) {
    std::vector<std::pair<int, int>> entries;
    std::vector<std::size_t> slots, first, open;  // `open`: of the entries
    slots.reserve(slot_.size());
    first.reserve(std::size_t(equations_));
    for (int i = 0; i < equations_; ++i) {
        const int from = rows_.begin[i], to = rows_.begin[i + 1], own = unknowns_ + i;
        const std::size_t columns = std::size_t(to - from);
        const std::size_t count = is_folded_[i] ? columns * (columns + 1) / 2 : columns + 1;
        first.push_back(slots.size());
        if (stays[i]) {
            const auto before = slot_.begin() + std::ptrdiff_t(first_slot_[i]);
            slots.insert(slots.end(), before, before + std::ptrdiff_t(count));
            continue;
        }
        for (std::size_t k = 0; k < count; ++k) open.push_back(slots.size() + k);
        slots.resize(slots.size() + count);
        if (!is_folded_[i]) entries.emplace_back(own, own);
        for (int k = from; k < to; ++k) {
            if (!is_folded_[i]) {
                entries.emplace_back(rows_.column[k], own);
                continue;
            }
            for (int l = from; l <= k; ++l) {
                entries.emplace_back(rows_.column[k], rows_.column[l]);
            }
        }
    }
    bool all = true;
    const std::vector<std::size_t> found = fronts_.slots(entries);
    for (std::size_t k = 0; k < found.size(); ++k) {
        slots[open[k]] = found[k];
        all = all && found[k] != Fronts::k_none;
    }
    slot_ = std::move(slots);
    first_slot_ = std::move(first);
    return all;
}

bool SaddleSolver::place_curvature() {
    std::vector<std::pair<int, int>> entries;
    for (const SymmetricEntry& e : curvature_) entries.emplace_back(e.row, e.column);
    curved_ = fronts_.slots(entries);
    return std::find(curved_.begin(), curved_.end(), Fronts::k_none) == curved_.end();
}

bool SaddleSolver::factor(const SparseRows& rows, const Eigen::VectorXd& stiffness,
                          std::vector<SymmetricEntry> curvature, double least) {
    const auto columns_of = [](const SparseRows& of, int i) {
        return std::span(of.column).subspan(std::size_t(of.begin[i]),
                                            std::size_t(of.begin[i + 1] - of.begin[i]));
    };
    const bool goes_on = laid_out_ && stiffness.size() == stiffness_.size();
    std::vector<char> sharp, stays;
    for (int i = 0; i < rows.count(); ++i) {
        sharp.push_back(is_sharp(rows, i));
        stays.push_back(goes_on && i < equations_ && sharp[i] == sharp_[i] &&
                        std::ranges::equal(columns_of(rows, i), columns_of(rows_, i)));
    }
    const bool same = goes_on && rows.count() == equations_ &&
                      std::find(stays.begin(), stays.end(), 0) == stays.end();
    const bool same_curvature =
        goes_on && std::ranges::equal(curvature, curvature_, [](const auto& a, const auto& b) {
            return a.row == b.row && a.column == b.column;
        });
    // Soft rows that come and go may well find room in the layout as it is: those that have been
    // there before are given some.
    bool fits = goes_on;
    if (!goes_on) past_.clear();
    if (goes_on && !same) {
        if (past_.size() > std::size_t(rows.count()) / 2) past_.clear();
        is_folded_.resize(std::max(is_folded_.size(), std::size_t(rows.count())), 1);
        for (int i = 0; i < std::max(equations_, rows.count()); ++i) {
            if (i < rows.count() && stays[i]) continue;
            if (i < equations_) {
                const auto columns = columns_of(rows_, i);
                if (is_folded_[i]) past_.emplace(columns.begin(), columns.end());
                fits = fits && is_folded_[i];
            }
            if (i < rows.count()) {
                fits = fits && !sharp[i] && columns_of(rows, i).size() <= k_most_short;
            }
        }
        is_folded_.resize(std::size_t(rows.count()));
    }
    rows_ = rows;
    stiffness_ = stiffness;
    curvature_ = std::move(curvature);
    sharp_ = std::move(sharp);
    unknowns_ = static_cast<int>(stiffness.size());
    equations_ = rows.count();
    laid_out_ = true;
    const bool has_room =
        fits && (same || place_rows(stays)) && (same_curvature || place_curvature());
    if (!has_room) lay_out();

    weight_.resize(std::size_t(equations_));
    for (int i = 0; i < equations_; ++i) weight_[i] = is_folded_[i] ? 1 / rows.variance[i] : 0;
    fronts_.clear();
    std::size_t source = 0;
    for (int i = 0; i < unknowns_; ++i) fronts_.add(diagonal_[i], stiffness(i));
    for (int i = 0; i < equations_; ++i) {
        if (!is_folded_[i]) {
            fronts_.add(slot_[source++], -std::max(rows.variance[i], least));
            for (int k = rows.begin[i]; k < rows.begin[i + 1]; ++k) {
                fronts_.add(slot_[source++], rows.slope[k]);
            }
            continue;
        }
        for (int k = rows.begin[i]; k < rows.begin[i + 1]; ++k) {
            const double weighted = weight_[i] * rows.slope[k];
            for (int l = rows.begin[i]; l <= k; ++l) {
                fronts_.add(slot_[source++], weighted * rows.slope[l]);
            }
        }
    }
    for (std::size_t k = 0; k < curvature_.size(); ++k) {
        fronts_.add(curved_[k], curvature_[k].value);
    }
    work_ += fronts_.work() + k_solved * (unknowns_ + equations_);
    return fronts_.factor() && fronts_.negative_pivots() == eliminated_;
}

double SaddleSolver::log_determinant() const {
    double sum = fronts_.log_determinant();
    for (int i = 0; i < equations_; ++i) {
        if (is_folded_[i]) sum += std::log(rows_.variance[i]);
    }
    return sum;
}

// The matrix as it is meant: exact equations have no variance.
template <int W>
void SaddleSolver::times(const Sides& x, Sides& product) const {
    const double* from = x.data();
    double* to = product.data();
    const auto add = [](double* sum, double factor, const double* what) {
        for (int k = 0; k < W; ++k) sum[k] += factor * what[k];
    };
    for (int i = 0; i < unknowns_; ++i) {
        for (int k = 0; k < W; ++k) to[i * W + k] = stiffness_(i) * from[i * W + k];
    }
    for (const SymmetricEntry& e : curvature_) {
        add(to + e.row * W, e.value, from + e.column * W);
        if (e.row != e.column) add(to + e.column * W, e.value, from + e.row * W);
    }
    for (int i = 0; i < equations_; ++i) {
        const double* force = from + (unknowns_ + i) * W;
        double own[W];
        for (int k = 0; k < W; ++k) own[k] = -rows_.variance[i] * force[k];
        for (int k = rows_.begin[i]; k < rows_.begin[i + 1]; ++k) {
            add(own, rows_.slope[k], from + rows_.column[k] * W);
            add(to + rows_.column[k] * W, rows_.slope[k], force);
        }
        std::copy_n(own, W, to + (unknowns_ + i) * W);
    }
}

template <int W>
void SaddleSolver::solve_once(const Sides& right, Sides& x) const {
    const auto add = [](double* sum, double factor, const double* what) {
        for (int k = 0; k < W; ++k) sum[k] += factor * what[k];
    };
    x = right;
    double* to = x.data();
    double own[W];
    for (int i = 0; i < equations_; ++i) {
        if (!is_folded_[i]) continue;
        for (int k = 0; k < W; ++k) own[k] = weight_[i] * right.data()[(unknowns_ + i) * W + k];
        for (int k = rows_.begin[i]; k < rows_.begin[i + 1]; ++k) {
            add(to + rows_.column[k] * W, rows_.slope[k], own);
        }
    }
    fronts_.solve(to, W);
    for (int i = 0; i < equations_; ++i) {
        if (!is_folded_[i]) continue;
        double* force = to + (unknowns_ + i) * W;
        for (int k = 0; k < W; ++k) own[k] = -force[k];
        for (int k = rows_.begin[i]; k < rows_.begin[i + 1]; ++k) {
            add(own, rows_.slope[k], to + rows_.column[k] * W);
        }
        for (int k = 0; k < W; ++k) force[k] = weight_[i] * own[k];
    }
}

template <int W>
SaddleSolver::Sides SaddleSolver::refined(const Sides& right, double precision) const {
    Sides x(right.rows(), W), left(right.rows(), W), next(right.rows(), W);
    const auto off = [&](const Sides& at, Sides& rest) {
        times<W>(at, rest);
        std::array<double, W> size{};
        for (Eigen::Index i = 0; i < rest.rows(); ++i) {
            for (int k = 0; k < W; ++k) {
                double& value = rest.data()[i * W + k];
                value = right.data()[i * W + k] - value;
                // Not less, so that what is no number is seen.
                if (!(std::abs(value) <= size[std::size_t(k)])) {
                    size[std::size_t(k)] = std::abs(value);
                }
            }
        }
        return size;
    };
    solve_once<W>(right, x);
    if (precision >= 1 || !are_sound(x)) return x;
    std::array<double, W> size = off(x, left), enough{};
    for (int k = 0; k < W; ++k) {
        enough[std::size_t(k)] = precision * right.col(k).lpNorm<Eigen::Infinity>();
    }
    std::array<bool, W> done{};
    for (int round = 0; round < k_refinements; ++round) {
        for (std::size_t k = 0; k < W; ++k) done[k] = done[k] || !(size[k] > enough[k]);
        if (std::find(done.begin(), done.end(), false) == done.end()) break;
        Sides next_left(right.rows(), W);
        solve_once<W>(left, next);
        if (!are_sound(next)) break;
        next += x;
        const std::array<double, W> next_size = off(next, next_left);
        for (std::size_t k = 0; k < W; ++k) {
            done[k] = done[k] || !(next_size[k] < 0.7 * size[k]);
            if (done[k]) continue;
            const Eigen::Index column = static_cast<Eigen::Index>(k);
            x.col(column) = next.col(column);
            left.col(column) = next_left.col(column);
            size[k] = next_size[k];
        }
    }
    return x;
}

SaddleSolver::Solution SaddleSolver::solve(const Eigen::VectorXd& a, const Eigen::VectorXd& b,
                                           double precision) const {
    if (a.size() != unknowns_ || b.size() != equations_) {
        throw std::logic_error("right-hand sides of another system than was factored");
    }
    Sides right(unknowns_ + equations_, 1);
    right.topRows(unknowns_) = a;
    right.bottomRows(equations_) = b;
    const Sides x = refined<1>(right, precision);
    Solution solution;
    solution.good = are_sound(x);
    solution.unknowns = x.topRows(unknowns_);
    solution.forces = x.bottomRows(equations_);
    return solution;
}

SaddleSolver::Solutions SaddleSolver::solve_all(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b,
                                                double precision) const {
    constexpr int k_width = Fronts::k_together;
    const Eigen::Index count = std::max(a.cols(), b.cols());
    Solutions all;
    all.unknowns.resize(unknowns_, count);
    all.forces.resize(equations_, count);
    for (Eigen::Index from = 0; from < count; from += k_width) {
        const Eigen::Index width = std::min<Eigen::Index>(k_width, count - from);
        Sides right = Sides::Zero(unknowns_ + equations_, k_width);
        if (a.cols() > 0) right.topLeftCorner(unknowns_, width) = a.middleCols(from, width);
        if (b.cols() > 0) right.bottomLeftCorner(equations_, width) = b.middleCols(from, width);
        const Sides x = refined<k_width>(right, precision);
        all.unknowns.middleCols(from, width) = x.topLeftCorner(unknowns_, width);
        all.forces.middleCols(from, width) = x.bottomLeftCorner(equations_, width);
    }
    all.good = are_sound(all.unknowns) && are_sound(all.forces);
    return all;
}

}  // namespace culet
