#pragma once
// The equations of a fit made linear about a shape. Private to the room: shows Eigen.

#include <Eigen/SparseCore>
#include <memory>
#include <vector>

#include "fit/model/equations.h"
#include "fit/model/fit_model.h"

namespace culet {

/// Coefficients of a linear function of the unknowns; of several, one a row.
using FunctionRow = Eigen::SparseVector<double>;
using FunctionRows = Eigen::SparseMatrix<double, Eigen::RowMajor>;
FunctionRow function_row(const FunctionRows& rows, Eigen::Index i);

/// Quantities as functions of the unknowns: those of `Parameters` with nothing fixed and no
/// symmetry, in the order of `Layout`.
class RowWriter {
public:
    RowWriter() = default;
    explicit RowWriter(const Shape& shape);
    FunctionRow function(const Quantity& quantity) const;
    FunctionRows functions(const std::vector<Quantity>& quantities) const;
    const Parameters& parameters() const { return *parameters_; }
    Parameters::Row row() const { return {tangent_basis_, parameters_->size()}; }

private:
    std::shared_ptr<const Parameters> parameters_;
    Parameters::TangentBasis tangent_basis_;
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

    /// The facets' prior, or what outlines tell of all of them, is among the equations: loosely
    /// held directions are then as uncertain as they are, and none counts as open.
    bool has_prior = false;

    double chi2() const;  ///< of the counted equations
    double worst_hard() const;
};

/// The point of a meet that was let go belongs to nothing: it follows its planes, and wherever it
/// lies, nothing is open. In a metric it weighs `k_shapes.loose_point` of what others do.
std::vector<bool> loose_points(const FitModel& model);

/// `held` are further hard equations.
Linearised linearise(const FitModel& model, const Shape& shape,
                     const std::shared_ptr<const Outline>& outline,
                     const std::vector<Equation>& held = {});

}  // namespace culet
