// The covariance of a fit: each algorithm is checked against another one.
#include "fit/uncertainty/covariance.h"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>

#include "fit/model/datum_defect.h"
#include "fit/model/fit_model.h"
#include "fit/solve/null_space.h"
#include "fit/uncertainty/normal_inverse.h"
#include "stone/numbers/dense_algebra.h"
#include "tests/fit/test_stones.h"

namespace culet {
namespace {

using namespace test;
using Sparse = Eigen::SparseMatrix<double, Eigen::RowMajor>;

Sparse random_rows(int rows, int columns, int entries, unsigned seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    std::uniform_int_distribution<int> column(0, columns - 1);
    std::vector<Eigen::Triplet<double>> all;
    for (int i = 0; i < rows; ++i) {
        for (int k = 0; k < entries; ++k) all.emplace_back(i, column(random), normal(random));
    }
    Sparse result(rows, columns);
    result.setFromTriplets(all.begin(), all.end());
    return result;
}

// The rank comes from a dense QR. The basis must satisfy its definition: rows * Z = 0 and full
// column rank.
TEST(FreeDirections, SpanTheNullSpace) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
        Sparse rows = random_rows(30, 50, 4, seed);
        Eigen::MatrixXd dense = rows;
        for (int i = 0; i < 10; ++i) dense.row(20 + i) = dense.row(i) - 3 * dense.row(i + 5);
        const Sparse repeated = dense.sparseView();
        const Eigen::MatrixXd basis = free_directions(repeated, 20, 50);
        const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(dense);
        EXPECT_EQ(basis.cols(), 50 - qr.rank()) << seed;
        EXPECT_LT((dense * basis).cwiseAbs().maxCoeff(), 1e-10 * (1 + basis.cwiseAbs().maxCoeff()))
            << seed;
        EXPECT_EQ(Eigen::ColPivHouseholderQR<Eigen::MatrixXd>(basis).rank(), basis.cols()) << seed;
    }
}

// f' A^-1 f by dense algebra, for functions inside and outside the sparsity pattern, with short
// rows and long ones.
TEST(NormalInverse, MatchesTheInverse) {
    const int size = 150;
    for (unsigned seed = 1; seed <= 5; ++seed) {
        Sparse rows = random_rows(300, size, 3, seed);
        Eigen::MatrixXd dense_rows = rows;
        dense_rows.row(7).setConstant(0.3);
        dense_rows.row(9).setLinSpaced(size, -1, 1);
        rows = dense_rows.sparseView();
        const Sparse hard = random_rows(20, size, 3, 100 + seed);
        const NormalEquations equations{rows, hard, 100, Eigen::VectorXd::Constant(size, 0.5)};
        NormalInverse inverse;
        ASSERT_TRUE(inverse.compute(equations));
        const Eigen::MatrixXd dense_hard = hard;
        Eigen::MatrixXd matrix =
            dense_rows.transpose() * dense_rows + 1e4 * dense_hard.transpose() * dense_hard;
        matrix.diagonal().array() += 0.5;
        const Eigen::MatrixXd full = inverse_of(matrix);
        for (int i = 0; i < 60; ++i) {
            const Eigen::VectorXd f =
                i < 30 ? Eigen::VectorXd(dense_rows.row(i).transpose())
                       : Eigen::VectorXd(
                             random_rows(1, size, 9, 1000 * seed + unsigned(i)).row(0).transpose());
            const double expected = f.dot(full * f);
            EXPECT_NEAR(inverse.quadratic(f.sparseView()), expected, 1e-9 * expected) << i;
            EXPECT_LT((inverse.solve(f) - full * f).norm(), 1e-9 * (full * f).norm()) << i;
        }
    }
}

// Sylvester's law of inertia, checked with eigenvalues.
TEST(NormalInverse, CountsNegativeEigenvalues) {
    const int size = 60;
    for (unsigned seed = 1; seed <= 5; ++seed) {
        const Sparse rows = random_rows(80, size, 3, seed),
                     hard = random_rows(5, size, 3, 50 + seed);
        const Eigen::VectorXd diagonal = Eigen::VectorXd::Constant(size, -1.0);
        const Eigen::MatrixXd a = rows, h = hard;
        Eigen::MatrixXd matrix = a.transpose() * a + 4.0 * h.transpose() * h;
        matrix.diagonal().array() -= 1;
        const Eigen::VectorXd eigenvalues = symmetric_eigen(matrix).values;
        EXPECT_EQ(negative_pivots({rows, hard, 2, diagonal}),
                  int((eigenvalues.array() < 0).count()));
    }
}

struct Case {
    const char* name;
    std::vector<Reading> readings;
};

std::vector<Case> cases() {
    const Solid truth = brilliant();
    std::vector<Case> all;
    std::vector<Reading> full = all_angles(truth, radians(0.1), "T");
    for (const Reading& r : all_edges(truth, 0.01)) full.push_back(r);
    full.push_back(depth(truth, 0.01));
    all.push_back({"full", full});
    std::vector<Reading> weight = full;
    weight.push_back(reading(ReadingKind::volume, {}, volume(truth), 0.01));
    all.push_back({"with volume", weight});
    std::vector<Reading> few(full.begin(), full.begin() + 100);
    few.push_back(depth(truth, 0.01));
    all.push_back({"few", few});
    return all;
}

TEST(Covariance, BothAlgorithmsAgree) {
    const Stone stone = stone_of(brilliant());
    for (const Case& c : cases()) {
        const FitModel model(stone, c.readings, {});
        const Linearised linear = linearise(model, model.mesh_shape(), model.mesh_outline());
        const Covariance dense(linear, Covariance::Algorithm::dense);
        const Covariance sparse(linear, Covariance::Algorithm::sparse);
        ASSERT_TRUE(dense.usable() && sparse.usable()) << c.name;
        EXPECT_EQ(dense.rank_defect(), sparse.rank_defect()) << c.name;
        for (Eigen::Index i = 0; i < dense.leverages().size(); ++i) {
            EXPECT_NEAR(dense.leverages()(i), sparse.leverages()(i), 2e-3) << c.name << " " << i;
        }
        for (int f = 0; f < linear.layout.facets; ++f) {
            for (int k = 0; k < 3; ++k) {
                FunctionRow row(linear.layout.size());
                row.coeffRef(linear.layout.tilt(f) + k) = 1;
                // Where readings weigh as much as the mesh, the sparse algorithm includes both.
                const double open = std::sqrt(dense.open_variance(row));
                EXPECT_NEAR(std::sqrt(sparse.open_variance(row)), open, 0.25 * open + 5e-3)
                    << c.name << " facet " << f << " " << k;
                if (dense.rank_defect() > 0) continue;
                const double d = std::sqrt(dense.variance(row)),
                             s = std::sqrt(sparse.variance(row));
                EXPECT_NEAR(d, s, 0.01 * d + 1e-6) << c.name << " facet " << f << " " << k;
            }
        }
    }
}

// By definition, the variance of an unknown along the open directions, relative to the mesh's
// variance, is the sum over directions of (share in the unknown)^2 / (information from the
// readings).
TEST(Covariance, CallsOpenWhatIsLeftHalfAsUncertainAsTheMesh) {
    // Each direction moves one unknown: 1/4.1 is below a quarter, 1/3.9 is not.
    const Eigen::MatrixXd alone = Eigen::MatrixXd::Identity(100, 100);
    Eigen::VectorXd information = Eigen::VectorXd::Constant(100, 4.1);
    const Eigen::VectorXd even = Eigen::VectorXd::Ones(100);
    EXPECT_EQ(count_unobservable(alone, information, even), 0);
    information.head(2) << 0, 3.9;
    // Each direction moves all of 64 unknowns equally (Sylvester's Hadamard matrix), each with a
    // share of 1/64.
    EXPECT_EQ(count_unobservable(alone, information, even), 2);
    Eigen::MatrixXd hadamard = Eigen::MatrixXd::Ones(1, 1);
    while (hadamard.rows() < 64) {
        const Eigen::MatrixXd half = hadamard;
        hadamard.resize(2 * half.rows(), 2 * half.cols());
        hadamard << half, half, half, -half;
    }
    const Eigen::VectorXd unknowns = Eigen::VectorXd::Ones(64);
    Eigen::VectorXd told = Eigen::VectorXd::Constant(64, 1e6);
    told(0) = 0.1;  // 1 / 64 / 0.1 = 0.16: a smooth motion that no unknown feels
    EXPECT_EQ(count_unobservable(hadamard / 8, told, unknowns), 0);
    // With the same small information about every direction, 15 of them leave a variance of 15/64.
    told.setOnes();
    EXPECT_EQ(count_unobservable(hadamard / 8, told, unknowns), 64 - 15);
}

// The number of parameters is edges + 6 (Steinitz), less those fixed by the frame and by
// independent readings.
TEST(Covariance, CountsWhatIsOpen) {
    const Stone stone = stone_of(brilliant());
    const FitModel model(stone, {}, {});
    const Linearised linear = linearise(model, model.mesh_shape(), model.mesh_outline());
    for (const auto algorithm : {Covariance::Algorithm::dense, Covariance::Algorithm::sparse}) {
        // 128 edges + 6, less 3 shifts, the table's 2 tilts and the turn about the vertical.
        EXPECT_EQ(Covariance(linear, algorithm).rank_defect(), 128);
    }
}

// Sums of squares with weights from 1e-12 to 1e12. The expectation is an orthogonal-triangular
// factorisation in long double.
TEST(Covariance, KeepsSmallUncertaintiesApartFromLargeOnes) {
    const Solid truth = brilliant();
    const Stone stone = stone_of(truth);
    std::vector<Reading> readings = cases()[0].readings;
    const FitModel plain(stone, readings, {});
    readings[0].sigma = 1e-12;
    readings[1].sigma = 1e12;
    readings[150].sigma = 1e-12;
    const FitModel mixed(stone, readings, {});
    const auto sigma_of = [](const FitModel& model, int f) {
        const Linearised linear = linearise(model, model.mesh_shape(), model.mesh_outline());
        const Covariance covariance(linear);
        FunctionRow row(linear.layout.size());
        row.coeffRef(linear.layout.tilt(f)) = 1;
        return std::sqrt(covariance.variance(row));
    };
    const int far = find_facet(truth, "P5");
    EXPECT_NEAR(sigma_of(mixed, far), sigma_of(plain, far), 0.05 * sigma_of(plain, far));
    const Linearised linear = linearise(mixed, mixed.mesh_shape(), mixed.mesh_outline());
    const Covariance covariance(linear);
    // Nothing as precise checks the tight readings; every other reading checks the loose one.
    const Eigen::Index first = [&] {
        for (std::size_t i = 0; i < linear.soft.size(); ++i) {
            if (linear.soft[i].reading == 0) return Eigen::Index(i);
        }
        return Eigen::Index(-1);
    }();
    EXPECT_NEAR(covariance.leverages()(first), 1, 1e-6);
    EXPECT_NEAR(covariance.leverages()(first + 1), 0, 1e-6);
}

}  // namespace
}  // namespace culet
