#pragma once
// Directions that a set of sparse linear equations leaves free. Private to the room: shows Eigen.

#include <Eigen/SparseCore>

namespace culet {

/// A basis Z of the null space of `rows` (rows * Z = 0), one column a free direction, by
/// elimination on the largest entries of each row. Equations that repeat others to 1e-10 of their
/// own size add nothing. Columns from `first_preferred` on are eliminated before others where their
/// entries are not much smaller: points are held by their own facets only.
using FreeDirections = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
FreeDirections free_directions(const Eigen::SparseMatrix<double, Eigen::RowMajor>& rows,
                               Eigen::Index first_preferred, Eigen::Index end_preferred);

}  // namespace culet
