#pragma once
// The covariance of large stones. Private to the room: shows Eigen.

#include <Eigen/Dense>
#include <map>
#include <utility>

#include "fit/uncertainty/covariance.h"
#include "fit/uncertainty/normal_inverse.h"

namespace culet {

/// Row `i`, as a function of the unknowns.
FunctionRow function_row(const Eigen::SparseMatrix<double, Eigen::RowMajor>& rows, Eigen::Index i);

/// The factor of the penalised normal equations. The gauge is held by pins (as many unknowns as
/// motions), and inner constraints follow from them (Baarda's S-transformation): the covariance is
/// P C P' with P = 1 - G G' M.
struct Covariance::Sparse {
    /// Under one prior, with the gauge held by pins.
    struct PinnedInverse {
        NormalInverse inverse;
        Eigen::MatrixXd gauge_solved;  // U = C M G
        Eigen::MatrixXd gauge_part;    // G' M U
    };
    PinnedInverse tight;    // a weak prior: what the readings hold
    PinnedInverse trusted;  // the mesh's own trust as prior, where something is open
    bool has_open = false;
    Eigen::MatrixXd gauge;       // G, orthonormal in the metric
    Eigen::MatrixXd gauge_rows;  // M G
    Eigen::VectorXd pins;
    double prior = 0;

    bool compute(PinnedInverse& pinned, const NormalEquations& equations) const {
        if (!pinned.inverse.compute(equations)) return false;
        pinned.gauge_solved.resize(gauge.rows(), gauge.cols());
        for (Eigen::Index k = 0; k < gauge.cols(); ++k) {
            pinned.gauge_solved.col(k) = pinned.inverse.solve(gauge_rows.col(k));
        }
        pinned.gauge_part = gauge_rows.transpose() * pinned.gauge_solved;
        return true;
    }

    double of(const PinnedInverse& pinned, const FunctionRow& function) const {
        double value = pinned.inverse.quadratic(function);
        if (gauge.cols() > 0) {
            const Eigen::VectorXd along = gauge.transpose() * function;
            const Eigen::VectorXd solved = pinned.gauge_solved.transpose() * function;
            value += along.dot(pinned.gauge_part * along) - 2 * solved.dot(along);
        }
        return std::max(0.0, value);
    }

    // A function, and what the gauge has to say of it.
    struct Part {
        NormalInverse::Half half;
        Eigen::VectorXd along, solved;
    };
    Part part_of(const PinnedInverse& pinned, const FunctionRow& function) const {
        return {pinned.inverse.half(function), gauge.transpose() * function,
                pinned.gauge_solved.transpose() * function};
    }
    double of(const PinnedInverse& pinned, const Part& one, const Part& other) const {
        double value = NormalInverse::product(one.half, other.half);
        if (gauge.cols() > 0) {
            value += one.along.dot(pinned.gauge_part * other.along) - one.solved.dot(other.along) -
                     other.solved.dot(one.along);
        }
        return value;
    }
    // Of the hat matrix, as far as it was asked for.
    mutable std::map<Eigen::Index, Part> parts;
    mutable std::map<std::pair<Eigen::Index, Eigen::Index>, double> leverages;

    Eigen::VectorXd with_all(const PinnedInverse& pinned, const FunctionRow& function) const {
        const Eigen::VectorXd along = gauge.transpose() * function;
        Eigen::VectorXd all =
            pinned.inverse.solve(Eigen::VectorXd(function)) - pinned.gauge_solved * along;
        all -= gauge * (gauge_rows.transpose() * all);
        return all;
    }
};

}  // namespace culet
