#pragma once
// The equations of a fit made linear about a shape. Private to the room: shows Eigen.

#include <Eigen/SparseCore>
#include <memory>
#include <vector>

#include "fit/model/jacobian_rows.h"
#include "fit/model/system.h"

namespace culet {

/// Coefficients of a linear function of the unknowns; of several, one a row.
using FunctionRow = Eigen::SparseVector<double>;
using FunctionRows = Eigen::SparseMatrix<double, Eigen::RowMajor>;
FunctionRow function_row(const FunctionRows& rows, Eigen::Index i);

/// Turns slopes into entries of a row of small steps.
class RowWriter {
public:
    using Triplets = std::vector<Eigen::Triplet<double>>;
    RowWriter() = default;
    explicit RowWriter(const Shape& shape);
    void write(const Quantity& quantity, int row, double factor, Triplets& to) const;
    FunctionRow function(const Quantity& quantity) const;
    FunctionRows functions(const std::vector<Quantity>& quantities) const;

private:
    Layout layout_;
    std::vector<std::array<Vec3, 2>> tangents_;
};

struct Linearised {
    Layout layout;
    RowWriter writer;  ///< of the shape
    std::vector<Equation> soft, hard;
    FunctionRows soft_rows;          ///< slopes / sigma
    Eigen::VectorXd soft_residuals;  ///< (formula - value) / sigma
    FunctionRows hard_rows;
    Eigen::VectorXd hard_residuals;
    /// Motions that no equation sees (shifts, turns), weighted: held at zero.
    std::vector<Eigen::VectorXd> gauge_rows;
    /// The turn of the whole stone about up, seen or not; steps.
    Eigen::VectorXd turn;
    Eigen::VectorXd metric;  ///< diagonal: what counts as a step of one, for each unknown

    /// The facets' prior is among the equations: loosely held directions are then as uncertain as
    /// they are, and none counts as open.
    bool has_prior = false;

    double chi2() const;   ///< of the counted equations
    double merit() const;  ///< of all soft equations
    double worst_hard() const;
};

/// `held` are further hard equations.
Linearised linearise(const System& system, const Shape& shape,
                     const std::shared_ptr<const Outline>& outline,
                     const std::vector<Equation>& held = {});

/// What the KKT solver takes: hard equations (times `hard_scale`), then motions that nothing sees,
/// both exact, then, if asked, what was read, of variance one.
JacobianRows kkt_rows(const Linearised& linear, bool with_soft, double hard_scale = 1);
/// How many those are.
Eigen::Index kkt_row_count(const Linearised& linear, bool with_soft);

}  // namespace culet
