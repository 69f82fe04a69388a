#pragma once
// The gauge freedoms of a fit (motions of the whole stone that no reading sees) and its other
// unobservable directions. Private to the room: shows Eigen.

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "fit/model/linear.h"

namespace culet {

/// Returns the gauge freedoms, orthonormal in the metric, one a column. The turn about up counts as
/// one also where readings see it (widths along azimuths) but hold it less than twice as tightly as
/// the mesh: it is no freedom of the stone's shape.
Eigen::MatrixXd datum_defect(const Linearised& linear);

/// Returns the number of unobservable directions, the weakest first: as many as are needed until
/// the others together leave each unknown less than half as uncertain as the mesh does.
/// `directions`: all, orthonormal in the metric, one a column. `information`: of the readings on
/// each, increasing.
Eigen::Index count_unobservable(const Eigen::MatrixXd& directions,
                                const Eigen::VectorXd& information, const Eigen::VectorXd& metric);

}  // namespace culet
