#pragma once
// Directions that a set of sparse linear equations leaves free. Private to the room: shows Eigen.

#include <Eigen/SparseCore>

namespace culet {

/// A basis Z of the null space of `rows` (rows * Z = 0), one sparse column a free direction, by
/// elimination on the largest entries of each row. Equations that repeat others to
/// 1e-10 of their own size add nothing. Chains of equations between neighbours (orbits of a
/// symmetry, meets of planes) stay sparse, which an orthogonal basis would not.
/// Columns from `first_preferred` on are eliminated before others where their entries are not much
/// smaller: points are held by their own facets only.
struct FreeDirections {
    using Dense = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    Eigen::SparseMatrix<double, Eigen::RowMajor> basis;  ///< unknowns x free directions
    Eigen::Index rank = 0;
    double growth = 0;  ///< largest entry of the basis; far above 1e6 the basis is ill-conditioned
};
FreeDirections free_directions(const Eigen::SparseMatrix<double, Eigen::RowMajor>& rows,
                               Eigen::Index first_preferred, Eigen::Index end_preferred);
/// The same basis for those who will use it as a dense one: a few times as fast.
FreeDirections::Dense dense_free_directions(
    const Eigen::SparseMatrix<double, Eigen::RowMajor>& rows, Eigen::Index first_preferred,
    Eigen::Index end_preferred);

}  // namespace culet
