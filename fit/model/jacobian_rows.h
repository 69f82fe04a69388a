#pragma once
// Linearised equations for the solver, built row by row. Private to the room: shows Eigen.

#include <Eigen/Core>
#include <vector>

namespace culet {

/// Sparse rows with the equation's residual and variance.
struct JacobianRows {
    std::vector<int> begin{0}, column;
    std::vector<double> slope, residual, variance;

    void reserve(std::size_t rows, std::size_t entries) {
        begin.reserve(rows + 1);
        for (std::vector<double>* v : {&residual, &variance}) v->reserve(rows);
        column.reserve(entries);
        slope.reserve(entries);
    }
    int count() const { return static_cast<int>(residual.size()); }
    Eigen::Map<const Eigen::VectorXd> residuals() const {
        return {residual.data(), static_cast<Eigen::Index>(residual.size())};
    }
    void add(int c, double s) {
        column.push_back(c);
        slope.push_back(s);
    }
    void close(double left, double with_variance) {
        begin.push_back(static_cast<int>(column.size()));
        residual.push_back(left);
        variance.push_back(with_variance);
    }
};

/// An entry in the lower half of a symmetric matrix.
struct SymmetricEntry {
    int row, column;
    double value;
};

}  // namespace culet
