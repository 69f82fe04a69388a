// Expectations: closed forms.

#include "stone/numbers/dense_algebra.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace culet {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Its inverse has integer entries (Choi 1983).
MatrixXd hilbert(int size) {
    MatrixXd h(size, size);
    for (int i = 0; i < size; ++i) {
        for (int k = 0; k < size; ++k) h(i, k) = 1.0 / (i + k + 1);
    }
    return h;
}

MatrixXd inverse_of_hilbert3() {
    MatrixXd inverse(3, 3);
    inverse << 9, -36, 30, -36, 192, -180, 30, -180, 180;
    return inverse;
}

// 2 on the diagonal and -1 beside it: eigenvalues 2 - 2 cos(k pi / (size + 1)).
MatrixXd second_differences(int size) {
    MatrixXd matrix = 2 * MatrixXd::Identity(size, size);
    for (int i = 0; i + 1 < size; ++i) matrix(i, i + 1) = matrix(i + 1, i) = -1;
    return matrix;
}

// Rank 2.
MatrixXd counted() {
    MatrixXd matrix(4, 3);
    matrix << 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12;
    return matrix;
}

double off(const MatrixXd& a, const MatrixXd& b) {
    return (a - b).cwiseAbs().maxCoeff();
}

TEST(DenseAlgebra, InvertsAHilbertMatrixInEveryWay) {
    const MatrixXd h = hilbert(3), wanted = inverse_of_hilbert3();
    EXPECT_LT(off(Cholesky(h).inverse(), wanted), 1e-10);
    EXPECT_LT(off(PivotedCholesky(h).inverse(), wanted), 1e-10);
    EXPECT_LT(off(inverse_of(h), wanted), 1e-10);
    EXPECT_LT(off(inverse3(h), wanted), 1e-10);
    EXPECT_LT(off(pseudo_inverse(h), wanted), 1e-10);
    const MatrixXd factor = PivotedQr(h).inverse_factor();
    EXPECT_LT(off(times_transpose(factor, factor), wanted * wanted), 1e-7);
    EXPECT_NEAR(determinant3(h), 1.0 / 2160, 1e-15);
}

TEST(DenseAlgebra, SolvesWithPartsOfCholeskysFactor) {
    const MatrixXd matrix = second_differences(5);
    const Cholesky factor(matrix);
    ASSERT_TRUE(factor.good());
    // The squares of L's diagonal are ratios of principal minors: (k + 1) / k.
    EXPECT_NEAR(factor.least_pivot(), 6.0 / 5, 1e-14);
    const MatrixXd one = MatrixXd::Identity(5, 5);
    const MatrixXd upper = factor.solve_upper(one), lower = factor.solve_lower(one);
    EXPECT_LT(off(upper, lower.transpose()), 1e-14);
    EXPECT_LT(off(upper * lower * matrix, one), 1e-13);
    EXPECT_LT(off(factor.divide_by_upper(one), upper), 1e-14);
    EXPECT_LT(off(upper_transpose_times(upper, one), lower), 1e-14);
    const VectorXd right = VectorXd::LinSpaced(5, 1, 5);
    EXPECT_LT(off(matrix * factor.solve_one(right), right), 1e-13);
    EXPECT_LT(off(matrix * factor.solve(right), right), 1e-13);
}

TEST(DenseAlgebra, SaysWhereAMatrixIsNotPositive) {
    MatrixXd indefinite = MatrixXd::Identity(2, 2);
    indefinite(1, 1) = -3;
    EXPECT_FALSE(Cholesky(indefinite).good());
    EXPECT_FALSE(PivotedCholesky(indefinite).is_positive());
    EXPECT_EQ(PivotedCholesky(indefinite).pivots().minCoeff(), -3);
    EXPECT_TRUE(PivotedCholesky(second_differences(4)).is_positive());
}

TEST(DenseAlgebra, WritesAMatrixAsASumOfSquares) {
    const MatrixXd h = hilbert(6);
    const PivotedCholesky factor(h);
    const MatrixXd root = factor.root();
    EXPECT_LT(off(root.transpose() * factor.pivots().asDiagonal() * root, h), 1e-15);
    // The sum of all entries of the inverse is the square of the size.
    EXPECT_NEAR(factor.square(VectorXd::Ones(6)), 36, 1e-6);
}

TEST(DenseAlgebra, FindsEigenvaluesOfDifferences) {
    const int size = 7;
    const MatrixXd matrix = second_differences(size);
    const SymmetricEigen parts = symmetric_eigen(matrix);
    const SingularValues same = singular_values(matrix);
    for (int k = 1; k <= size; ++k) {
        const double value = 2 - 2 * std::cos(k * std::numbers::pi / (size + 1));
        EXPECT_NEAR(parts.values(k - 1), value, 1e-14);
        EXPECT_NEAR(same.values(size - k), value, 1e-14);
    }
    EXPECT_LT(off(parts.vectors * parts.values.asDiagonal() * parts.vectors.transpose(), matrix),
              1e-14);
    EXPECT_LT(off(same.u * same.values.asDiagonal() * same.v.transpose(), matrix), 1e-14);
    const SymmetricEigen3 three = symmetric_eigen3(second_differences(3));
    EXPECT_NEAR(three.values(0), 2 - std::numbers::sqrt2, 1e-14);
    EXPECT_NEAR(three.values(2), 2 + std::numbers::sqrt2, 1e-14);
}

TEST(DenseAlgebra, FindsRootsByACompanionMatrix) {
    // (x^2 + 1) (x - 1) (x - 2) = x^4 - 3 x^3 + 3 x^2 - 3 x + 2
    Eigen::Matrix4d companion = Eigen::Matrix4d::Zero();
    companion.row(0) << 3, -3, 3, -2;
    for (int i = 1; i < 4; ++i) companion(i, i - 1) = 1;
    const Eigen::Vector4cd roots = eigenvalues4(companion);
    for (const std::complex<double> wanted :
         {std::complex<double>(1), {2.0, 0.0}, {0.0, 1.0}, {0.0, -1.0}}) {
        EXPECT_LT((roots.array() - wanted).abs().minCoeff(), 1e-13);
    }
}

TEST(DenseAlgebra, TellsTheRankOfAMatrixAndWhatItsColumnsLeave) {
    const MatrixXd matrix = counted();
    const PivotedQr qr(matrix, 1e-9);
    ASSERT_EQ(qr.rank(), 2);
    EXPECT_LT(qr.pivot(2), 1e-13);
    const MatrixXd span = qr.first(2), rest = qr.last(2);
    EXPECT_LT(off(span.transpose() * span, MatrixXd::Identity(2, 2)), 1e-14);
    EXPECT_LT(transpose_times(rest, matrix).cwiseAbs().maxCoeff(), 1e-13);
    EXPECT_LT(orthogonal_part(matrix, span).cwiseAbs().maxCoeff(), 1e-13);
    EXPECT_LT(qr.along(matrix.col(1)).tail(2).norm(), 1e-13);
    EXPECT_NEAR(singular_values(matrix).values(2), 0, 1e-13);
}

TEST(DenseAlgebra, FindsTheShortestSolution) {
    // Equations like x + 2 y + 3 z = 6, with the null direction (1, -2, 1).
    const MatrixXd matrix = counted();
    const VectorXd right = matrix * VectorXd::Ones(3);
    EXPECT_LT(off(shortest_solution(matrix, right), VectorXd::Ones(3)), 1e-13);
    EXPECT_LT(off(pseudo_inverse(matrix) * right, VectorXd::Ones(3)), 1e-13);
    EXPECT_LT(off(matrix * PivotedQr(matrix).solve_one(right), right), 1e-12);
}

TEST(DenseAlgebra, FitsALineByQr) {
    // Through (0, 1), (1, 3), (2, 5): 1 + 2 x.
    MatrixXd columns(3, 2);
    columns << 1, 0, 1, 1, 1, 2;
    const VectorXd values = (VectorXd(3) << 1, 3, 5).finished();
    EXPECT_LT(off(PivotedQr(columns).solve(values), (VectorXd(2) << 1, 2).finished()), 1e-14);
    EXPECT_NEAR(along_completed_basis(columns, values)(2), 0, 1e-14);
    const MatrixXd basis = completed_basis(columns);
    EXPECT_LT(off(basis.transpose() * basis, MatrixXd::Identity(3, 3)), 1e-14);
    EXPECT_LT((basis.col(2).transpose() * columns).norm(), 1e-14);
}

TEST(DenseAlgebra, MultipliesBlocks) {
    const MatrixXd a = counted(), b = second_differences(4);
    EXPECT_EQ(product(b.topRows(2), a), MatrixXd(b.topRows(2) * a));
    EXPECT_EQ(off(congruence(a, b), a.transpose() * b * a), 0);
    MatrixXd lower = MatrixXd::Zero(3, 3);
    add_square(a, 2, lower);
    const MatrixXd whole = 2 * a.transpose() * a;
    EXPECT_EQ(lower(2, 0), whole(2, 0));
    EXPECT_EQ(lower(0, 2), 0);
    add_square(MatrixXd(0, 3), 1, lower);
    EXPECT_EQ(lower(2, 2), whole(2, 2));
}

}  // namespace
}  // namespace culet
