#include "fit/saddle_solver.h"

#include <algorithm>
#include <cmath>

#include "fit/elimination_order.h"

namespace culet {

namespace {

// Exact equations are factored with this variance and refined to none: far above rounding, far
// below the variance of anything that is read (lengths are in half diameters).
constexpr double k_least_variance = 1e-9;
constexpr int k_refinements = 12;
// Right-hand sides that are solved side by side.
constexpr Eigen::Index k_together = 8;

}  // namespace

void SaddleSolver::lay_out() {
    std::vector<std::pair<int, int>> pairs;
    for (const Entry& e : curvature_) {
        if (e.row != e.column) pairs.emplace_back(e.row, e.column);
    }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    const EliminationOrder order = elimination_order(rows_, unknowns_, pairs);
    is_folded_ = order.is_folded;
    eliminated_ = order.eliminated;
    // Folded equations have no place of their own.
    fronts_.lay_out(unknowns_ + equations_, order.blocks, order.cliques);
    slot_.clear();
    diagonal_.clear();
    for (int i = 0; i < unknowns_; ++i) diagonal_.push_back(fronts_.slot(i, i));
    for (int i = 0; i < equations_; ++i) {
        const int own = unknowns_ + i;
        diagonal_.push_back(is_folded_[i] ? 0 : fronts_.slot(own, own));
        for (int k = rows_.begin[i]; k < rows_.begin[i + 1]; ++k) {
            if (!is_folded_[i]) {
                slot_.push_back(fronts_.slot(rows_.column[k], own));
                continue;
            }
            for (int l = rows_.begin[i]; l <= k; ++l) {
                slot_.push_back(fronts_.slot(rows_.column[k], rows_.column[l]));
            }
        }
    }
}

bool SaddleSolver::place_curvature() {
    curved_.clear();
    for (const Entry& e : curvature_) {
        if (!fronts_.has_slot(e.row, e.column)) return false;
        curved_.push_back(fronts_.slot(e.row, e.column));
    }
    return true;
}

bool SaddleSolver::factor(const SparseRows& rows, const Eigen::VectorXd& stiffness,
                          const std::vector<Entry>& curvature) {
    std::vector<char> sharp;
    for (int i = 0; i < rows.count(); ++i) sharp.push_back(is_sharp(rows, i));
    const bool same = laid_out_ && stiffness.size() == stiffness_.size() &&
                      rows.begin == rows_.begin && rows.column == rows_.column && sharp == sharp_;
    const bool same_curvature =
        same && curvature.size() == curvature_.size() &&
        std::equal(curvature.begin(), curvature.end(), curvature_.begin(),
                   [](const Entry& a, const Entry& b) {
                       return a.row == b.row && a.column == b.column;
                   });
    rows_ = rows;
    stiffness_ = stiffness;
    curvature_ = curvature;
    sharp_ = std::move(sharp);
    unknowns_ = static_cast<int>(stiffness.size());
    equations_ = rows.count();
    laid_out_ = true;
    if (!same) lay_out();
    if (!same_curvature && !place_curvature()) {
        lay_out();
        place_curvature();
    }

    fronts_.clear();
    for (int i = 0; i < unknowns_; ++i) fronts_.add(diagonal_[i], stiffness(i));
    std::size_t source = 0;
    for (int i = 0; i < equations_; ++i) {
        if (is_folded_[i]) {
            const double weight = 1 / rows.variance[i];
            for (int k = rows.begin[i]; k < rows.begin[i + 1]; ++k) {
                const double weighted = weight * rows.slope[k];
                for (int l = rows.begin[i]; l <= k; ++l) {
                    fronts_.add(slot_[source++], weighted * rows.slope[l]);
                }
            }
            continue;
        }
        for (int k = rows.begin[i]; k < rows.begin[i + 1]; ++k) {
            fronts_.add(slot_[source++], rows.slope[k]);
        }
        fronts_.add(diagonal_[unknowns_ + i], -std::max(rows.variance[i], k_least_variance));
    }
    for (std::size_t k = 0; k < curvature.size(); ++k) {
        fronts_.add(curved_[k], curvature[k].value);
    }
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
SaddleSolver::Sides SaddleSolver::times(const Sides& x) const {
    const Eigen::Index width = x.cols();
    Sides product(x.rows(), width);
    const auto add = [width](double* to, double factor, const double* from) {
        for (Eigen::Index k = 0; k < width; ++k) to[k] += factor * from[k];
    };
    const auto of = [width](auto& sides, Eigen::Index row) { return sides.data() + row * width; };
    product.topRows(unknowns_) = stiffness_.asDiagonal() * x.topRows(unknowns_);
    for (const Entry& e : curvature_) {
        add(of(product, e.row), e.value, of(x, e.column));
        if (e.row != e.column) add(of(product, e.column), e.value, of(x, e.row));
    }
    for (int i = 0; i < equations_; ++i) {
        const double* force = of(x, unknowns_ + i);
        double* own = of(product, unknowns_ + i);
        for (Eigen::Index k = 0; k < width; ++k) own[k] = -rows_.variance[i] * force[k];
        for (int k = rows_.begin[i]; k < rows_.begin[i + 1]; ++k) {
            add(own, rows_.slope[k], of(x, rows_.column[k]));
            add(of(product, rows_.column[k]), rows_.slope[k], force);
        }
    }
    return product;
}

SaddleSolver::Sides SaddleSolver::solve_once(const Sides& right) const {
    const Eigen::Index width = right.cols();
    const auto add = [width](double* to, double factor, const double* from) {
        for (Eigen::Index k = 0; k < width; ++k) to[k] += factor * from[k];
    };
    Sides x = right;
    for (int i = 0; i < equations_; ++i) {
        if (!is_folded_[i]) continue;
        const double* own = right.data() + (unknowns_ + i) * width;
        for (int k = rows_.begin[i]; k < rows_.begin[i + 1]; ++k) {
            add(x.data() + rows_.column[k] * width, rows_.slope[k] / rows_.variance[i], own);
        }
    }
    fronts_.solve(x.data(), static_cast<int>(width));
    for (int i = 0; i < equations_; ++i) {
        if (!is_folded_[i]) continue;
        double* own = x.data() + (unknowns_ + i) * width;
        const double weight = 1 / rows_.variance[i];
        for (Eigen::Index k = 0; k < width; ++k) own[k] *= -weight;
        for (int k = rows_.begin[i]; k < rows_.begin[i + 1]; ++k) {
            add(own, weight * rows_.slope[k], x.data() + rows_.column[k] * width);
        }
    }
    return x;
}

SaddleSolver::Sides SaddleSolver::refined(const Sides& right, double precision) const {
    Sides x = solve_once(right);
    Sides left = right - times(x);
    const auto sizes = [](const Sides& sides) -> Eigen::RowVectorXd {
        return sides.cwiseAbs().colwise().maxCoeff();
    };
    const Eigen::RowVectorXd enough = precision * sizes(right);
    Eigen::RowVectorXd size = sizes(left);
    std::vector<bool> done(std::size_t(right.cols()), false);
    for (int round = 0; round < k_refinements; ++round) {
        bool any = false;
        for (Eigen::Index k = 0; k < right.cols(); ++k) {
            if (!(size(k) > enough(k))) done[std::size_t(k)] = true;
            any = any || !done[std::size_t(k)];
        }
        if (!any) break;
        const Sides next = x + solve_once(left);
        const Sides next_left = right - times(next);
        const Eigen::RowVectorXd next_size = sizes(next_left);
        for (Eigen::Index k = 0; k < right.cols(); ++k) {
            if (done[std::size_t(k)]) continue;
            if (!(next_size(k) < 0.7 * size(k))) {
                done[std::size_t(k)] = true;
                continue;
            }
            x.col(k) = next.col(k);
            left.col(k) = next_left.col(k);
            size(k) = next_size(k);
        }
    }
    return x;
}

SaddleSolver::Solution SaddleSolver::solve(const Eigen::VectorXd& a, const Eigen::VectorXd& b,
                                           double precision) const {
    Sides right(unknowns_ + equations_, 1);
    right.topRows(unknowns_) = a;
    right.bottomRows(equations_) = b;
    const Sides x = refined(right, precision);
    Solution solution;
    solution.good = x.allFinite();
    solution.unknowns = x.topRows(unknowns_);
    solution.forces = x.bottomRows(equations_);
    return solution;
}

SaddleSolver::Solutions SaddleSolver::solve_all(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b,
                                                double precision) const {
    const Eigen::Index count = std::max(a.cols(), b.cols());
    Solutions all;
    all.unknowns.resize(unknowns_, count);
    all.forces.resize(equations_, count);
    for (Eigen::Index from = 0; from < count; from += k_together) {
        const Eigen::Index width = std::min(k_together, count - from);
        Sides right = Sides::Zero(unknowns_ + equations_, width);
        if (a.cols() > 0) right.topRows(unknowns_) = a.middleCols(from, width);
        if (b.cols() > 0) right.bottomRows(equations_) = b.middleCols(from, width);
        const Sides x = refined(right, precision);
        all.unknowns.middleCols(from, width) = x.topRows(unknowns_);
        all.forces.middleCols(from, width) = x.bottomRows(equations_);
    }
    all.good = all.unknowns.allFinite() && all.forces.allFinite();
    return all;
}

}  // namespace culet
