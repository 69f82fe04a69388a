#pragma once
// Steps of the fit as one sparse symmetric system, private to the room:
//
//     [ P  J' ] [x]   [a]      P: what holds each unknown back (damping, priors), positive
//     [ J  -C ] [y] = [b]      J: a row for each equation, C: its variance, 0 when it is exact
//
// Equations of any weight, from exact to hardly counted, stand side by side; variances are never
// squared into one matrix where that would harm (elimination_order.h), so that an uncertainty of
// 1e-12 does none. The matrix is quasi-definite (Vanderbei 1995): it has an LDL' factorisation in
// any order of elimination.

#include <Eigen/Core>
#include <set>
#include <vector>

#include "fit/fronts.h"
#include "fit/sparse_rows.h"

namespace culet {

class SaddleSolver {
public:
    /// Entries of P beside its diagonal come in `curvature`: row >= column. False when
    /// the matrix cannot be factored, or curvature has made it indefinite on what the equations
    /// leave free (told by the signs of the pivots).
    /// Exact equations are factored with the variance `least`, and solutions refined to none: the
    /// smaller it is, the nearer to each other exact equations may be before refinement fails, and
    /// the sooner equations that repeat each other cannot be factored.
    bool factor(const SparseRows& rows, const Eigen::VectorXd& stiffness,
                std::vector<SymmetricEntry> curvature = {}, double least = k_least_variance);
    /// Far above rounding, far below the variance of anything that is read (lengths are in half
    /// diameters).
    static constexpr double k_least_variance = 1e-9;
    struct Solution {
        Eigen::VectorXd unknowns, forces;
        bool good = false;
    };
    /// Refined until what is left is this part of the right-hand side, or gets no smaller; not at
    /// all for a precision of 1.
    Solution solve(const Eigen::VectorXd& a, const Eigen::VectorXd& b,
                   double precision = 1e-13) const;
    /// Several right-hand sides at once, one a column: `a` or `b` may have no columns where it is
    /// zero.
    struct Solutions {
        Eigen::MatrixXd unknowns, forces;
        bool good = false;
    };
    Solutions solve_all(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b,
                        double precision = 1e-13) const;
    /// What all its factorisations and solutions took, about, in multiplications.
    double work() const { return work_; }
    /// log |det| of the matrix as it was factored: log det C + log det (P + J'C^-1 J).
    double log_determinant() const;

private:
    /// Right-hand sides and solutions, one a column, side by side in memory.
    using Sides = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

    void lay_out();
    bool place_rows(const std::vector<char>& stays);
    bool place_curvature();
    template <int W>
    void times(const Sides& x, Sides& product) const;
    template <int W>
    void solve_once(const Sides& right, Sides& x) const;
    template <int W>
    Sides refined(const Sides& right, double precision) const;

    int unknowns_ = 0, equations_ = 0, eliminated_ = 0;
    bool laid_out_ = false;
    SparseRows rows_;
    std::vector<double> weight_;  // of each folded equation: 1 / variance
    Eigen::VectorXd stiffness_;
    std::vector<SymmetricEntry> curvature_;
    std::vector<char> sharp_, is_folded_;  // of the equations
    std::vector<std::size_t> diagonal_;    // slots of the unknowns' own entries
    std::vector<std::size_t> slot_;        // of the equations' entries, in the order they are added
    std::vector<std::size_t> first_slot_;  // of each equation in `slot_`
    std::vector<std::size_t> curved_;      // of curvature
    std::set<std::vector<int>> past_;      // columns of soft rows that were there before
    Fronts fronts_;
    double work_ = 0;
};

}  // namespace culet
