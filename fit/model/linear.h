#pragma once
// The equations of a fit, linearised at a shape. Private to the room: shows Eigen.

#include <Eigen/SparseCore>
#include <memory>
#include <vector>

#include "fit/model/equations.h"
#include "fit/model/fit_model.h"

namespace culet {

/// Coefficients of one linear function of the unknowns, and of several, one a row.
using FunctionRow = Eigen::SparseVector<double>;
using FunctionRows = Eigen::SparseMatrix<double, Eigen::RowMajor>;
FunctionRow function_row(const FunctionRows& rows, Eigen::Index i);

/// Writes quantities as functions of the unknowns in the order of `Layout`: those of `Parameters`
/// with nothing fixed and no symmetry.
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
    RowWriter writer;
    std::vector<Equation> soft, hard;
    FunctionRows soft_rows;          ///< slopes / sigma
    Eigen::VectorXd soft_residuals;  ///< (formula - value) / sigma
    FunctionRows hard_rows;
    Eigen::VectorXd hard_residuals;
    /// Motions that no equation sees (shifts, turns), times the metric; they are constrained to
    /// zero.
    std::vector<Eigen::VectorXd> gauge_rows;
    /// Step that turns the whole stone about up, whether seen or not.
    Eigen::VectorXd turn;
    Eigen::VectorXd metric;  ///< diagonal: what counts as a step of one, for each unknown

    /// The equations include the facets' prior, or outlines that see all facets. Weakly held
    /// directions then have their true uncertainty, and none counts as unobservable.
    bool has_prior = false;

    double chi2() const;  ///< of the counted equations
    double worst_hard() const;
};

/// Points of released meets. They only follow their planes, and are never undetermined. The metric
/// weights them by `k_shapes.loose_point`.
std::vector<bool> loose_points(const FitModel& model);

/// `held`: further hard equations.
Linearised linearise(const FitModel& model, const Shape& shape,
                     const std::shared_ptr<const Outline>& outline,
                     const std::vector<Equation>& held = {});

}  // namespace culet
