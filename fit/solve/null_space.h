#pragma once
// Null space of sparse linear equations. Private to the room: shows Eigen.

#include <Eigen/SparseCore>

namespace culet {

/// Returns a basis Z of the null space of `rows` (rows * Z = 0), one direction a column, by
/// elimination on the largest entries of each row. Equations that repeat others to 1e-10 of their
/// size are dropped. Columns in [first_preferred, end_preferred) are eliminated first unless their
/// entries are much smaller: a point occurs only in the equations of its own facets.
using FreeDirections = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
FreeDirections free_directions(const Eigen::SparseMatrix<double, Eigen::RowMajor>& rows,
                               Eigen::Index first_preferred, Eigen::Index end_preferred);

}  // namespace culet
