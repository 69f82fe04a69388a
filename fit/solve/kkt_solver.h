#pragma once
// Solves the steps of a fit as one sparse symmetric system. Private to the room.
//
//     [ P  J' ] [x]   [a]      P: regularisation of the unknowns (damping, priors), positive
//     [ J  -C ] [y] = [b]      J: one row for each equation, C: its variance, 0 when it is exact
//
// These are the Karush-Kuhn-Tucker (KKT) conditions of a least squares step under equality
// constraints (Nocedal & Wright 2006, chapter 16). Equations of any weight stand side by side.
// Variances are never squared into a normal matrix, so that an uncertainty of 1e-12 does no harm.
// The matrix is quasi-definite (Vanderbei 1995): it has an LDL' factorisation without pivoting in
// any order of elimination.

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <vector>

#include "fit/model/jacobian_rows.h"
#include "fit/model/sparse_ldl.h"
#include "fit/solve/constants.h"

namespace culet {

class KktSolver {
public:
    /// Adds `curvature` to P (entries with row >= column). Returns false when the matrix cannot be
    /// factored or when curvature makes it indefinite on the null space of the equations (the
    /// pivots' signs tell). Exact equations are factored with the variance `least`; refinement
    /// removes its effect. With a smaller one, refinement still works for more nearly dependent
    /// equations, but repeated equations fail to factor sooner.
    bool factor(const JacobianRows& rows, const Eigen::VectorXd& stiffness,
                const std::vector<SymmetricEntry>& curvature = {},
                double least = k_kkt.least_variance);
    struct Solution {
        Eigen::VectorXd unknowns, multipliers;
        bool good = false;
    };
    /// Refines until the residual is this part of the right-hand side or stops shrinking. A
    /// precision of 1 means no refinement.
    Solution solve(const Eigen::VectorXd& a, const Eigen::VectorXd& b,
                   double precision = 1e-13) const;
    /// One right-hand side a column. `a` or `b` may have no columns where it is zero.
    struct Solutions {
        Eigen::MatrixXd unknowns, multipliers;
        bool good = false;
    };
    Solutions solve_all(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b,
                        double precision = 1e-13) const;
    /// Of all its factorisations, in multiplications (estimate).
    double work() const { return work_; }
    /// log |det| of the factored matrix: log det C + log det (P + J'C^-1 J).
    double log_determinant() const;

private:
    using Matrix = Eigen::SparseMatrix<double>;
    void assemble(const JacobianRows& rows, const Eigen::VectorXd& stiffness,
                  const std::vector<SymmetricEntry>& curvature, double least);
    Eigen::VectorXd refined(const Eigen::VectorXd& right, double precision) const;

    Eigen::Index unknowns_ = 0, equations_ = 0;
    Matrix matrix_;             // lower half, as factored
    Eigen::VectorXd softened_;  // variance added to exact equations for factoring, by row
    SparseLdl factors_;
    double work_ = 0;
};

}  // namespace culet
