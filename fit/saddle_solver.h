#pragma once
// Steps of the fit as one sparse symmetric system, private to the room:
//
//     [ P  J' ] [x]   [a]      P: what holds each unknown back (damping, priors), positive
//     [ J  -C ] [y] = [b]      J: a row for each equation, C: its variance, 0 when it is exact
//
// Equations of any weight, from exact to hardly counted, stand side by side without their variances
// ever being squared into one matrix, so that an uncertainty of 1e-12 does no harm. The matrix is
// quasi-definite (Vanderbei 1995): it has an LDL' factorisation in any order of elimination.

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <vector>

namespace culet {

/// Rows under construction: columns and slopes, what is left of the equation, and its variance.
struct SparseRows {
    std::vector<int> begin{0}, column;
    std::vector<double> slope, residual, variance;

    int count() const { return static_cast<int>(residual.size()); }
    Eigen::Map<const Eigen::VectorXd> residuals() const {
        return {residual.data(), static_cast<Eigen::Index>(residual.size())};
    }
    void add(int c, double s) {
        column.push_back(c);
        slope.push_back(s);
    }
    void close(double left, double with_variance) {
        begin.push_back(static_cast<int>(column.size()));
        residual.push_back(left);
        variance.push_back(with_variance);
    }
};

class SaddleSolver {
public:
    /// Entries of P beside its diagonal come in `curvature`: row >= column.
    struct Entry {
        int row, column;
        double value;
    };
    /// False when the matrix cannot be factored, or curvature has made it indefinite on what the
    /// equations leave free (told by the signs of the pivots).
    bool factor(const SparseRows& rows, const Eigen::VectorXd& stiffness,
                const std::vector<Entry>& curvature = {});
    struct Solution {
        Eigen::VectorXd unknowns, forces;
        bool good = false;
    };
    /// Refined until what is left is this part of the right-hand side, or gets no smaller.
    Solution solve(const Eigen::VectorXd& a, const Eigen::VectorXd& b,
                   double precision = 1e-13) const;
    /// log |det| of the matrix as it was factored: log det C + log det (P + J'C^-1 J).
    double log_determinant() const { return factors_.vectorD().array().abs().log().sum(); }

private:
    void lay_out(const SparseRows& rows, const std::vector<Entry>& curvature);

    int unknowns_ = 0, equations_ = 0;
    std::vector<int> begin_, column_;          // of the pattern that was analysed
    std::vector<std::pair<int, int>> curved_;  // likewise
    std::vector<int> slot_;                    // of each slope, then each curvature entry
    std::vector<int> diagonal_;                // of each column
    Eigen::SparseMatrix<double> matrix_;       // lower half
    Eigen::VectorXd variance_;
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower, Eigen::AMDOrdering<int>>
        factors_;
};

}  // namespace culet
