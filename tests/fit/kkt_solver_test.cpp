// The sparse saddle-point solver against dense algebra on the same numbers.

#include "fit/solve/kkt_solver.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <numeric>
#include <random>

namespace culet {
namespace {

struct Problem {
    JacobianRows rows;
    Eigen::VectorXd stiffness;
    std::vector<SymmetricEntry> curvature;

    Eigen::MatrixXd dense() const {
        const Eigen::Index n = stiffness.size(), m = rows.count();
        Eigen::MatrixXd k = Eigen::MatrixXd::Zero(n + m, n + m);
        k.diagonal().head(n) = stiffness;
        for (const SymmetricEntry& e : curvature) {
            k(e.row, e.column) += e.value;
            if (e.row != e.column) k(e.column, e.row) += e.value;
        }
        for (int i = 0; i < rows.count(); ++i) {
            k(n + i, n + i) = -rows.variance[std::size_t(i)];
            for (int e = rows.begin[std::size_t(i)]; e < rows.begin[std::size_t(i) + 1]; ++e) {
                k(n + i, rows.column[std::size_t(e)]) += rows.slope[std::size_t(e)];
                k(rows.column[std::size_t(e)], n + i) += rows.slope[std::size_t(e)];
            }
        }
        return k;
    }
};

// For right-hand sides of sizes between one and a hundred.
constexpr double k_left = 1e-9;

// Rows that couple neighbours, random unknowns, or all unknowns; exact, tight and soft.
Problem random_problem(std::mt19937_64& random) {
    const auto below = [&](int count) {
        return std::uniform_int_distribution<int>(0, count - 1)(random);
    };
    std::normal_distribution<double> normal;
    Problem p;
    const int unknowns = 1 + below(60), equations = below(80);
    p.stiffness.resize(unknowns);
    for (double& s : p.stiffness) s = 0.01 + std::abs(normal(random));
    std::vector<int> all(static_cast<std::size_t>(unknowns));
    std::iota(all.begin(), all.end(), 0);
    for (int i = 0; i < equations; ++i) {
        const int length = i % 9 == 0 ? unknowns : std::min(unknowns, 1 + below(6));
        const int base = below(unknowns);
        std::shuffle(all.begin(), all.end(), random);
        for (int k = 0; k < length; ++k) {
            p.rows.add(i % 2 ? all[std::size_t(k)] : (base + k) % unknowns, normal(random));
        }
        const int kind = below(3);
        p.rows.close(0, kind == 0 ? 0 : kind == 1 ? 1e-4 : 1e-9 * (1 + below(100)));
    }
    for (int k = 0; k < below(8); ++k) {
        const int a = below(unknowns), b = below(unknowns);
        p.curvature.push_back({std::max(a, b), std::min(a, b), 1e-4 * normal(random)});
    }
    return p;
}

TEST(KktSolver, SolvesWhatDenseAlgebraSolves) {
    std::mt19937_64 random(20261121);
    std::normal_distribution<double> normal;
    for (int round = 0; round < 200; ++round) {
        const Problem p = random_problem(random);
        const Eigen::MatrixXd k = p.dense();
        KktSolver solver;
        ASSERT_TRUE(solver.factor(p.rows, p.stiffness, p.curvature)) << round;
        const Eigen::Index n = p.stiffness.size(), m = p.rows.count();
        // Exact equations may be dependent: only right-hand sides that have a solution.
        Eigen::MatrixXd solution(n + m, 11);
        for (double& value : solution.reshaped()) value = normal(random);
        const Eigen::MatrixXd right = k * solution;
        const auto all = solver.solve_all(right.topRows(n), right.bottomRows(m));
        ASSERT_TRUE(all.good);
        Eigen::MatrixXd x(n + m, 11);
        x << all.unknowns, all.multipliers;
        EXPECT_LT((k * x - right).lpNorm<Eigen::Infinity>(), k_left) << round;
        const auto one = solver.solve(right.col(3).head(n), right.col(3).tail(m));
        Eigen::VectorXd y(n + m);
        y << one.unknowns, one.multipliers;
        EXPECT_LT((k * y - right.col(3)).lpNorm<Eigen::Infinity>(), k_left) << round;
    }
}

TEST(KktSolver, KeepsToNewNumbersRowsAndCurvature) {
    std::mt19937_64 random(7);
    KktSolver solver;
    for (int round = 0; round < 60; ++round) {
        static Problem p = random_problem(random);
        if (round % 4 == 0) p = random_problem(random);
        if (round % 4 == 2) p.curvature.clear();
        for (double& slope : p.rows.slope) slope *= 1.25;
        p.stiffness *= 0.9;
        ASSERT_TRUE(solver.factor(p.rows, p.stiffness, p.curvature)) << round;
        const Eigen::Index n = p.stiffness.size(), m = p.rows.count();
        const Eigen::VectorXd right = p.dense() * Eigen::VectorXd::Ones(n + m);
        const auto s = solver.solve(right.head(n), right.tail(m));
        Eigen::VectorXd x(n + m);
        x << s.unknowns, s.multipliers;
        EXPECT_LT((p.dense() * x - right).lpNorm<Eigen::Infinity>(), k_left) << round;
    }
}

TEST(KktSolver, KeepsToSoftRowsThatComeAndGo) {
    std::mt19937_64 random(13);
    const auto below = [&](int count) {
        return std::uniform_int_distribution<int>(0, count - 1)(random);
    };
    const Problem base = random_problem(random);
    const int unknowns = static_cast<int>(base.stiffness.size());
    KktSolver solver;
    for (int round = 0; round < 50; ++round) {
        Problem p = base;
        for (int i = 0; i < below(12); ++i) {
            const int at = below(unknowns);
            p.rows.add(at, 0.5);
            if (unknowns > 1) p.rows.add((at + 1 + below(unknowns - 1)) % unknowns, -0.7);
            p.rows.close(0, 1e-3);
        }
        ASSERT_TRUE(solver.factor(p.rows, p.stiffness, p.curvature)) << round;
        const Eigen::Index n = unknowns, m = p.rows.count();
        const Eigen::VectorXd right = p.dense() * Eigen::VectorXd::Ones(n + m);
        const auto s = solver.solve(right.head(n), right.tail(m));
        Eigen::VectorXd x(n + m);
        x << s.unknowns, s.multipliers;
        EXPECT_LT((p.dense() * x - right).lpNorm<Eigen::Infinity>(), k_left) << round;
    }
}

TEST(KktSolver, TellsCurvatureThatLeavesADirectionUnheld) {
    JacobianRows rows;
    rows.add(0, 1.0);
    rows.add(1, 1.0);
    rows.close(0, 0);
    const Eigen::VectorXd stiffness = Eigen::VectorXd::Ones(2);
    KktSolver solver;
    // Along (1, -1), the only direction that the equation leaves, P is 1 - c.
    EXPECT_TRUE(solver.factor(rows, stiffness, {{1, 0, 0.9}}));
    EXPECT_FALSE(solver.factor(rows, stiffness, {{1, 0, 1.1}}));
}

TEST(KktSolver, LetsExactEquationsRepeatEachOther) {
    JacobianRows rows;
    for (int copy = 0; copy < 3; ++copy) {
        for (int c = 0; c < 3; ++c) rows.add(c, 1.0 + c);
        rows.close(0, 0);
    }
    KktSolver solver;
    ASSERT_TRUE(solver.factor(rows, Eigen::VectorXd::Ones(3)));
    const auto s = solver.solve(Eigen::VectorXd::Zero(3), Eigen::VectorXd::Constant(3, 14.0));
    // The smallest step with x + 2 y + 3 z = 14.
    EXPECT_NEAR((s.unknowns - Eigen::Vector3d(1, 2, 3)).norm(), 0, 1e-9);
}

TEST(KktSolver, HasTheDeterminantOfTheWholeMatrix) {
    std::mt19937_64 random(11);
    for (int round = 0; round < 20; ++round) {
        Problem p = random_problem(random);
        // Exact equations are factorised with a variance of their own.
        for (double& v : p.rows.variance) v = std::max(v, 1e-6);
        KktSolver solver;
        ASSERT_TRUE(solver.factor(p.rows, p.stiffness, p.curvature));
        const double expected =
            p.dense().fullPivLu().matrixLU().diagonal().cwiseAbs().array().log().sum();
        EXPECT_NEAR(solver.log_determinant(), expected, 1e-8 * (1 + std::abs(expected))) << round;
    }
}

TEST(KktSolver, DoesWithoutEquations) {
    KktSolver solver;
    ASSERT_TRUE(solver.factor({}, Eigen::VectorXd::Constant(4, 2.0)));
    const auto s = solver.solve(Eigen::VectorXd::Ones(4), Eigen::VectorXd());
    EXPECT_NEAR((s.unknowns - Eigen::VectorXd::Constant(4, 0.5)).norm(), 0, 1e-15);
}

}  // namespace
}  // namespace culet
