#pragma once
// Steps of the fit as one sparse symmetric model, private to the room:
//
//     [ P  J' ] [x]   [a]      P: what holds each unknown back (damping, priors), positive
//     [ J  -C ] [y] = [b]      J: a row for each equation, C: its variance, 0 when it is exact
//
// the Karush-Kuhn-Tucker (KKT) conditions of a least squares step under equality constraints
// (Nocedal & Wright 2006, chapter 16). Equations of any weight, from exact to hardly counted, stand
// side by side; variances are never squared into one matrix, so that an uncertainty of 1e-12 does
// no harm. The matrix is quasi-definite (Vanderbei 1995): it has an LDL' factorisation without
// pivoting in any order of elimination.

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <vector>

#include "fit/model/jacobian_rows.h"
#include "fit/model/sparse_ldl.h"
#include "fit/solve/constants.h"

namespace culet {

class KktSolver {
public:
    /// Entries of P beside its diagonal come in `curvature`: row >= column. False when
    /// the matrix cannot be factored, or curvature has made it indefinite on what the equations
    /// leave free (told by the signs of the pivots).
    /// Exact equations are factored with the variance `least`, and solutions refined to none: the
    /// smaller it is, the nearer to each other exact equations may be before refinement fails, and
    /// the sooner equations that repeat each other cannot be factored.
    bool factor(const JacobianRows& rows, const Eigen::VectorXd& stiffness,
                const std::vector<SymmetricEntry>& curvature = {},
                double least = k_kkt.least_variance);
    struct Solution {
        Eigen::VectorXd unknowns, multipliers;
        bool good = false;
    };
    /// Refined until what is left is this part of the right-hand side, or gets no smaller; not at
    /// all for a precision of 1.
    Solution solve(const Eigen::VectorXd& a, const Eigen::VectorXd& b,
                   double precision = 1e-13) const;
    /// Several right-hand sides at once, one a column: `a` or `b` may have no columns where it is
    /// zero.
    struct Solutions {
        Eigen::MatrixXd unknowns, multipliers;
        bool good = false;
    };
    Solutions solve_all(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b,
                        double precision = 1e-13) const;
    /// What all its factorisations took, about, in multiplications.
    double work() const { return work_; }
    /// log |det| of the matrix as it was factored: log det C + log det (P + J'C^-1 J).
    double log_determinant() const;

private:
    using Matrix = Eigen::SparseMatrix<double>;
    void assemble(const JacobianRows& rows, const Eigen::VectorXd& stiffness,
                  const std::vector<SymmetricEntry>& curvature, double least);
    Eigen::VectorXd refined(const Eigen::VectorXd& right, double precision) const;

    Eigen::Index unknowns_ = 0, equations_ = 0;
    Matrix matrix_;             // its lower half, as it is factored
    Eigen::VectorXd softened_;  // what exact equations are factored with, of each row
    SparseLdl factors_;
    double work_ = 0;
};

}  // namespace culet
