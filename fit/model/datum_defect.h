#pragma once
// Motions of the whole stone that no reading sees, and what else is undetermined. Private to the
// room: shows Eigen.

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "fit/model/linear.h"

namespace culet {

/// Orthonormal in the metric, one a column. The turn about up is one of them also where readings
/// see it (widths along azimuths) but hold it less than the mesh does: no freedom of the stone's
/// shape.
Eigen::MatrixXd datum_defect(const Linearised& linear);

/// How many of these directions are open, the loosest first: as many as it takes until the others
/// together leave no unknown half as uncertain as the mesh does. `directions`: orthonormal in the
/// metric, all there are, one a column; `information`: what the readings say of each, increasing.
Eigen::Index open_among(const Eigen::MatrixXd& directions, const Eigen::VectorXd& information,
                        const Eigen::VectorXd& metric);

}  // namespace culet
